#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/image/image.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/simulated/robot_faults.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The delays and rates of a virtual robot's camera and base.
struct RobotTiming {
  double rate_hz = 30.0;          // of the base: steps, odometry; the simulated robot's own
  double picture_rate_hz = 30.0;  // no higher
  double dropped = 0.0;           // share of the pictures that are lost at random
  double picture_delay_s = 0.0;   // from when a picture is taken until it is sent
  double base_delay_s = 0.0;      // from when a command arrives until it is obeyed
  double stamps_late_s = 0.0;     // of pictures, relative to odometry's
};

// Simulates what is between a robot's body and its driver: a camera that is slower than the base,
// pictures and commands that are late or lost, stamps that are off, and faults. As real bases do,
// it stops when no command came for 0.5 s. It reads no clock itself.
class RobotElectronics {
 public:
  using Time = RobotFaults::Time;

  struct Picture {
    SensorTime stamp{};
    image::GrayImage image;
  };
  struct Odometry {
    SensorTime stamp{};
    motion::Pose2 pose;
  };

  // `seed` draws the lost pictures.
  RobotElectronics(const RobotTiming& timing, const std::vector<RobotFault>& faults,
                   std::uint64_t seed);

  // Takes a command.
  void Hear(Time now, const motion::VelocityCommand& command);
  // Must be called before each step of the body. Returns the names of the faults that have begun.
  [[nodiscard]] std::vector<std::string> Advance(Time now);
  // Returns the body's command for that step: the one of a base's delay ago, unless it is too old.
  [[nodiscard]] motion::VelocityCommand Obey(Time now);
  // Returns the grip of its left wheel; the right one never slips.
  [[nodiscard]] double grip() const;
  // Must be called once a step. Says whether the camera takes a picture now that is not lost.
  [[nodiscard]] bool TakesPicture();

  // Returns the odometry for a pose in the body's own frame, or nothing while it is silent.
  [[nodiscard]] std::optional<Odometry> Say(SensorTime stamp, const motion::Pose2& pose);
  // Takes a picture, which is sent when it is due.
  void Take(Time now, Picture picture);
  // Returns the next picture that is due.
  [[nodiscard]] std::optional<Picture> Due(Time now);

  [[nodiscard]] const RobotFaults& faults() const { return faults_; }

 private:
  struct Heard {
    Time at;
    motion::VelocityCommand command;
  };
  struct Taken {
    Time at;
    Picture picture;
  };

  RobotTiming timing_;
  RobotFaults faults_;
  sim::Random drops_;
  std::deque<Heard> heard_;  // the commands not yet obeyed, after the present one
  std::deque<Taken> taken_;  // the pictures not yet sent
  double pictures_due_ = 1.0;
  motion::Pose2 odometry_from_;  // where the present odometry begins
  std::optional<motion::Pose2> odometry_;
  SensorTime odometry_back_{0};
  SensorTime pictures_back_{0};
  std::optional<SensorTime> stands_at_;  // the frozen stamp of pictures
  std::optional<image::GrayImage> frozen_;
};

}  // namespace trailcast::agent
