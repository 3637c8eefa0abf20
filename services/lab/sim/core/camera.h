#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::sim {

enum class LensModel {
  kPinhole,  // radius f tan(angle), bent by `distortion`
  kFisheye,  // equidistant: radius f times angle, bent by `distortion`; black beyond the lens
  kOmni,     // mirror: a donut, ahead at the top, the robot's right at the right, outwards is up
};

// A camera and how it sits on its robot. Camera frame: x right, y down, z ahead. Pixel (0, 0) is
// the centre of the upper left pixel, so the middle of the picture is ((width - 1) / 2, ...).
struct CameraModel {
  std::string name;
  int width = 320;
  int height = 240;
  LensModel model = LensModel::kPinhole;
  // Angle between the middles of the left and right edges, distortion included; 360 for omni.
  double horizontal_fov_deg = 60.0;
  // Barrel above 0, pincushion below: a ray at radius r without it comes to lie at about
  // r (1 - distortion r^2), r in focal lengths (division model, monotone however strong).
  double distortion = 0.0;
  double height_m = 0.35;  // above the ground
  double yaw_deg = 0.0;    // to the left of straight ahead
  double pitch_deg = 0.0;  // upwards
  // What real cameras do wrong.
  double roll_deg = 0.0;  // clockwise as seen from behind it; 180: upside down
  double ahead_m = 0.0;   // of the axle that the robot turns about
  // Where the lens looks, off the picture's middle, to the right and down: shares of its width.
  double centre_u = 0.0;
  double centre_v = 0.0;
  // Somebody bumps into it so many seconds after it was switched on, and it looks further to the
  // left from then on. 0 degrees: nobody does.
  double knock_yaw_deg = 0.0;
  double knock_at_s = 0.0;
  // Auto exposure: brightness wanders between so many times less and more, each within a period.
  double exposure_swing = 1.0;
  double exposure_period_s = 4.0;
  // Rolling shutter: its rows are read from the first to the last within so long; 0: all at once.
  double readout_s = 0.0;
};

// Says which key is wrong, what it is and what is accepted.
[[nodiscard]] Result<void> Validate(const CameraModel& camera);
// `pinhole`, `fisheye` or `omni`.
[[nodiscard]] Result<LensModel> ParseLensModel(const std::string& word);
// The built-in set: webcam, firewire, wide, hd, fisheye, omni.
[[nodiscard]] const std::vector<CameraModel>& BuiltInCameras();
// kNotFound lists the names there are.
[[nodiscard]] Result<CameraModel> FindCamera(const std::string& name);

// The lens alone: which way a pixel looks, and where a direction is seen.
class Lens {
 public:
  // `camera` must be valid.
  explicit Lens(const CameraModel& camera);
  // Unit vector in the camera frame, or nothing outside the lens's picture.
  [[nodiscard]] std::optional<Eigen::Vector3d> Direction(const Eigen::Vector2d& pixel) const;
  // Where a direction (any length) falls, also beyond the picture's edge; nothing if nowhere.
  [[nodiscard]] std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& direction) const;

 private:
  [[nodiscard]] double RadiusOf(double angle_rad) const;  // in focal lengths, distorted
  [[nodiscard]] double AngleAt(double radius) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> MirrorDirection(const Eigen::Vector2d& offset) const;
  [[nodiscard]] Eigen::Vector2d MirrorProject(const Eigen::Vector3d& direction) const;

  LensModel model_;
  double distortion_;
  double largest_angle_rad_;
  Eigen::Vector2d middle_;
  double focal_px_ = 1.0;
  double inner_px_ = 0.0;
  double outer_px_ = 0.0;
};

// Rotation from the camera frame to the robot's (x ahead, y left, z up) by its mount's yaw, pitch,
// roll.
[[nodiscard]] Eigen::Matrix3d BodyFromCamera(double yaw_rad, double pitch_rad,
                                             double roll_rad = 0.0);

}  // namespace trailcast::sim
