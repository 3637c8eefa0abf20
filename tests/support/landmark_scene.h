#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "services/motion/motion.h"
#include "services/route/tracked_feature.h"

namespace trailcast::test {

// This is how the ground tilts a robot. Clockwise roll makes the world turn counter-clockwise in
// its picture; pitch is nose down.
struct Tilt {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
};

// These are landmarks in space, seen by an ideal camera on a robot in the plane: features without
// images.
class LandmarkScene {
 public:
  static constexpr double kFocal_px = 280.0;
  static constexpr double kHalfWidth_px = 160.0;
  static constexpr double kHalfHeight_px = 120.0;

  explicit LandmarkScene(std::vector<Eigen::Vector3d> landmarks)
      : landmarks_(std::move(landmarks)) {}

  // The landmarks are scattered on both sides of the x axis, 1 to 4 m off it.
  static LandmarkScene Corridor(double from_m, double to_m, int count, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    std::vector<Eigen::Vector3d> landmarks;
    for (int i = 0; i < count; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      // Statements in this order make the same scene with any compiler.
      const double up_m = uniform(-1.0, 1.5);
      const double beside_m = side * uniform(1.0, 4.0);
      landmarks.emplace_back(uniform(from_m, to_m), beside_m, up_m);
    }
    return LandmarkScene(landmarks);
  }

  // Returns the landmarks in view from a robot at `pose_world`. The id is the landmark's number.
  [[nodiscard]] std::vector<route::TrackedFeature> Look(const motion::Pose2& pose_world,
                                                        const Tilt& tilt = {},
                                                        double focal_px = kFocal_px) const {
    std::vector<route::TrackedFeature> features;
    const double sine = std::sin(tilt.pitch_rad);
    const double cosine = std::cos(tilt.pitch_rad);
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const motion::Pose2 seen =
          motion::Between(pose_world, {landmarks_[i].x(), landmarks_[i].y(), 0.0});
      const double ahead_m = cosine * seen.x_m - sine * landmarks_[i].z();
      const double up_m = sine * seen.x_m + cosine * landmarks_[i].z();
      if (ahead_m < 0.3) continue;
      const Eigen::Vector2d upright(-focal_px * seen.y_m / ahead_m, -focal_px * up_m / ahead_m);
      const Eigen::Vector2d at = Eigen::Rotation2Dd(tilt.roll_rad) * upright;
      if (std::abs(at.x()) > kHalfWidth_px || std::abs(at.y()) > kHalfHeight_px) continue;
      features.push_back({static_cast<int>(i), at.x(), at.y()});
    }
    return features;
  }

 private:
  std::vector<Eigen::Vector3d> landmarks_;
};

}  // namespace trailcast::test
