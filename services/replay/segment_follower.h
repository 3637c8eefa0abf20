#pragma once

#include <optional>
#include <vector>

#include "services/motion/motion.h"
#include "services/replay/funnel_lane.h"
#include "services/replay/roll.h"
#include "services/replay/transition.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct SegmentFollowerOptions {
  // gamma, radians per pixel of the scout's picture: about one over the focal length of a usual
  // webcam at 320 px width, so that a pure rotation is undone at once. Scaled with the width.
  double gain_rad_per_px_at_320 = 0.0036;
  double eta = 0.5;          // share of vision in the turn where there is odometry
  double turn_time_s = 0.5;  // in which a desired turn is carried out
  double speed_factor = 1.0;
  motion::VelocityLimits limits{1.0, 0.8};
  RollOptions roll;
  TransitionOptions transition;
  // Without odometry delta has one term of three left and rises too flat for its peak to be caught:
  // the segment then also ends at this much of the taught tracks, a little early, because past the
  // milestone its features ask for the wrong turn.
  double end_fraction_without_odometry = 0.85;
  // Floors under equation (2)'s sigmas: a straight or very short segment would otherwise let the
  // odometry's noise decide.
  double min_distance_sigma_m = 0.2;
  double min_heading_sigma_rad = 0.1;
};

struct FollowInput {
  // Where the segment's features are now, in pixels of the scout's magnification; id is the
  // position in Segment::features.
  std::vector<route::TrackedFeature> features;
  // Since the last step; nothing on robots without odometry (vision alone then steers).
  std::optional<motion::OdometryIncrement> odometry;
};

struct FollowStep {
  motion::VelocityCommand command;
  // Desired heading changes, radians, positive to the right.
  double vision_turn_rad = 0.0;
  double odometry_turn_rad = 0.0;
  double turn_rad = 0.0;
  double roll_rad = 0.0;
  double delta = 0.0;
  double delta_minus = 0.0;
  double fraction = 0.0;  // of the segment, 0..1
  bool ended = false;     // the milestone has been passed
};

// Follows one segment: the paper's control step. No clock, no camera, no thread.
class SegmentFollower {
 public:
  // `image_width_px`: of the scout's frames. `start`: what was driven of the segment already,
  // e.g. past the milestone that began it.
  SegmentFollower(route::Segment segment, int image_width_px, const SegmentFollowerOptions& options,
                  const motion::OdometryIncrement& start = {});

  [[nodiscard]] FollowStep Step(const FollowInput& input);

  [[nodiscard]] const route::Segment& segment() const { return segment_; }
  // Since the segment's start, by odometry.
  [[nodiscard]] const motion::OdometryIncrement& driven() const { return driven_; }
  // What was driven since delta was highest: how far past the milestone the robot is.
  [[nodiscard]] double overshoot_m() const;

 private:
  struct Matched;

  [[nodiscard]] Matched Match(const std::vector<route::TrackedFeature>& features) const;
  [[nodiscard]] double OdometryTurn(double speed_mps) const;
  [[nodiscard]] TransitionErrors OdometryErrors() const;
  [[nodiscard]] double Fraction(const Matched& matched, bool by_odometry);

  route::Segment segment_;
  SegmentFollowerOptions options_;
  double gain_rad_per_px_;
  motion::OdometryIncrement driven_;
  TransitionDetector transition_;
  MedianFilter visual_fraction_{3};
};

}  // namespace trailcast::replay
