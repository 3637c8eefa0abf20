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
// odometry that may jump, of which is made what a ROS 2 robot's device makes of it.
class FlawedRobot {
 public:
  // After each step of the base, of which there are several to a picture that is late or lost.
  using OnStep = std::function<void(SensorTime now)>;

  // Keeps a reference to `robot`.
  FlawedRobot(sim::SimulatedRobot& robot, const RobotFlaws& flaws, std::uint64_t seed);

  // What the agent sees next, after it said `command`. Nothing: no picture came for 20 s.
  [[nodiscard]] std::optional<agent::Observation> Next(const motion::VelocityCommand& command,
                                                       const OnStep& on_step);
  // What befell the robot and its clocks since the last call, a line each for people.
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
  std::optional<Frame> newest_;  // not yet given
  Time unserved_since_;          // since when there has been one
  Time now_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::trial
