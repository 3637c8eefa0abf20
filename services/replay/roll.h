#pragma once

#include <Eigen/Core>
#include <span>

namespace trailcast::replay {

// One feature's place in the current and in the stored image, pixels from the image centre.
struct ImagePair {
  Eigen::Vector2d current_px;
  Eigen::Vector2d stored_px;
};

struct RollOptions {
  int draws = 40;
  double largest_rad = 0.2;  // rolls beyond this (11 degrees) are mismatches
  double tolerance_px = 3.0;
  // With a smaller share of agreeing features the estimate is not trusted.
  double min_inlier_share = 0.3;
};

struct Roll {
  double angle_rad = 0.0;  // by which Unroll turns the current image
  int inliers = 0;         // 0: not enough agree, the angle is then 0
};

// In-plane rotation from the current image to the stored one by RANSAC over random pairs of
// features (Chen & Birchfield 2009, III): the one place where y-coordinates count. Each draw gives
// a rotation, a magnification and a shift. Repeatable for equal input.
[[nodiscard]] Roll EstimateRoll(std::span<const ImagePair> pairs, const RollOptions& options = {});

// The current point as it would be without that rotation.
[[nodiscard]] Eigen::Vector2d Unroll(const Eigen::Vector2d& current_px, double angle_rad);

}  // namespace trailcast::replay
