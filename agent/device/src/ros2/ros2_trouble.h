#pragma once

#include <optional>
#include <string>

#include "agent/device/src/robot_watch.h"
#include "services/base/packet_pieces.h"
#include "services/dds/ros2_link.h"

// These describe what is wrong with a ROS 2 robot, in one line for people.
namespace trailcast::agent {

// `stamps_stand` means that odometry comes, but with the same stamp.
[[nodiscard]] std::string TroubleText(const dds::Ros2Options& topics,
                                      const dds::Ros2Driver::Peers& peers,
                                      const RobotWatch::Trouble& trouble, bool stamps_stand);

// Returns what keeps pictures from this computer if its memory for packets in pieces is full, to be
// added to a silent camera's trouble. It is empty otherwise.
[[nodiscard]] std::string NoRoomText(const std::optional<PacketPieces>& pieces);

// The kinds of messages that have come from a robot since the agent began.
struct Came {
  bool pictures = false;
  bool odometry = false;
  bool scan = false;
  std::optional<std::size_t> silent_range;  // the first sensor that has given nothing
};
// For a robot that is missing, completely or in part.
[[nodiscard]] std::string WhoIsMissing(const dds::Ros2Options& topics,
                                       const dds::Ros2Driver::Peers& peers, const Came& came);

// For commands without a listener.
[[nodiscard]] std::string NobodyListens(const dds::Ros2Options& topics,
                                        const dds::Ros2Driver::Peers& peers);

}  // namespace trailcast::agent
