#pragma once

#include <optional>
#include <span>

#include "services/teach/picture_turn.h"

namespace trailcast::teach {

// This finds how a camera is rolled about its optical axis, to a quarter turn, by the robot's
// turns. When a robot turns to the left, the picture of an upright camera moves to the right, that
// of one on its side up or down, and that of one upside down to the left. Mirrored pictures, and a
// witness that takes left for right, look like a camera that is upside down. It does not work for a
// camera that looks straight up or down.
class RollByTurns {
 public:
  // Adds a step. `moved` are features that are in both of two pictures of this size, and
  // `turned_rad` is how far the robot turned between them, counter-clockwise positive.
  void Add(std::span<const MovedFeature> moved, double turned_rad, double dt_s, int longer_side_px);

  // Returns how far pictures must be turned clockwise to be upright: 0, 90, 180 or 270. Returns
  // nothing until two successive turns, of about ten degrees each, have agreed. The first answer
  // stays.
  [[nodiscard]] std::optional<double> roll_deg() const { return roll_deg_; }

 private:
  // This is what moved lately, in one frame or several.
  struct Moved {
    double turned_rad = 0.0;
    double right_px = 0.0;
    double down_px = 0.0;
  };
  [[nodiscard]] std::optional<double> RollIn(const Moved& lately, int longer_side_px) const;

  Moved lately_;
  std::optional<double> last_deg_;  // by the last turn
  std::optional<double> roll_deg_;
};

}  // namespace trailcast::teach
