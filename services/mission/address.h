#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"

namespace trailcast::mission {

// A mission is for one robot ("robot1"), for whichever robot of a group is free first ("@cart"), or
// for several of both, with commas between them, which all get it or none.
inline constexpr std::size_t kMostAddressed = 16;

// Robots that are numbered alike are a group: "cart" of "cart-1", "cart_2" and "cart3". The group
// of a robot without a number has its own name.
[[nodiscard]] std::string GroupOf(std::string_view robot);
[[nodiscard]] bool IsGroup(std::string_view address);  // "@cart"
// Tells whether an address of one, or of a group, means a robot.
[[nodiscard]] bool Means(std::string_view address, std::string_view robot);
// Returns the robots and groups in an address. Fails with kInvalidArgument for what is no name, and
// if a robot is there twice, or beside its group.
[[nodiscard]] Result<std::vector<std::string>> ParseAddress(std::string_view text);

}  // namespace trailcast::mission
