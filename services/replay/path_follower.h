#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "services/replay/follower.h"
#include "services/replay/lane_keeping.h"
#include "services/replay/path_estimator.h"

namespace trailcast::replay {

struct PathFollowerOptions {
  PathEstimatorOptions estimator;
  LaneKeepingOptions lane_keeping;
  motion::VelocityLimits limits{1.0, 0.8};
  double speed_factor = 1.0;
  double base_delay_s = 0.15;  // from a command to its motion
  // With fewer features left, past this share of a segment, the next one's may serve better: a
  // camera with a narrower view loses the taught ones early.
  int few_features = 10;
  double early_fraction = 0.4;
  // These are for turning on the spot, if the path turns at least this much (smaller turns are made
  // up for while driving): the rate for each radian that is left, its least, and the angle at which
  // the turn is complete.
  double spot_turn_least_rad = 0.2;
  double spot_turn_gain_hz = 1.5;
  double spot_turn_slowest_radps = 0.2;
  double spot_turn_done_rad = 0.05;
  // Below this remaining angle it also uses the features, which come into view gradually.
  double spot_turn_looks_rad = 0.2;
};

// This follows by the widened funnel: it estimates where the robot is beside the taught path and
// steers back onto it. It needs odometry, in the route and on the robot.
class PathFollower final : public Follower {
 public:
  PathFollower(int scout_width_px, double magnification, const PathFollowerOptions& options = {});

  void Learn(const route::Segment& segment) override;
  [[nodiscard]] std::unique_ptr<Follower> Clone() const override {
    return std::make_unique<PathFollower>(*this);
  }
  void Begin(const route::Segment& segment) override;
  void BeginAt(const route::Segment& segment, double fraction) override;
  void BeginAbout(const route::Segment& segment, double fraction, const RoughPlace& rough) override;
  void CountAlong(const route::Segment& earlier, double along_m,
                  const motion::Pose2& there) override;
  [[nodiscard]] std::vector<route::TrackedFeature> Expect() const override {
    return estimator_.Expect();
  }
  [[nodiscard]] std::vector<route::TrackedFeature> ExpectAtMilestone() const override {
    return estimator_.ExpectAtMilestone();
  }
  // At the start this allows for 4 degrees of heading, mount yaw and pitch and for a few
  // centimetres beside near features; afterwards for what parallax and a bend leave over.
  [[nodiscard]] double expected_within_px_at_320() const override { return settled_ ? 28.0 : 45.0; }
  [[nodiscard]] double outlier_px() const override { return options_.estimator.outlier_px; }
  [[nodiscard]] double magnification() const override { return estimator_.magnification(); }
  // This is only the first guess. After that the estimate is better than any one hand-over's.
  void SetMagnification(double magnification) override;
  [[nodiscard]] bool turning() const override { return turning_; }
  [[nodiscard]] bool turn_is_in_view() const override {
    return turning_ && std::abs(offset().heading_rad) < options_.spot_turn_looks_rad;
  }
  [[nodiscard]] FollowStep Step(const FollowInput& input) override;
  [[nodiscard]] const route::Segment& segment() const override { return segment_; }
  [[nodiscard]] std::optional<CameraPlace> camera_place() const override {
    return estimator_.camera_place();
  }
  [[nodiscard]] std::optional<FocalLength> focal() const override { return estimator_.focal(); }
  [[nodiscard]] std::vector<InverseDepth> Depths(const route::Segment& segment) const override {
    return estimator_.Depths(segment);
  }

  [[nodiscard]] PathOffset offset() const;

 private:
  // These convert the estimator's distance along the segment to the driven one, and back.
  [[nodiscard]] double Driven_m(double along_m) const {
    return segment_.reverse ? segment_.length_m - along_m : along_m;
  }
  [[nodiscard]] double TurnRate(const PathOffset& along, double speed_mps, double aside_m) const;
  [[nodiscard]] FollowStep TurnOnTheSpot(const std::vector<route::TrackedFeature>& seen);

  PathFollowerOptions options_;
  PathEstimator estimator_;
  route::Segment segment_;
  bool begun_ = false;
  bool turning_ = false;  // on the spot, before the segment
  bool settled_ = false;  // has seen enough to know the magnification by itself
};

}  // namespace trailcast::replay
