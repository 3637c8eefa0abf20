#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/plot/drawing.h"

namespace trailcast::plot {

// A rectangle of the world's plane in metres, y up.
struct PlanArea {
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d size_m() const { return max_m - min_m; }
};

// The world seen from above, drawn under the paths.
struct Backdrop {
  image::RgbImage picture;  // its upper left pixel is at (min x, max y) of `area`
  PlanArea area;
};

struct PlottedPath {
  std::string label;  // for the legend; an empty one is left out of it
  image::Color color{};
  std::vector<Eigen::Vector2d> points_m;
  bool taught = false;  // drawn dashed and thicker, below the others
  bool failed = false;  // a cross marks its end instead of a disc
  bool band = false;    // a broad band below all others, without a disc
};

struct Plan {
  std::string title;
  std::optional<Backdrop> backdrop;
  std::vector<PlottedPath> paths;
};

// Returns the smallest area that holds all paths, with `margin_m` around it.
[[nodiscard]] PlanArea AreaAround(const std::vector<PlottedPath>& paths, double margin_m);

// Draws a picture with a legend and with axes in metres, both to the same scale, as in the paper's
// Fig. 4. It shows the backdrop's area or, without one, the area around the paths.
[[nodiscard]] Drawing DrawPlan(const Plan& plan);

// The timing of discs that drive over a plan: how long each path takes, and how much later the next
// one begins.
struct PlanMotion {
  double takes_s = 10.0;
  double apart_s = 1.0;
};

// Writes the plan as SVG in which a disc drives along each path except bands, at a constant speed,
// over and over. Errors are those of Drawing::Write, and kInvalidArgument if the file's name does
// not end in ".svg".
[[nodiscard]] Result<void> WriteMovingPlan(const Plan& plan, const PlanMotion& motion,
                                           const std::filesystem::path& file);

// Returns a colour from a palette that most people can tell apart (Okabe and Ito), in a fixed
// order; the taught path's comes first.
[[nodiscard]] image::Color PathColor(std::size_t index);

}  // namespace trailcast::plot
