#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "services/motion/motion.h"
#include "services/replay/follower.h"
#include "services/replay/funnel_lane.h"
#include "services/replay/roll.h"
#include "services/replay/transition.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct FunnelFollowerOptions {
  // This is gamma, in radians per pixel of the scout's picture, scaled with its width. It is five
  // times the angle of one pixel of a usual webcam: the mean is over all features, and most ask for
  // no turn.
  double gain_rad_per_px_at_320 = 0.018;
  // Unless this is 0, the robot turns at this rate to the side that most features ask for, and uses
  // nothing else (the first version, ICRA 2006).
  double bang_bang_radps = 0.0;
  bool compensate_roll = true;
  double eta = 0.5;           // share of vision in the turn if there is odometry
  double turn_time_s = 0.15;  // duration of a desired turn
  double speed_factor = 1.0;
  motion::VelocityLimits limits{1.0, 0.8};
  RollOptions roll;
  TransitionOptions transition;
  // Without odometry delta has one term of three left and is too flat for its peak to be found. So
  // the segment also ends at this share of the taught tracks, a little early, because past the
  // milestone its features ask for the wrong turn.
  double end_fraction_without_odometry = 0.85;
  // A smaller share of the segment's features than this does not tell how far along it is, since
  // any two tracks can be matched somewhere.
  double share_to_tell_progress = 0.143;
  // This bounds a milestone that went by unnoticed: the segment ends this far past its taught
  // length.
  double overrun_share = 0.25;
  double overrun_m = 0.3;
  // These are floors under equation (2)'s sigmas. Without them the noise of odometry and heading
  // would decide in a straight or very short segment, or one of distant features.
  double min_feature_sigma_px_at_320 = 3.0;
  double min_distance_sigma_m = 0.2;
  double min_heading_sigma_rad = 0.1;
};

// This is the paper's control step: the funnel lane fused with the taught heading, and its test for
// a segment's end. It works without odometry too, by vision alone.
class FunnelFollower final : public Follower {
 public:
  // `scout_width_px` is of the scout's frames; `magnification` is the follower's pixels for each of
  // the scout's.
  FunnelFollower(int scout_width_px, double magnification,
                 const FunnelFollowerOptions& options = {});

  void Learn(const route::Segment& /*segment*/) override {}  // the segment has all that is needed
  [[nodiscard]] std::unique_ptr<Follower> Clone() const override {
    return std::make_unique<FunnelFollower>(*this);
  }
  void Begin(const route::Segment& segment) override;
  void BeginAt(const route::Segment& segment, double fraction) override;
  void BeginAbout(const route::Segment& segment, double fraction,
                  const RoughPlace& /*rough*/) override {
    BeginAt(segment, fraction);
  }
  void CountAlong(const route::Segment& earlier, double along_m,
                  const motion::Pose2& /*there*/) override {
    BeginAt(earlier, earlier.length_m > 0.0 ? along_m / earlier.length_m : 0.0);
  }
  [[nodiscard]] std::vector<route::TrackedFeature> Expect() const override {
    return ExpectAt(fraction_);
  }
  [[nodiscard]] std::vector<route::TrackedFeature> ExpectAtMilestone() const override {
    return ExpectAt(1.0);
  }
  // It does not know how far off the path or the heading it is.
  [[nodiscard]] double expected_within_px_at_320() const override { return 56.0; }
  // The paper trusts all tracked features.
  [[nodiscard]] double outlier_px() const override {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] double magnification() const override { return magnification_; }
  void SetMagnification(double magnification) override { magnification_ = magnification; }
  [[nodiscard]] FollowStep Step(const FollowInput& input) override;
  [[nodiscard]] const route::Segment& segment() const override { return segment_; }

 private:
  struct Matched;

  [[nodiscard]] std::vector<route::TrackedFeature> ExpectAt(double fraction) const;
  [[nodiscard]] Matched Match(const std::vector<route::TrackedFeature>& features) const;
  [[nodiscard]] double VisionTurn(const Matched& matched) const;
  [[nodiscard]] double OdometryTurn(double speed_mps) const;
  [[nodiscard]] TransitionErrors OdometryErrors() const;
  [[nodiscard]] bool TellsProgress(const Matched& matched) const;
  [[nodiscard]] double Fraction(const Matched& matched, bool by_odometry);
  [[nodiscard]] bool Ended(const Matched& matched, bool by_odometry, FollowStep& step);

  FunnelFollowerOptions options_;
  double gain_rad_per_px_;
  double min_feature_sigma_px_;
  double magnification_;
  route::Segment segment_;
  motion::OdometryIncrement driven_;  // since the segment's start
  // These are the same at the times of the images over which delta is smoothed. The milestone was
  // in the middle of those for which it was highest.
  std::deque<motion::OdometryIncrement> driven_lately_;
  motion::OdometryIncrement driven_at_peak_;
  TransitionDetector transition_;
  MedianFilter visual_fraction_;
  double fraction_ = 0.0;
  bool begun_ = false;
};

}  // namespace trailcast::replay
