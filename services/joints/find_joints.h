#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "services/joints/route_views.h"

namespace trailcast::joints {

struct JointOptions {
  view::ComparisonOptions comparison;
  // So many features of two views have to agree for them to count at all, and more are worth more.
  int least_agreed = 5;
  // In one place the pictures show things equally large, but for the cameras: so far off in its
  // logarithm (one sigma) and they are views of one place from further off. Features of cameras
  // that magnify differently are alike where they look as large, so for these it says less.
  double log_scale_sigma = 0.2;
  double other_camera_sigma = 0.4;
  // So far (half widths) they are shifted where one looks further left: in a turn views further on
  // are alike, too, and shifted more.
  double shift_sigma = 0.6;
  // How far apart two views are that are alike (one sigma), and of how large things look in them;
  // from both, and from how fast things grow, follows where things look equally large.
  double off_sigma_m = 4.0;
  double off_sigma_s = 0.1;
  double log_scale_noise = 0.05;
  // From one pair of views to the next of a joint: so many are passed over on either route, or so
  // many units, whichever is further.
  std::size_t most_passed_over = 3;
  double most_apart = 3.0;
  // How far the two ways from one pair of views to the next may differ: so many metres, and a share
  // of the longer way. Teaching without odometry was slower or faster by a factor.
  double slack_m = 1.0;
  double slack_share = 0.3;
  double most_pace = 3.0;
  // A route comes back to where it was no sooner than this, and not before it has gone as far as
  // the two run together, unless that is further than the latter; in its units.
  double least_loop = 2.0;
  double sure_loop = 8.0;
  // A joint: so many pairs of views, and so many features beyond what agrees anywhere.
  std::size_t least_views = 3;
  double least_evidence = 8.0;
  std::size_t most_joints = 20;  // of two routes
  // Pairs of views that are alike, the first of them: where all looks alike, nothing is found of
  // the others.
  std::size_t most_alike = 20'000;
  // Asked now and then: true, and what is found so far is all.
  std::function<bool()> give_up{};
};

// Where two routes come to the same place looking the same way, and run on together.
struct Joint {
  double at_a = 0.0;  // where they begin to, in the units of each
  double at_b = 0.0;
  double end_a = 0.0;
  double end_b = 0.0;
  int views = 0;            // pairs of views, in order along both
  int features = 0;         // of theirs, that look alike and lie where one scale and shift put them
  double evidence = 0.0;    // how many more that is than agree anywhere
  double confidence = 0.0;  // 0.5 to 1
  // How much further left the second route looks, radians. How far a radian shifts its pictures is
  // known if it turned; else a camera of 60 degrees is assumed.
  double heading_rad = 0.0;
  bool heading_scaled = false;  // by its turns
  // By how much of its logarithm the second route's camera shows things larger.
  double log_scale = 0.0;

  [[nodiscard]] double length() const { return end_a - at_a; }
  bool operator==(const Joint&) const = default;
};

// By what of the two looks alike, at neighbouring places in order. `same_camera`: things look
// equally large in both where they are in one place; otherwise turns on both tell how much larger,
// and without turns places are less sure. Surest first. Deterministic. Stretches
// driven backwards are left out. How far the one is beside the other cannot be told.
[[nodiscard]] std::vector<Joint> FindJoints(const RouteViews& a, const RouteViews& b,
                                            bool same_camera, const JointOptions& options = {});
// Where one route comes back to where it has been: the earlier place is `at_a`.
[[nodiscard]] std::vector<Joint> FindLoops(const RouteViews& route,
                                           const JointOptions& options = {});

}  // namespace trailcast::joints
