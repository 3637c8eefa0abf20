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
  kPaper,     // Chen & Birchfield 2009 as printed
  kIcra2006,  // the paper's first version: vision alone, bang-bang, no roll compensation
};

[[nodiscard]] const char* ToString(ReplayMethod method);
[[nodiscard]] const std::vector<std::string>& ReplayMethodNames();
// kNotFound lists the names there are.
[[nodiscard]] Result<ReplayMethod> FindReplayMethod(const std::string& name);

// The methods as printed; what this project adds to teaching and following is left out.
[[nodiscard]] inline bool AsPrinted(ReplayMethod method) {
  return method != ReplayMethod::kDefault;
}
[[nodiscard]] inline bool UsesOdometry(ReplayMethod method) {
  return method != ReplayMethod::kIcra2006;
}

// A robot's own focal length, whatever the size of its pictures.
struct OwnLens {
  double focal_share = 0.0;  // of the picture's width
  double sigma = 0.0;        // relative
  // How it hangs, as it was found to, instead of ReplayMethodOptions::intake's.
  std::optional<double> roll_deg = {};
};

struct ReplayMethodOptions {
  ReplayMethod method = ReplayMethod::kDefault;
  motion::VelocityLimits limits{1.0, 0.8};
  double speed_factor = 1.0;  // times the taught speed
  // The robot may be anywhere on the route at first: it stands until it knows where. Otherwise it
  // is at the route's start, or where it was left, and anywhere else only if it may be: a robot
  // that is neither here nor there looks along the whole route then.
  bool anywhere = false;
  bool else_anywhere = false;
  vision::IntakeOptions intake = {};
  // From the axle that the robot turns about ahead to its camera, more than on the scout; nothing:
  // not told, and learnt in bends.
  std::optional<double> camera_ahead_m = {};
  // What the last run has learnt of its camera.
  std::optional<OwnLens> lens = {};
  // Round what stands on the path, by the default method with odometry.
  replay::PassingOptions passing = {};
  // How far to either side a robot that has lost its path from view turns on the spot to find it
  // again, before it gives up; by the default method with odometry. 0: it stands.
  double look_around_rad = 0.0;
  // To note what of the route is found, missed, and seen besides, for a refreshed one: of its key
  // views, and by the default method with odometry of its features. Changes nothing of how it
  // follows.
  bool take_experience = false;
};

// Without odometry, in the route or on the robot, the funnel lane alone steers by any method.
// `known`: the magnification is an earlier run's, and not what the pictures' widths say.
[[nodiscard]] std::unique_ptr<replay::Follower> MakeFollower(const ReplayMethodOptions& options,
                                                             bool by_odometry, int scout_width_px,
                                                             double magnification, bool known);

}  // namespace trailcast::agent
