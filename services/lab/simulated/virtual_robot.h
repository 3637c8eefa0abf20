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
  // Its time passes only when a frame is answered by a command with the frame's stamp; otherwise
  // with the wall clock, as far as the machine keeps up. No timing, no faults then;
  // obstacles come and go by the robot's time.
  bool lockstep = false;
  RobotTiming timing;
  std::vector<RobotFault> faults;
  std::vector<Pillar> obstacles;  // for its scanner and range sensors, if topics has those
  // Where each range sensor is, seen from the axle; nothing: a quarter of a metre ahead of it.
  std::vector<std::optional<motion::Pose2>> range_mounts;
  std::uint64_t seed = 1;  // of what is drawn
  std::function<bool()> stop = [] { return false; };
};

// A simulated robot as a process of its own: says on the ROS 2 topics what it senses, does as it
// is told there, until `options.stop`. The summary says what it saw of its agent.
[[nodiscard]] Result<Summary> RunVirtualRobot(SimulatedDevice& robot,
                                              const VirtualRobotOptions& options);

}  // namespace trailcast::agent
