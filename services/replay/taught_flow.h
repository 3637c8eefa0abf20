#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/replay/focal_length.h"
#include "services/route/route.h"
#include "services/route/usual_camera.h"

namespace trailcast::replay {

// Inverse depth of a landmark, 1/m, and how sure it is.
struct InverseDepth {
  double at_start_per_m = 0.0;  // from the camera's place at the segment's first image
  double sigma_per_m = 0.0;

  // From the camera's place `along_m` into the segment; the landmark comes nearer.
  [[nodiscard]] double At(double along_m) const;
  // How much larger it looks from one place than from another.
  [[nodiscard]] double Growth(double from_m, double to_m) const;
};

// The scout's camera as the route itself shows it, in the scout's pixels from its image centre.
struct ScoutCamera {
  double focal_px = 0.0;
  // How a turn's flow grows away from the image centre, f (1 + c u^2 / f^2): 1 for a pinhole, near
  // 0 for a fisheye.
  double widening = 1.0;
  // Focus of expansion: where the camera was going, which its mount puts off the image centre.
  double ahead_u_px = 0.0;
  double ahead_v_px = 0.0;

  // Where a feature at (u, v) is after a turn to the left, however large: its flow integrated.
  [[nodiscard]] Eigen::Vector2d Turned(const Eigen::Vector2d& place, double turn_rad) const;
  // Flow of a feature at (u, v) for a small turn to the left, pixels per radian.
  [[nodiscard]] double TurnU(double u_px) const {
    return focal_px + widening * u_px * u_px / focal_px;
  }
  [[nodiscard]] double TurnV(double u_px, double v_px) const {
    return widening * u_px * v_px / focal_px;
  }
};

// Noise alone makes depths differ, and depths that differ seem to say how far beside the path a
// camera is. So each is drawn towards their mean, the more so the less sure it is against the
// spread that noise does not explain (empirical Bayes): landmarks that are all far away come out
// at one distance, those at many distances stay where they are. Fewer than five stay as well.
void DrawTogether(std::vector<InverseDepth>& depths);

struct TaughtFlowOptions {
  // What is believed before anything was seen: a usual webcam, and how far from one it may be.
  double focal_share = route::kUsualFocalShare;  // of the picture's width
  double focal_sigma = 0.4;                      // relative
  double widening = 0.8;
  double widening_sigma = 0.5;
  double mount_sigma_rad = 0.05;
  // Of the taught heading at each quarter of a segment: wheels slip, and the polynomial that is
  // stored smooths what the robot did, a sharp bend most of all.
  double heading_error_rad = 0.05;
  // Of a stretch between two knots, at least: a camera that rolls and pitches on rough ground moves
  // all that it sees by more. What the features of a segment are off by in the median counts as
  // so many times that, for they are off together.
  double track_noise_px_at_320 = 0.7;
  double noise_together = 2.0;
};

// What taught tracks tell by their flow. A landmark's flow is what the turn makes of it, and, away
// from the focus of expansion, what driving past it makes of it:
//   du = turn f (1 + c u^2 / f^2) + rho (u - u0) ds        dv = turn c u v / f + rho (v - v0) ds
// so that each feature's inverse depth rho comes out in the scout's own metres, and f, c and the
// focus of expansion come out of the whole route: no calibration. The turn is odometry's, which
// errs: a wrong turn would give features left and right of the camera opposite errors of depth and,
// where the path is straight, any focal length. So its error is one of the unknowns, and goes in a
// straight line from quarter to quarter of the segment: of what a polynomial misses of a sharp bend
// a polynomial misses as much.
class TaughtFlow {
 public:
  explicit TaughtFlow(int scout_width_px, const TaughtFlowOptions& options = {});

  // Learns the camera from one more segment of the route. The more of them before the first Depths,
  // the better: bends tell what straight stretches do not.
  void Learn(const route::Segment& segment);
  // The inverse depths of a segment's features, in their order.
  [[nodiscard]] std::vector<InverseDepth> Depths(const route::Segment& segment) const;
  [[nodiscard]] const ScoutCamera& camera() const { return camera_; }
  [[nodiscard]] FocalLength focal() const;

 private:
  // The camera's unknowns, and the segment's: the error of its heading at each quarter, which is
  // nothing at its beginning.
  static constexpr int kCamera = 4;
  static constexpr int kHeading = 4;
  static constexpr int kSize = kCamera + kHeading;
  enum Index { kAheadU, kAheadV, kLogFocal, kWidening };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using CameraVector = Eigen::Matrix<double, kCamera, 1>;
  using CameraMatrix = Eigen::Matrix<double, kCamera, kCamera>;
  using HeadingVector = Eigen::Matrix<double, kHeading, 1>;

  // Two knots of a feature's track and what lies between.
  struct Stretch {
    double middle_m = 0.0;
    double length_m = 0.0;
    double turn_rad = 0.0;
    // What each quarter's error adds to the turn.
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
  // What a segment says of itself and of the camera.
  struct Fit {
    std::vector<Landmark> landmarks;
    Vector unknowns = Vector::Zero();
    Matrix information = Matrix::Zero();
    double noise_px = 0.0;
  };
  // The heading's error so far along a segment, 0..1, is what it is at the quarters times these.
  [[nodiscard]] static HeadingVector BetweenQuarters(double s);
  [[nodiscard]] static Landmark MakeLandmark(const route::Segment& segment,
                                             const route::Feature& feature);
  // Of a stretch. The camera is learnt by what a segment's features are off by, if that is more
  // than a tracker's noise: rough ground shakes all of them together. It says nothing of how far
  // landmarks are from each other, and depths that count for less would be drawn together: one that
  // drives on rough ground would no longer tell where beside its path it is.
  enum class Noise { kOfTracker, kAsMeasured };
  [[nodiscard]] Fit FitTo(const route::Segment& segment, Noise noise) const;
  void Improve(Fit& fit, double length_m) const;
  // What the unknowns make of a stretch's flow, term by term, and what that leaves of it.
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
