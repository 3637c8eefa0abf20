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

// How a virtual robot's camera and base are slower, or later, than one would wish.
struct RobotTiming {
  double rate_hz = 30.0;          // of the base: steps, odometry; the simulated robot's own
  double picture_rate_hz = 30.0;  // no higher
  double dropped = 0.0;           // share of the pictures that are lost, drawn
  double picture_delay_s = 0.0;   // from when a picture is taken until it is said
  double base_delay_s = 0.0;      // from when a command is heard until it is obeyed
  double stamps_late_s = 0.0;     // of pictures, against odometry's
};

// What lies between a robot's body and those who drive it: a camera that is slower than its base,
// pictures that are late or lost, commands that are, stamps that are off, and faults. As real bases
// do it stands when no command came for 0.5 s. Reads no clock itself.
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

  // `seed`: of the pictures that are lost.
  RobotElectronics(const RobotTiming& timing, const std::vector<RobotFault>& faults,
                   std::uint64_t seed);

  // A command has come.
  void Hear(Time now, const motion::VelocityCommand& command);
  // Before each step of the body. Returns the names of the faults that have begun.
  [[nodiscard]] std::vector<std::string> Advance(Time now);
  // What the body does in that step: what was heard a base's delay ago, unless that is too old.
  [[nodiscard]] motion::VelocityCommand Obey(Time now);
  // Of its left wheel; the right one never slips.
  [[nodiscard]] double grip() const;
  // Once a step: whether the camera takes a picture now, and it is not lost.
  [[nodiscard]] bool TakesPicture();

  // What odometry says of a place in the body's own frame; nothing while it is silent.
  [[nodiscard]] std::optional<Odometry> Say(SensorTime stamp, const motion::Pose2& pose);
  // A picture was taken; it is said when it is due.
  void Take(Time now, Picture picture);
  // The next picture that is to be said by now.
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
  std::deque<Heard> heard_;  // and not yet obeyed; the first one is
  std::deque<Taken> taken_;  // and not yet said
  double pictures_due_ = 1.0;
  motion::Pose2 odometry_from_;  // where what is said begins
  std::optional<motion::Pose2> odometry_;
  SensorTime odometry_back_{0};
  SensorTime pictures_back_{0};
  std::optional<SensorTime> stands_at_;  // the pictures' stamps
  std::optional<image::GrayImage> frozen_;
};

}  // namespace trailcast::agent
