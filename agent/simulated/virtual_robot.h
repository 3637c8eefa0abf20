#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "agent/diagnosis/summary.h"
#include "agent/simulated/simulated_device.h"
#include "services/dds/ros2_link.h"

namespace trailcast::agent {

// What goes wrong with a virtual robot, so many seconds after it was first told to drive.
struct RobotFault {
  enum class Kind { kCameraFreezes, kCameraStops, kOdometryStops, kBaseStops };
  Kind kind = Kind::kCameraFreezes;
  double after_s = 0.0;
};

// From "camera-freezes@12.5", "camera-stops@…", "odometry-stops@…", "base-stops@…".
[[nodiscard]] Result<RobotFault> ParseRobotFault(const std::string& text);

struct VirtualRobotOptions {
  dds::Ros2Options topics;
  // Its time passes only when a frame is answered by a command with the frame's stamp; otherwise
  // with the wall clock, as far as the machine keeps up.
  bool lockstep = false;
  double rate_hz = 30.0;
  std::optional<RobotFault> fault;
  std::function<bool()> stop = [] { return false; };
};

// A simulated robot as a process of its own: says on the ROS 2 topics what it senses, does as it
// is told there, until `options.stop`. As real bases do it stands when no command came for 0.5 s.
// The summary says what it saw of its agent.
[[nodiscard]] Result<Summary> RunVirtualRobot(SimulatedDevice& robot,
                                              const VirtualRobotOptions& options);

}  // namespace trailcast::agent
