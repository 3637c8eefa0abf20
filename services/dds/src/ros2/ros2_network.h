#pragma once

#include <string>

namespace trailcast::dds {

// Where the driver of a ROS 2 robot looks for the robot's nodes, and Cyclone's XML for that.
struct Ros2Network {
  std::string xml;
  std::string tried;  // for people
};

// `wanted`: the interface by name; empty: the network's and the loopback. `uri_xml`: what the
// environment chooses, which stands. ROS 2's nodes on this computer speak
// - by multicast on the network's interface: ROS 2's defaults, and
//   ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET;
// - by multicast on the loopback: ROS_LOCALHOST_ONLY=1, and files that say so;
// - to 127.0.0.1, at one of the first 33 places, and by the network's address:
//   ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST (rmw_cyclonedds and rmw_fastrtps).
// All of them are met on both interfaces with localhost as a peer; on the loopback alone the
// second, and those of the third that give its address.
[[nodiscard]] Ros2Network MeetRos2(const std::string& wanted, const std::string& uri_xml);

}  // namespace trailcast::dds
