#pragma once

#include <Eigen/Core>
#include <span>
#include <unordered_map>
#include <vector>

#include "services/route/tracked_feature.h"
#include "services/route/usual_camera.h"

namespace trailcast::teach {

struct VisualOdometryOptions {
  // Between two knots of a segment the speed changes evenly. The knots lie so far apart, or further
  // where the segment would need more intervals than the second figure.
  double interval_s = 0.2;
  int most_intervals = 16;
  // Noise of a feature's motion over an interval, in pixels of a picture 320 px wide, and how many
  // times the features' median residual the noise is at least. Residuals count by Cauchy's weight.
  double noise_px_at_320 = 0.4;
  double noise_of_median = 2.0;
  double cauchy_sigmas = 3.0;
  // The speed's random walk (a share of the usual speed per root second), its doubt where a segment
  // begins (a share of the usual speed), and how far from kUsualSpeed_mps it lies at all (a share).
  double speed_walk = 0.6;
  double speed_known = 0.03;
  double speed_spread = 0.5;
  // What is expected over an interval: of turns, and of pitch and roll on rough ground.
  double turn_rad = 0.5;
  double tilt_rad = 0.03;
  // The camera: its mount's yaw and pitch, the lens's widening (taught_flow.h), and how far ahead
  // of the axle it is.
  double mount_rad = 0.02;
  double widening = 0.8;
  double widening_sigma = 0.3;
  double ahead_m = 0.05;
  double ahead_sigma_m = 0.05;
  // The inverse depth of a feature that was never seen before, 1/m of the usual speed's metres.
  double inverse_depth_per_m = 0.2;
  double inverse_depth_sigma_per_m = 2.0;
  // A feature of the next segment is one of the last segment if both lie so close in the picture
  // where the segments meet. The relative error of its inverse depth is at least the second figure.
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
    double turned_rad = 0.0;             // about, by the picture; counter-clockwise
  };
  struct Place {
    double way_m = 0.0;  // since the segment's start; true up to the route's factor
    double turned_rad = 0.0;
  };

  explicit VisualOdometry(int width_px, const VisualOdometryOptions& options = {});

  // Where the robot was at each moment of the route's next segment. The way rises strictly where
  // `moving_s` does. Where the features tell nothing, the robot drives on as before.
  [[nodiscard]] std::vector<Place> Follow(std::span<const Moment> moments);

 private:
  struct Landmark;
  struct Fit;
  struct Equations;
  struct Known {  // a feature where the last segment ended
    route::TrackedFeature at;
    double inverse_depth = 0.0;
    double sigma = 0.0;
  };

  [[nodiscard]] Fit Prepare(std::span<const Moment> moments) const;
  [[nodiscard]] Landmark Meet(const route::TrackedFeature& feature) const;
  void Expect(const Fit& fit, Equations& equations) const;
  void Measure(Fit& fit, double cauchy_sigmas, Equations& equations) const;
  // False: the fit has failed.
  [[nodiscard]] bool Improve(Fit& fit, double cauchy_sigmas) const;
  [[nodiscard]] std::vector<Place> DriveOn(std::span<const Moment> moments) const;
  void Remember(const Fit& fit, const Features& last);

  VisualOdometryOptions options_;
  double scale_;  // of pixels, against a picture 320 px wide
  double focal_px_;
  double speed_mps_ = route::kUsualSpeed_mps;  // where the last segment ended
  double usual_mps_ = route::kUsualSpeed_mps;
  double speed_known_ = 0.01;  // a share: the first segment's speed defines the route's metres
  std::vector<Known> known_;
};

}  // namespace trailcast::teach
