#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/odometry/drive_step.h"
#include "services/odometry/turn_series.h"

namespace trailcast::odometry {

// The line that relates odometry's turn rate to the picture's:
//   odometry = scale * picture + drift.
struct TurnFit {
  double scale = 1.0;
  // The smallest and the largest scale among the drive's parts that turn enough.
  double least_scale = 1.0;
  double most_scale = 1.0;
  double drift_radps = 0.0;  // counter-clockwise positive
  double noise_radps = 0.0;  // in most windows of half a second, after the fit
};

// A time in which odometry contradicts the picture.
struct Spell {
  enum class Kind {
    kFrozen,      // odometry stands while the picture moves
    kMovesAlone,  // odometry moves while the picture stands
    kTurnsElse,   // odometry turns by other rates than the picture does
  };
  Kind kind = Kind::kFrozen;
  double from_s = 0.0;
  double to_s = 0.0;
  // The motion that odometry reports in that time; for kTurnsElse, its excess over the picture's.
  double turned_rad = 0.0;
  double driven_m = 0.0;
};

// The robot is back where the first picture was taken, and looks the same way.
struct CameBack {
  double t_s = 0.0;
  double turned_rad = 0.0;  // since the first picture, by the picture, counter-clockwise positive
};

// A whole turn, which calibrates odometry without a focal length.
struct WholeTurn {
  double odometry_rad = 0.0;  // what odometry reports for a turn of 2 pi
  double picture_rad = 0.0;   // the same by the picture, with the focal length that is known or
                              // assumed
};

// The distance that was commanded and the distance that was driven, while commands were heard.
struct ToldWay {
  double told_m = 0.0;
  double driven_m = 0.0;  // by odometry
};

// An assessment of a drive's odometry, as far as its pictures allow one.
struct OdometryWorth {
  double lasts_s = 0.0;
  double seen_share = 0.0;  // share of the steps in which the picture could be followed
  double driven_m = 0.0;    // by odometry, forward and backward
  double turned_rad = 0.0;  // the same, to the left and to the right
  double picture_turned_rad = 0.0;
  // How much later odometry's turns come than the pictures'; nothing if that is not clear.
  std::optional<Lag> late;
  std::optional<TurnFit> turn;   // nothing if the drive turns too little, or its lag is not clear
  std::vector<Spell> spells;     // in the order of their times
  std::vector<double> breaks_s;  // when odometry jumped or was silent
  // Odometry's turn rate while the picture stands and odometry drives nowhere, for long enough.
  std::optional<double> standing_drift_radps;
  std::optional<WholeTurn> whole_turn;
  std::optional<ToldWay> told;
};

// Assesses a drive of at least one step. The function is pure.
[[nodiscard]] OdometryWorth Weigh(std::span<const DriveStep> steps,
                                  const std::optional<CameBack>& came_back);

}  // namespace trailcast::odometry
