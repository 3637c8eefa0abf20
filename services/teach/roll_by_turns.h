#pragma once

#include <optional>
#include <span>

#include "services/teach/picture_turn.h"

namespace trailcast::teach {

// How a camera is rolled about where it looks, to a quarter turn, by the robot's turns: as a robot
// turns to the left, the picture of an upright camera moves to the right, that of one on its side
// up or down, and that of one upside down to the left. Pictures that are mirrored, and a witness
// who takes left for right, look like a camera that is upside down. Of no camera that looks
// straight up or down.
class RollByTurns {
 public:
  // `moved`: features that are in both of two pictures of this size; `turned_rad`: how far the
  // robot turned between them, counter-clockwise positive.
  void Add(std::span<const MovedFeature> moved, double turned_rad, double dt_s, int longer_side_px);

  // So far pictures are to be turned clockwise to be upright: 0, 90, 180 or 270. Nothing: no two
  // turns in a row, of about ten degrees each, have agreed yet. The first answer stays.
  [[nodiscard]] std::optional<double> roll_deg() const { return roll_deg_; }

 private:
  // Lately, in one frame or several.
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
