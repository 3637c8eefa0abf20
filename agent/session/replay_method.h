#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/motion/motion.h"
#include "services/replay/follower.h"
#include "services/replay/passing.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

enum class ReplayMethod {
  kDefault,   // with what this project adds
  kPaper,     // Chen & Birchfield 2009, as printed
  kIcra2006,  // the paper's first version: vision alone, bang-bang, no roll compensation
};

[[nodiscard]] const char* ToString(ReplayMethod method);
[[nodiscard]] const std::vector<std::string>& ReplayMethodNames();
// Returns kNotFound with the list of names if there is no such method.
[[nodiscard]] Result<ReplayMethod> FindReplayMethod(const std::string& name);

// Tells that the method is as printed, without what this project adds to teaching and following.
[[nodiscard]] inline bool AsPrinted(ReplayMethod method) {
  return method != ReplayMethod::kDefault;
}
[[nodiscard]] inline bool UsesOdometry(ReplayMethod method) {
  return method != ReplayMethod::kIcra2006;
}

// This is a robot's own focal length, whatever the size of its pictures.
struct OwnLens {
  double focal_share = 0.0;  // share of the picture's width
  double sigma = 0.0;        // relative
  // This is the roll of its mount, as it was found, in place of ReplayMethodOptions::intake's.
  std::optional<double> roll_deg = {};
};

struct ReplayMethodOptions {
  ReplayMethod method = ReplayMethod::kDefault;
  motion::VelocityLimits limits{1.0, 0.8};
  double speed_factor = 1.0;  // in multiples of the taught speed
  // The robot may be anywhere on the route at first, so it stands until it knows where. Otherwise
  // it is at the route's start, or where it was left, and looks along the whole route only if it is
  // at neither.
  bool anywhere = false;
  bool else_anywhere = false;
  vision::IntakeOptions intake = {};
  // This is how much further ahead of the turning axle its camera is than the scout's. It is learnt
  // in bends if it is not given.
  std::optional<double> camera_ahead_m = {};
  // This is what the last run has learnt of its camera.
  std::optional<OwnLens> lens = {};
  // These are for passing obstacles on the path, by the default method with odometry.
  replay::PassingOptions passing = {};
  // A robot that has lost its path from view turns this far to either side on the spot to find it
  // again, before it gives up; by the default method with odometry. With 0 it stands.
  double look_around_rad = 0.0;
  // The run notes which key views of the route, and by the default method with odometry which
  // features, are found, missed, and seen besides, for a refreshed revision. This changes nothing
  // of how it follows.
  bool take_experience = false;
};

// The source that tells a follower how far it has come.
enum class WayBy {
  kNothing,
  kOdometry,
  kCommands,  // what its base was told to drive
  kSight,     // either, along a route whose metres are known by the scout's pictures alone
};

// By nothing, the funnel lane alone steers by any method. `known` says that the magnification comes
// from an earlier run, and not from the pictures' widths.
[[nodiscard]] std::unique_ptr<replay::Follower> MakeFollower(const ReplayMethodOptions& options,
                                                             WayBy way, int scout_width_px,
                                                             double magnification, bool known);

}  // namespace trailcast::agent
