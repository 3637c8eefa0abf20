#pragma once

#include <string>
#include <vector>

namespace trailcast::route {

// "server 'barn' has no route 'hell'; did you mean 'hall' or 'hull'?", of those that there are, or
// of which some are known; where none is alike, "; there is yard". `holder`: "server 'barn'".
[[nodiscard]] std::string NoRouteText(const std::string& holder, const std::string& name,
                                      const std::vector<std::string>& there);

}  // namespace trailcast::route
