#pragma once

#include <Eigen/Core>
#include <span>
#include <unordered_map>
#include <vector>

#include "services/route/tracked_feature.h"
#include "services/route/usual_camera.h"

namespace trailcast::teach {

struct VisualOdometryOptions {
  // The speed changes linearly between two knots of a segment. Knots are this far apart, or further
  // if the segment would need more intervals than the second figure.
  double interval_s = 0.2;
  int most_intervals = 16;
  // These are the noise of a feature's motion over an interval, in pixels of a picture 320 px wide,
  // its least multiple of the features' median residual, and the width of the Cauchy weights of
  // residuals.
  double noise_px_at_320 = 0.4;
  double noise_of_median = 2.0;
  double cauchy_sigmas = 3.0;
  // These are the speed's random walk (a share of the usual speed per root second), its uncertainty
  // where a segment begins (a share of the usual speed), and how far it lies from kUsualSpeed_mps
  // at all (a share).
  double speed_walk = 0.6;
  double speed_known = 0.03;
  double speed_spread = 0.5;
  // These are the expected turn over an interval, and the expected pitch and roll on rough ground.
  double turn_rad = 0.5;
  double tilt_rad = 0.03;
  // These are of the camera: its mount's yaw and pitch, the lens's widening (taught_flow.h), and
  // how far it is ahead of the axle.
  double mount_rad = 0.02;
  double widening = 0.8;
  double widening_sigma = 0.3;
  double ahead_m = 0.05;
  double ahead_sigma_m = 0.05;
  // This is the inverse depth of a feature that was never seen before, in 1/m of the usual speed's
  // metres.
  double inverse_depth_per_m = 0.2;
  double inverse_depth_sigma_per_m = 2.0;
  // A feature of the next segment is taken for one of the last segment if they are no further apart
  // than this in the picture where the segments meet. The relative error of its inverse depth is at
  // least the second figure.
  double same_px_at_320 = 2.0;
  double same_inverse_depth = 0.07;
};

// Monocular visual odometry of a scout without odometry. Features move away from the point that the
// camera drives towards, the faster the nearer they are and the faster the robot drives; that they
// go on doing so tells how the speed changes, up to one factor of the whole route. The factor is
// handed on between segments by the features that both see where they meet, and by the speed, which
// does not jump.
//
// Each segment is one non-linear least-squares fit (Gauss-Newton, robust weights). Its unknowns are
// the camera, the turn, pitch and roll over each interval, the speed at each knot, and each
// feature's inverse depth, which is eliminated (Schur complement). A feature at (u, v) with inverse
// depth rho moves over an interval by
//   du = turn (f + c u^2 / f) + pitch c u v / f - roll v + rho way (u - u0) + f rho ahead turn,
//   dv = turn c u v / f + pitch (f + c v^2 / f) + roll u + rho way (v - v0),
// in which (u0, v0) is the point that is driven towards and c the lens's widening.
class VisualOdometry {
 public:
  using Features = std::unordered_map<int, route::TrackedFeature>;
  struct Moment {
    double moving_s = 0.0;               // since the segment's start, without standing
    const Features* features = nullptr;  // in view; a feature has the same id throughout
    double turned_rad = 0.0;             // roughly, by the picture; counter-clockwise
  };
  struct Place {
    double way_m = 0.0;  // since the segment's start; true up to the route's factor
    double turned_rad = 0.0;
  };

  explicit VisualOdometry(int width_px, const VisualOdometryOptions& options = {});

  // Returns where the robot was at each moment of the route's next segment. The path's length rises
  // strictly where `moving_s` does. Where the features tell nothing, the robot drives on as before.
  [[nodiscard]] std::vector<Place> Follow(std::span<const Moment> moments);

 private:
  struct Landmark;
  struct Fit;
  struct Equations;
  struct Known {  // a feature at the end of the last segment
    route::TrackedFeature at;
    double inverse_depth = 0.0;
    double sigma = 0.0;
  };

  [[nodiscard]] Fit Prepare(std::span<const Moment> moments) const;
  [[nodiscard]] Landmark Meet(const route::TrackedFeature& feature) const;
  void Expect(const Fit& fit, Equations& equations) const;
  void Measure(Fit& fit, double cauchy_sigmas, Equations& equations) const;
  // Returns false if the fit has failed.
  [[nodiscard]] bool Improve(Fit& fit, double cauchy_sigmas) const;
  [[nodiscard]] std::vector<Place> DriveOn(std::span<const Moment> moments) const;
  void Remember(const Fit& fit, const Features& last);

  VisualOdometryOptions options_;
  double scale_;  // of pixels, relative to a picture 320 px wide
  double focal_px_;
  double speed_mps_ = route::kUsualSpeed_mps;  // at the end of the last segment
  double usual_mps_ = route::kUsualSpeed_mps;
  double speed_known_ = 0.01;  // as a share; the first segment's speed defines the route's metres
  std::vector<Known> known_;
};

}  // namespace trailcast::teach
