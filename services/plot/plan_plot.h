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

// A rectangle of the world's plane, metres, y up.
struct PlanArea {
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d size_m() const { return max_m - min_m; }
};

// The world seen from above: what lies under the paths.
struct Backdrop {
  image::RgbImage picture;  // upper left pixel at (min x, max y) of `area`
  PlanArea area;
};

struct PlottedPath {
  std::string label;  // for the legend; empty: not in the legend
  image::Color color{};
  std::vector<Eigen::Vector2d> points_m;
  bool taught = false;  // drawn dashed and thicker, below the others
  bool failed = false;  // its end gets a cross in place of a disc
  bool band = false;    // a broad band below all others, and no disc
};

struct Plan {
  std::string title;
  std::optional<Backdrop> backdrop;
  std::vector<PlottedPath> paths;
};

// The smallest area that holds all paths, with `margin_m` around it.
[[nodiscard]] PlanArea AreaAround(const std::vector<PlottedPath>& paths, double margin_m);

// A picture with axes in metres, both to the same scale, and a legend: as the paper's Fig. 4. Shows
// the backdrop's area, or that around the paths.
[[nodiscard]] Drawing DrawPlan(const Plan& plan);

// How discs drive over a plan: each path takes so long, and the next one begins so much later.
struct PlanMotion {
  double takes_s = 10.0;
  double apart_s = 1.0;
};

// The plan as SVG in which a disc drives along each path but bands, at an even pace, over and over.
// Errors: as Drawing::Write's; kInvalidArgument if the file's name does not end in ".svg".
[[nodiscard]] Result<void> WriteMovingPlan(const Plan& plan, const PlanMotion& motion,
                                           const std::filesystem::path& file);

// Colours told apart by most eyes (Okabe and Ito), in a fixed order; the taught path's comes first.
[[nodiscard]] image::Color PathColor(std::size_t index);

}  // namespace trailcast::plot
