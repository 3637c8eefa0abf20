#pragma once

#include <optional>
#include <span>
#include <string>

#include "services/motion/motion.h"
#include "services/teach/roll_by_turns.h"

namespace trailcast::agent {

// This tells whether a camera is mounted as stated, by the robot's turns: as commanded, and as
// odometry reports them. No clock.
class MountWatch {
 public:
  // Takes the next frame: features in it and in the one before, and how the robot moved between
  // them by either witness, as far as there is one.
  void Add(std::span<const teach::MovedFeature> moved,
           const std::optional<motion::OdometryIncrement>& told,
           const std::optional<motion::OdometryIncrement>& measured, double dt_s,
           int longer_side_px);

  // Returns the roll as RollByTurns does. The commands to the base decide once they have turned it,
  // since steering relies on them; for a robot that another program drives, odometry decides.
  [[nodiscard]] std::optional<double> roll_deg() const {
    return was_told_ ? by_told_.roll_deg() : by_measured_.roll_deg();
  }
  // Returns the roll by the commands alone.
  [[nodiscard]] std::optional<double> roll_by_told_deg() const { return by_told_.roll_deg(); }

  // Returns half a sentence for people on a camera that is mounted otherwise: what is seen, and how
  // sure that is.
  [[nodiscard]] std::string Text() const;

 private:
  bool was_told_ = false;
  teach::RollByTurns by_told_;
  teach::RollByTurns by_measured_;
};

// Returns the roll, 0 to 360, of a camera whose pictures are turned by `turn_deg` more than before.
[[nodiscard]] double RollAfter(double roll_deg, double turn_deg);

// Returns "upside down" or "on its side".
[[nodiscard]] const char* HangsText(double roll_deg);

}  // namespace trailcast::agent
