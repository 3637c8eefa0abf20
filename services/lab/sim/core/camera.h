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
  kOmni,     // a mirror: a donut with ahead at the top, the robot's right at the right, and up
             // outwards
};

// A camera and its mount on the robot. In its frame x is right, y down, z ahead. Pixel (0, 0) is
// the centre of the upper left pixel, so the middle of the picture is ((width - 1) / 2, ...).
struct CameraModel {
  std::string name;
  int width = 320;
  int height = 240;
  LensModel model = LensModel::kPinhole;
  // The angle between the middles of the left and right edges, including distortion; 360 for omni.
  double horizontal_fov_deg = 60.0;
  // Distortion is barrel above 0 and pincushion below. A ray that would lie at radius r lies at
  // about r (1 - distortion r^2), with r in focal lengths (division model, which is monotone
  // however strong).
  double distortion = 0.0;
  double height_m = 0.35;  // above the ground
  double yaw_deg = 0.0;    // to the left of straight ahead
  double pitch_deg = 0.0;  // upwards
  // These are errors of real cameras.
  double roll_deg = 0.0;  // clockwise as seen from behind it; 180: upside down
  double ahead_m = 0.0;   // of the axle about which the robot turns
  // How far the optical axis is off the picture's middle, to the right and down, as shares of its
  // width.
  double centre_u = 0.0;
  double centre_v = 0.0;
  // Somebody bumps into the camera so many seconds after it was switched on, and it looks further
  // to the left from then on. With 0 degrees nobody does.
  double knock_yaw_deg = 0.0;
  double knock_at_s = 0.0;
  // Auto exposure: the brightness wanders between this factor less and more, each within a period.
  double exposure_swing = 1.0;
  double exposure_period_s = 4.0;
  // Rolling shutter: the rows are read from first to last within this time; with 0, all at once.
  double readout_s = 0.0;
};

// The error says which key is wrong, its value and the accepted values.
[[nodiscard]] Result<void> Validate(const CameraModel& camera);
// Parses `pinhole`, `fisheye` or `omni`.
[[nodiscard]] Result<LensModel> ParseLensModel(const std::string& word);
// Returns the built-in cameras: webcam, firewire, wide, hd, fisheye, omni.
[[nodiscard]] const std::vector<CameraModel>& BuiltInCameras();
// kNotFound lists the existing names.
[[nodiscard]] Result<CameraModel> FindCamera(const std::string& name);

// The lens alone: the direction in which a pixel looks, and the pixel that sees a direction.
class Lens {
 public:
  // `camera` must be valid.
  explicit Lens(const CameraModel& camera);
  // Returns a unit vector in the camera frame, or nothing outside the lens's picture.
  [[nodiscard]] std::optional<Eigen::Vector3d> Direction(const Eigen::Vector2d& pixel) const;
  // Returns where a direction (of any length) falls, also beyond the picture's edge, or nothing if
  // the lens does not see it.
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

// Returns the rotation from the camera frame to the robot's (x ahead, y left, z up) for a mount's
// yaw, pitch and roll.
[[nodiscard]] Eigen::Matrix3d BodyFromCamera(double yaw_rad, double pitch_rad,
                                             double roll_rad = 0.0);

}  // namespace trailcast::sim
