#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/plot/network_plot.h"

namespace trailcast::tool {

// People cannot make sense of more in one picture.
inline constexpr std::size_t kMostRoutesInPicture = 200;

// Returns what a server lists of its network (`fleet::AskForNetwork`) as a picture, with rows by
// name. Proposed junctions are drawn as unused ones. Junctions and names of revisions that robots
// do not follow are on the row of the one that they do, as far as there is one. Errors: kNotFound
// if no route is listed; kInvalidArgument if there are too many.
[[nodiscard]] Result<plot::NetworkPicture> PictureOf(const std::vector<std::string>& lines);

}  // namespace trailcast::tool
