#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/plot/network_plot.h"

namespace trailcast::tool {

// More than people look at in one picture.
inline constexpr std::size_t kMostRoutesInPicture = 200;

// What a server lists of its network (`fleet::AskForNetwork`), to be drawn, rows by name: proposed
// joints as those that are not used; joints
// and names of revisions that are not followed on the row of those that are, as far as there is
// one. Errors: kNotFound where no route is listed; kInvalidArgument: too many of them.
[[nodiscard]] Result<plot::NetworkPicture> PictureOf(const std::vector<std::string>& lines);

}  // namespace trailcast::tool
