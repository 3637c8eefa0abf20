#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "agent/diagnosis/summary.h"
#include "services/dds/ros2_link.h"
#include "services/lab/simulated/robot_electronics.h"
#include "services/lab/simulated/scanner.h"
#include "services/lab/simulated/simulated_device.h"

namespace trailcast::agent {

struct VirtualRobotOptions {
  dds::Ros2Options topics;
  // The robot's time passes only when a frame is answered by a command with the frame's stamp;
  // otherwise it is the wall clock, as far as the machine keeps up. In lockstep there are no timing
  // and no faults, and obstacles come and go by the robot's time.
  bool lockstep = false;
  RobotTiming timing;
  std::vector<RobotFault> faults;
  std::vector<Pillar> obstacles;  // for its scanner and range sensors, if the topics have these
  // The pose of each range sensor, seen from the axle; without one, it is a quarter of a metre
  // ahead of it.
  std::vector<std::optional<motion::Pose2>> range_mounts;
  std::uint64_t seed = 1;  // of everything that is drawn
  std::function<bool()> stop = [] { return false; };
};

// Runs a simulated robot as a process of its own, which publishes its sensors' data on ROS 2 topics
// and obeys commands from there, until `options.stop`. The summary tells what it saw of its agent.
[[nodiscard]] Result<Summary> RunVirtualRobot(SimulatedDevice& robot,
                                              const VirtualRobotOptions& options);

}  // namespace trailcast::agent
