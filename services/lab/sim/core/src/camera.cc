#include "services/lab/sim/core/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

// The mirror sees from the floor beside the robot to somewhat above the horizon.
constexpr double kMirrorLowest_rad = Radians(-40.0);
constexpr double kMirrorHighest_rad = Radians(25.0);
constexpr double kMirrorInnerShare = 0.3;  // of the donut's outer radius

Result<void> OutOfRange(const char* key, double given, const char* accepted) {
  return Fail(ErrorCode::kInvalidArgument, "camera {} = {} is not possible: expected {}", key,
              given, accepted);
}

bool IsWithin(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

// These values can be judged one by one.
Result<void> ValidateEach(const CameraModel& camera) {
  struct Range {
    const char* key;
    double value;
    double low;
    double high;
    const char* accepted;
  };
  const std::array<Range, 15> ranges{{
      {"width", 1.0 * camera.width, 16, 4096, "16 to 4096 pixels"},
      {"height", 1.0 * camera.height, 16, 4096, "16 to 4096 pixels"},
      {"distortion", camera.distortion, -0.5, 2, "-0.5 (pincushion) to 2 (barrel)"},
      {"height_m", camera.height_m, 0.02, 5, "0.02 to 5 metres"},
      {"yaw_deg", camera.yaw_deg, -180, 180, "-180 to 180 degrees"},
      {"pitch_deg", camera.pitch_deg, -60, 60, "-60 to 60 degrees"},
      {"roll_deg", camera.roll_deg, -180, 180, "-180 to 180 degrees"},
      {"ahead_m", camera.ahead_m, -2, 2, "-2 to 2 metres"},
      {"centre_u", camera.centre_u, -0.2, 0.2, "-0.2 to 0.2 of the width"},
      {"centre_v", camera.centre_v, -0.2, 0.2, "-0.2 to 0.2 of the width"},
      {"knock_yaw_deg", camera.knock_yaw_deg, -30, 30, "-30 to 30 degrees"},
      {"knock_at_s", camera.knock_at_s, 0, 1e6, "0 to 1000000 seconds"},
      {"exposure_swing", camera.exposure_swing, 1, 4, "1 (steady) to 4 times"},
      {"exposure_period_s", camera.exposure_period_s, 0.2, 1000, "0.2 to 1000 seconds"},
      {"readout_s", camera.readout_s, 0, 0.1, "0 to 0.1 seconds"},
  }};
  for (const Range& range : ranges) {
    if (IsWithin(range.value, range.low, range.high)) continue;
    return OutOfRange(range.key, range.value, range.accepted);
  }
  return {};
}

double LargestRadius(const CameraModel& camera) {
  const double half = Radians(camera.horizontal_fov_deg) / 2.0;
  return camera.model == LensModel::kPinhole ? std::tan(half) : half;
}

}  // namespace

Result<void> Validate(const CameraModel& camera) {
  if (auto each = ValidateEach(camera); !each) return each;
  const double fov = camera.horizontal_fov_deg;
  if (camera.model == LensModel::kPinhole && !IsWithin(fov, 5, 160)) {
    return OutOfRange("horizontal_fov_deg", fov, "5 to 160 degrees for a pinhole");
  }
  if (camera.model == LensModel::kFisheye && !IsWithin(fov, 20, 240)) {
    return OutOfRange("horizontal_fov_deg", fov, "20 to 240 degrees for a fisheye");
  }
  if (camera.model == LensModel::kOmni && fov != 360.0) {
    return OutOfRange("horizontal_fov_deg", fov, "360 degrees for an omni mirror");
  }
  // Beyond this, a pincushion folds the picture's edge back.
  const double diagonal = std::hypot(1.0, static_cast<double>(camera.height) / camera.width);
  if (camera.model != LensModel::kOmni && camera.distortion < 0.0 &&
      1.0 + 4.0 * camera.distortion * std::pow(diagonal * LargestRadius(camera), 2) <= 0.05) {
    return OutOfRange("distortion", camera.distortion, "less pincushion for so wide a view");
  }
  return {};
}

Result<LensModel> ParseLensModel(const std::string& word) {
  if (word == "pinhole") return LensModel::kPinhole;
  if (word == "fisheye") return LensModel::kFisheye;
  if (word == "omni") return LensModel::kOmni;
  return Fail(ErrorCode::kInvalidArgument,
              "camera model \"{}\" is unknown: expected pinhole, fisheye or omni", word);
}

