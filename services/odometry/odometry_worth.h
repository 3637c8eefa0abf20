#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/odometry/drive_step.h"
#include "services/odometry/turn_series.h"

namespace trailcast::odometry {

// How odometry's turn rate goes with the picture's:
//   odometry = scale * picture + drift.
struct TurnFit {
  double scale = 1.0;
  // The same of the drive's parts, the least and the largest of those that turn enough.
  double least_scale = 1.0;
  double most_scale = 1.0;
  double drift_radps = 0.0;  // counter-clockwise positive
  double noise_radps = 0.0;  // of most windows of half a second, after that
};

// A while in which odometry tells otherwise than the picture.
struct Spell {
  enum class Kind {
    kFrozen,      // odometry stands while the picture moves
    kMovesAlone,  // odometry moves while the picture stands
    kTurnsElse,   // odometry turns by other rates than the picture does
  };
  Kind kind = Kind::kFrozen;
  double from_s = 0.0;
  double to_s = 0.0;
  // What odometry tells in that time, kTurnsElse: beyond what the picture does.
  double turned_rad = 0.0;
  double driven_m = 0.0;
};

// The robot is back where the first picture was taken, and looks the same way.
struct CameBack {
  double t_s = 0.0;
  double turned_rad = 0.0;  // from how it looked then, by the picture, counter-clockwise positive
};

// A whole turn, which needs no focal length.
struct WholeTurn {
  double odometry_rad = 0.0;  // told for it, as told for 2 pi
  double picture_rad = 0.0;   // the same, by the focal length that is known or taken
};

// While it was heard what the base was told to drive.
struct ToldWay {
  double told_m = 0.0;
  double driven_m = 0.0;  // by odometry
};

// What a drive's odometry is worth, as far as its pictures tell.
struct OdometryWorth {
  double lasts_s = 0.0;
  double seen_share = 0.0;  // of the steps: the picture could be followed
  double driven_m = 0.0;    // by odometry, forward and backward
  double turned_rad = 0.0;  // the same, to the left and to the right
  double picture_turned_rad = 0.0;
  // Odometry's turns come so much later than the pictures'. Nothing: not clear.
  std::optional<Lag> late;
  std::optional<TurnFit> turn;   // nothing: too little is turned, or it is not clear when
  std::vector<Spell> spells;     // in the order of their times
  std::vector<double> breaks_s;  // when odometry jumped or was silent
  // While the picture stands and odometry drives nowhere, for long enough: how it turns then.
  std::optional<double> standing_drift_radps;
  std::optional<WholeTurn> whole_turn;
  std::optional<ToldWay> told;
};

// Pure: the same steps give the same. At least one step.
[[nodiscard]] OdometryWorth Weigh(std::span<const DriveStep> steps,
                                  const std::optional<CameBack>& came_back);

}  // namespace trailcast::odometry
