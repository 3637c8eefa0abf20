#pragma once

#include <optional>
#include <span>
#include <string>

#include "services/motion/motion.h"
#include "services/teach/roll_by_turns.h"

namespace trailcast::agent {

// Whether a camera hangs as it is said to, by the robot's turns: as it was told to turn, and as its
// odometry says that it did. No clock.
class MountWatch {
 public:
  // The next frame: features in it and in the one before, and how the robot moved between them by
  // either witness, as far as there is one.
  void Add(std::span<const teach::MovedFeature> moved,
           const std::optional<motion::OdometryIncrement>& told,
           const std::optional<motion::OdometryIncrement>& measured, double dt_s,
           int longer_side_px);

  // As RollByTurns has it: by what the base was told, once that was to turn, for that is what
  // steering goes by; of a robot that somebody else drives, by odometry.
  [[nodiscard]] std::optional<double> roll_deg() const {
    return was_told_ ? by_told_.roll_deg() : by_measured_.roll_deg();
  }
  // The same by what the base was told alone.
  [[nodiscard]] std::optional<double> roll_by_told_deg() const { return by_told_.roll_deg(); }

  // Of a camera that hangs otherwise, half a sentence for people: what is seen, and how sure that
  // is.
  [[nodiscard]] std::string Text() const;

 private:
  bool was_told_ = false;
  teach::RollByTurns by_told_;
  teach::RollByTurns by_measured_;
};

// The roll, 0 to 360, of a camera whose pictures are turned by so much more than they were.
[[nodiscard]] double RollAfter(double roll_deg, double turn_deg);

// "upside down", "on its side".
[[nodiscard]] const char* HangsText(double roll_deg);

}  // namespace trailcast::agent