const std::vector<CameraModel>& BuiltInCameras() {
  static const std::vector<CameraModel> cameras = {
      {"webcam", 320, 240, LensModel::kPinhole, 60.0, 0.10, 0.35},
      {"firewire", 320, 240, LensModel::kPinhole, 36.0, 0.0, 0.40},
      {"wide", 320, 240, LensModel::kPinhole, 110.0, 0.25, 0.35},
      {"hd", 640, 480, LensModel::kPinhole, 75.0, 0.03, 0.45},
      {"fisheye", 480, 480, LensModel::kFisheye, 170.0, 0.0, 0.45},
      {"omni", 480, 480, LensModel::kOmni, 360.0, 0.0, 0.60},
  };
  return cameras;
}

Result<CameraModel> FindCamera(const std::string& name) {
  std::string names;
  for (const CameraModel& camera : BuiltInCameras()) {
    if (camera.name == name) return camera;
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  return Fail(ErrorCode::kNotFound, "no camera is called \"{}\": expected one of {}, or a file",
              name, names);
}

Lens::Lens(const CameraModel& camera)
    : model_(camera.model),
      distortion_(camera.distortion),
      largest_angle_rad_(Radians(camera.horizontal_fov_deg) / 2.0),
      middle_((camera.width - 1) / 2.0 + camera.centre_u * camera.width,
              (camera.height - 1) / 2.0 + camera.centre_v * camera.width) {
  outer_px_ = std::min(camera.width, camera.height) / 2.0;
  inner_px_ = kMirrorInnerShare * outer_px_;
  if (model_ != LensModel::kOmni) focal_px_ = camera.width / 2.0 / RadiusOf(largest_angle_rad_);
}

double Lens::RadiusOf(double angle_rad) const {
  const double r = model_ == LensModel::kPinhole ? std::tan(angle_rad) : angle_rad;
  return 2.0 * r / (1.0 + std::sqrt(std::max(0.0, 1.0 + 4.0 * distortion_ * r * r)));
}

double Lens::AngleAt(double radius) const {
  const double r = radius / (1.0 - distortion_ * radius * radius);
  return model_ == LensModel::kPinhole ? std::atan(r) : r;
}

std::optional<Eigen::Vector3d> Lens::MirrorDirection(const Eigen::Vector2d& offset) const {
  const double radius = offset.norm();
  if (radius < inner_px_ || radius > outer_px_) return std::nullopt;
  const double share = (radius - inner_px_) / (outer_px_ - inner_px_);
  const double elevation = kMirrorLowest_rad + share * (kMirrorHighest_rad - kMirrorLowest_rad);
  const Eigen::Vector2d bearing = offset / radius;
  return Eigen::Vector3d(std::cos(elevation) * bearing.x(), -std::sin(elevation),
                         -std::cos(elevation) * bearing.y());
}

Eigen::Vector2d Lens::MirrorProject(const Eigen::Vector3d& direction) const {
  const double level = std::hypot(direction.x(), direction.z());
  const double elevation = std::atan2(-direction.y(), level);
  const double share = (elevation - kMirrorLowest_rad) / (kMirrorHighest_rad - kMirrorLowest_rad);
  const double radius = inner_px_ + share * (outer_px_ - inner_px_);
  return middle_ + radius / level * Eigen::Vector2d(direction.x(), -direction.z());
}

std::optional<Eigen::Vector3d> Lens::Direction(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d offset = pixel - middle_;
  if (model_ == LensModel::kOmni) return MirrorDirection(offset);
  const double radius = offset.norm() / focal_px_;
  if (distortion_ > 0.0 && distortion_ * radius * radius >= 0.999) return std::nullopt;
  const double angle = AngleAt(radius);
  if (model_ == LensModel::kFisheye && angle > largest_angle_rad_) return std::nullopt;
  if (radius < 1e-12) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d side = std::sin(angle) / (radius * focal_px_) * offset;
  return Eigen::Vector3d(side.x(), side.y(), std::cos(angle));
}

std::optional<Eigen::Vector2d> Lens::Project(const Eigen::Vector3d& direction) const {
  const double side = std::hypot(direction.x(), direction.y());
  if (model_ == LensModel::kOmni) {
    if (std::hypot(direction.x(), direction.z()) < 1e-12) return std::nullopt;
    return MirrorProject(direction);
  }
  const double angle = std::atan2(side, direction.z());
  if (model_ == LensModel::kPinhole && angle >= Radians(89.9)) return std::nullopt;
  if (side < 1e-12) return middle_;
  return middle_ + focal_px_ * RadiusOf(angle) / side * direction.head<2>();
}

Eigen::Matrix3d BodyFromCamera(double yaw_rad, double pitch_rad, double roll_rad) {
  Eigen::Matrix3d level;
  level << 0, 0, 1,  //
      -1, 0, 0,      //
      0, -1, 0;
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
         Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() * level *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace trailcast::sim
