#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trailcast::dds {

// What a participant says of itself in the clear, as its user data: "robot1 trailcast-protocol=3",
// of a member of a fleet with keys without the name; before version 3 the name alone or nothing.
struct UserData {
  std::string name;
  std::optional<std::uint32_t> version;
};

// A participant towards a robot, which speaks ROS 2's protocol and not ours.
inline constexpr const char* kRobotsEnd = "trailcast";

[[nodiscard]] std::string ToText(const UserData& data);
// Of anybody's, where all that is not understood is part of the name. Spaces at the end, with which
// a participant calls, do not count.
[[nodiscard]] UserData ParseUserData(std::string_view text);

}  // namespace trailcast::dds
