#pragma once

#include <string>
#include <vector>

namespace trailcast::route {

// Returns "server 'barn' has no route 'hell'; did you mean 'hall' or 'hull'?", or, if no name is
// similar, ".. 'hell'; there is yard, hall". `holder` is "server 'barn'", and `there` are its
// routes, or those that are known.
[[nodiscard]] std::string NoRouteText(const std::string& holder, const std::string& name,
                                      const std::vector<std::string>& there);

}  // namespace trailcast::route
