#pragma once

#include <string>

namespace trailcast::dds {

// Where the driver of a ROS 2 robot looks for the robot's nodes, as XML for Cyclone.
struct Ros2Network {
  std::string xml;
  std::string tried;  // for people
};

// `wanted` is the interface's name; an empty one means the network's and the loopback. `uri_xml` is
// the environment's choice, which takes precedence. ROS 2's nodes on this computer use
// - multicast on the network's interface: ROS 2's defaults, and
//   ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET;
// - multicast on the loopback: ROS_LOCALHOST_ONLY=1, and files that say so;
// - 127.0.0.1, at one of the first 33 places, and the network's address:
//   ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST (rmw_cyclonedds and rmw_fastrtps).
// On both interfaces with localhost as a peer, all of them are met. On the loopback alone, the
// second kind is met, and those of the third that give its address.
[[nodiscard]] Ros2Network MeetRos2(const std::string& wanted, const std::string& uri_xml);

}  // namespace trailcast::dds
