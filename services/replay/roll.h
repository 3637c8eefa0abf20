#pragma once

#include <Eigen/Core>
#include <span>

namespace trailcast::replay {

// This is one feature's place in the current and in the stored image, in pixels from the image
// centre.
struct ImagePair {
  Eigen::Vector2d current_px;
  Eigen::Vector2d stored_px;
};

struct RollOptions {
  int draws = 40;
  double largest_rad = 0.2;  // rolls beyond this (11 degrees) are mismatches
  double tolerance_px = 3.0;
  // If a smaller share of features agrees, the estimate is not trusted.
  double min_inlier_share = 0.3;
};

struct Roll {
  double angle_rad = 0.0;  // Unroll turns the current image by this
  int inliers = 0;         // 0 if too few agree, and then the angle is 0 too
};

// Returns the in-plane rotation from the current image to the stored one by RANSAC over random
// pairs of features (Chen & Birchfield 2009, III), the one place where y-coordinates count. Each
// draw gives a rotation, a magnification and a shift. Equal input gives equal output.
[[nodiscard]] Roll EstimateRoll(std::span<const ImagePair> pairs, const RollOptions& options = {});

// Returns the current point as it would be without that rotation.
[[nodiscard]] Eigen::Vector2d Unroll(const Eigen::Vector2d& current_px, double angle_rad);

}  // namespace trailcast::replay
