#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trailcast::dds {

// A participant's user data, which is not encrypted: "robot1 trailcast-protocol=3". Members of a
// fleet with keys leave out the name. Before version 3 it had only the name, or nothing.
struct UserData {
  std::string name;
  std::optional<std::uint32_t> version;
};

// A participant on a robot's domain, which speaks ROS 2's protocol and not ours.
inline constexpr const char* kRobotsEnd = "trailcast";

[[nodiscard]] std::string ToText(const UserData& data);
// Parses anybody's user data; everything that is not understood is part of the name. Spaces at the
// end, with which a participant calls, do not count.
[[nodiscard]] UserData ParseUserData(std::string_view text);

}  // namespace trailcast::dds
