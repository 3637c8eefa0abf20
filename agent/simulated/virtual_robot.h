#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "agent/diagnosis/summary.h"
#include "agent/simulated/robot_faults.h"
#include "agent/simulated/scanner.h"
#include "agent/simulated/simulated_device.h"
#include "services/dds/ros2_link.h"

namespace trailcast::agent {

// How a virtual robot's camera and base are slower, or later, than one would wish.
struct RobotTiming {
  double rate_hz = 30.0;          // of the base: steps, odometry; the simulated robot's own
  double picture_rate_hz = 30.0;  // no higher
  double dropped = 0.0;           // share of the pictures that are lost, drawn
  double picture_delay_s = 0.0;   // from when a picture is taken until it is said
  double base_delay_s = 0.0;      // from when a command is heard until it is obeyed
  double stamps_late_s = 0.0;     // of pictures, against odometry's
};

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
// is told there, until `options.stop`. As real bases do it stands when no command came for 0.5 s.
// The summary says what it saw of its agent.
[[nodiscard]] Result<Summary> RunVirtualRobot(SimulatedDevice& robot,
                                              const VirtualRobotOptions& options);

}  // namespace trailcast::agent
