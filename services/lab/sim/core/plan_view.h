#pragma once

#include <Eigen/Core>

#include "services/image/image.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::sim {

struct PlanOptions {
  double metres_per_pixel = 0.02;
  // The world is cut open at this height and seen from above, without roof and lamps.
  double cut_z_m = 1.6;
};

// The world from straight above, in colour, to draw paths over. Pixel (px, py) shows the place x =
// x_min_m + px * metres_per_pixel, y = y_max_m - py * metres_per_pixel, with north up.
struct PlanView {
  image::RgbImage picture;
  double metres_per_pixel = 0.0;
  double x_min_m = 0.0;
  double y_max_m = 0.0;

  // Returns where a place of the world is on the picture, in pixels.
  [[nodiscard]] Eigen::Vector2d PixelOf(double x_m, double y_m) const {
    return {(x_m - x_min_m) / metres_per_pixel, (y_max_m - y_m) / metres_per_pixel};
  }
};

// The picture is coarser than requested if it would exceed 4000 pixels a side.
[[nodiscard]] PlanView RenderPlan(const World& world, const PlanOptions& options = {});

}  // namespace trailcast::sim
