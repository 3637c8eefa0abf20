#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/sensed_poses.h"
#include "agent/session/observation.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/simulated/robot_electronics.h"
#include "services/lab/trial/flaws.h"

namespace trailcast::trial {

// A simulated robot as an agent gets it over a network: late, with stamps that may be off, and with
// odometry that may jump. It treats these as a ROS 2 robot's device does.
class FlawedRobot {
 public:
  // Called after each step of the base. There are several steps to a picture that is late or lost.
  using OnStep = std::function<void(SensorTime now)>;

  // Keeps a reference to `robot`.
  FlawedRobot(sim::SimulatedRobot& robot, const RobotFlaws& flaws, std::uint64_t seed);

  // Returns what the agent sees next, after `command`, or nothing if no picture came for 20 s.
  [[nodiscard]] std::optional<agent::Observation> Next(const motion::VelocityCommand& command,
                                                       const OnStep& on_step);
  // Returns lines for people about the robot and its clocks since the last call.
  [[nodiscard]] std::vector<std::string> TakeNews();

 private:
  using Time = agent::RobotElectronics::Time;
  struct Frame {
    SensorTime taken{};
    image::GrayImage image;
  };
  void StepBase(const OnStep& on_step);
  void HearPictures();
  [[nodiscard]] bool ready() const;

  sim::SimulatedRobot& robot_;
  agent::RobotElectronics electronics_;
  agent::SensedPoses poses_;
  motion::VelocityCommand told_;
  std::optional<Frame> newest_;  // not yet returned
  Time unserved_since_;          // since when there is one
  Time now_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::trial
