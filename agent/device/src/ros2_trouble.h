#pragma once

#include <optional>
#include <string>

#include "agent/device/src/robot_watch.h"
#include "services/dds/ros2_link.h"

// What is wrong with a ROS 2 robot, in words: one line for people.
namespace trailcast::agent {

// `stamps_stand`: odometry comes, and says nothing new.
[[nodiscard]] std::string TroubleText(const dds::Ros2Options& topics,
                                      const dds::Ros2Driver::Peers& peers,
                                      const RobotWatch::Trouble& trouble, bool stamps_stand);

// What came of a robot since the agent began.
struct Came {
  bool pictures = false;
  bool odometry = false;
  bool scan = false;
  std::optional<std::size_t> silent_range;  // the first sensor of which nothing came
};
// Of a robot that is not there, or not all of it.
[[nodiscard]] std::string WhoIsMissing(const dds::Ros2Options& topics,
                                       const dds::Ros2Driver::Peers& peers, const Came& came);

// Of commands.
[[nodiscard]] std::string NobodyListens(const dds::Ros2Options& topics,
                                        const dds::Ros2Driver::Peers& peers);

}  // namespace trailcast::agent
