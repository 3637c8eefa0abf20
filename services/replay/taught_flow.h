#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/replay/focal_length.h"
#include "services/route/route.h"
#include "services/route/usual_camera.h"

namespace trailcast::replay {

// This is the inverse depth of a landmark, in 1/m, with its standard deviation.
struct InverseDepth {
  double at_start_per_m = 0.0;  // from the camera's place at the segment's first image
  double sigma_per_m = 0.0;

  // Returns it from the camera's place `along_m` into the segment, where the landmark is nearer.
  [[nodiscard]] double At(double along_m) const;
  // Returns how much larger it looks from one place than from another.
  [[nodiscard]] double Growth(double from_m, double to_m) const;
};

// This is the scout's camera as the route itself shows it, in the scout's pixels from its image
// centre.
struct ScoutCamera {
  double focal_px = 0.0;
  // This is how a turn's flow grows away from the image centre, f (1 + c u^2 / f^2): 1 for a
  // pinhole, near 0 for a fisheye.
  double widening = 1.0;
  // This is the focus of expansion: the camera's direction of motion, which its mount puts off the
  // image centre.
  double ahead_u_px = 0.0;
  double ahead_v_px = 0.0;

  // Returns where a feature at (u, v) is after a turn to the left of any size, from its integrated
  // flow.
  [[nodiscard]] Eigen::Vector2d Turned(const Eigen::Vector2d& place, double turn_rad) const;
  // Returns the flow of a feature at (u, v) for a small turn to the left, in pixels per radian.
  [[nodiscard]] double TurnU(double u_px) const {
    return focal_px + widening * u_px * u_px / focal_px;
  }
  [[nodiscard]] double TurnV(double u_px, double v_px) const {
    return widening * u_px * v_px / focal_px;
  }
};

// Noise alone makes depths differ, and depths that differ seem to tell how far beside the path a
// camera is. So this draws each towards their mean, and the less sure it is relative to the spread
// that noise does not explain, the more (empirical Bayes). Landmarks that are all far away get one
// distance, and those at many distances stay where they are. Fewer than five stay as well.
void DrawTogether(std::vector<InverseDepth>& depths);

struct TaughtFlowOptions {
  // This is the prior: a usual webcam, and how far from one it may be.
  double focal_share = route::kUsualFocalShare;  // share of the picture's width
  double focal_sigma = 0.4;                      // relative
  double widening = 0.8;
  double widening_sigma = 0.5;
  double mount_sigma_rad = 0.05;
  // This is of the taught heading at each quarter of a segment: wheels slip, and the stored
  // polynomial smooths what the robot did, most of all in a sharp bend.
  double heading_error_rad = 0.05;
  // This is the least noise between two knots: a camera that rolls and pitches on rough ground
  // moves everything by more. The median error of a segment's features counts this many times,
  // since they are off together.
  double track_noise_px_at_320 = 0.7;
  double noise_together = 2.0;
};

// This takes the camera and depths from the flow of taught tracks. A landmark's flow comes from the
// turn and, away from the focus of expansion, from driving past it:
//   du = turn f (1 + c u^2 / f^2) + rho (u - u0) ds        dv = turn c u v / f + rho (v - v0) ds
// So each feature's inverse depth rho comes out in the scout's own metres, and f, c and the focus
// of expansion come out of the whole route, without calibration. The turn is odometry's, which has
// errors: a wrong turn would give features left and right of the camera opposite errors of depth
// and, on a straight path, any focal length. So its error is one of the unknowns, and is linear
// from quarter to quarter of the segment, since another polynomial would miss as much of a sharp
// bend as the stored one does.
class TaughtFlow {
 public:
  explicit TaughtFlow(int scout_width_px, const TaughtFlowOptions& options = {});

  // Learns the camera from one more segment of the route. The first Depths should come after as
  // many of them as possible, since bends tell what straight parts do not.
  void Learn(const route::Segment& segment);
  // Returns the inverse depths of a segment's features, in their order.
  [[nodiscard]] std::vector<InverseDepth> Depths(const route::Segment& segment) const;
  [[nodiscard]] const ScoutCamera& camera() const { return camera_; }
  [[nodiscard]] FocalLength focal() const;

 private:
  // These count the camera's unknowns, and the segment's: the error of its heading at each quarter,
  // which is zero at its beginning.
  static constexpr int kCamera = 4;
  static constexpr int kHeading = 4;
  static constexpr int kSize = kCamera + kHeading;
  enum Index { kAheadU, kAheadV, kLogFocal, kWidening };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using CameraVector = Eigen::Matrix<double, kCamera, 1>;
  using CameraMatrix = Eigen::Matrix<double, kCamera, kCamera>;
  using HeadingVector = Eigen::Matrix<double, kHeading, 1>;

  // This is the part of a feature's track between two knots.
  struct Stretch {
    double middle_m = 0.0;
    double length_m = 0.0;
    double turn_rad = 0.0;
    // This is what each quarter's error adds to the turn.
    HeadingVector turn_error = HeadingVector::Zero();
    double u_px = 0.0;
    double v_px = 0.0;
    double du_px = 0.0;
    double dv_px = 0.0;
  };
  struct Landmark {
    std::vector<Stretch> stretches;
    InverseDepth depth;
  };
  struct Equations;
  // This is what a segment tells of itself and of the camera.
  struct Fit {
    std::vector<Landmark> landmarks;
    Vector unknowns = Vector::Zero();
    Matrix information = Matrix::Zero();
    double noise_px = 0.0;
  };
  // The heading's error at a place of a segment, 0..1, is the product of these and its values at
  // the quarters.
  [[nodiscard]] static HeadingVector BetweenQuarters(double s);
  [[nodiscard]] static Landmark MakeLandmark(const route::Segment& segment,
                                             const route::Feature& feature);
  // This is the noise of such a part. The camera is learnt with the error of a segment's features,
  // if that is more than a tracker's noise, since rough ground shakes all of them together. That
  // error does not tell how far landmarks are from each other, and depths that count for less would
  // be drawn together: a robot on rough ground would no longer know where beside its path it is.
  enum class Noise { kOfTracker, kAsMeasured };
  [[nodiscard]] Fit FitTo(const route::Segment& segment, Noise noise) const;
  void Improve(Fit& fit, double length_m) const;
  // These are the terms of a part's flow by the unknowns, and the remainder.
  struct Flow {
    double turn_rad = 0.0;
    Eigen::Vector2d wide = Eigen::Vector2d::Zero();  // (u^2, u v) / f
    Eigen::Vector2d out = Eigen::Vector2d::Zero();   // from the focus of expansion
    double nearer = 0.0;                             // rho ds
    Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  };
  [[nodiscard]] static Flow FlowOf(const Stretch& stretch, const InverseDepth& depth,
                                   const Vector& unknowns);
  [[nodiscard]] double NoiseOf(const Fit& fit) const;
  [[nodiscard]] static Equations Linearise(const Landmark& landmark, const Fit& fit);
  void Use(const CameraVector& camera);

  TaughtFlowOptions options_;
  double noise_px_;
  ScoutCamera camera_;
  CameraVector mean_;
  CameraMatrix information_;
};

}  // namespace trailcast::replay
