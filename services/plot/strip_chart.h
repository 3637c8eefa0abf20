#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/plot/drawing.h"

namespace trailcast::plot {

// One curve over the chart's common x; where there is no value the curve has a gap.
struct Curve {
  std::string label;  // empty: not in the legend
  image::Color color{};
  std::vector<std::optional<double>> values;
  double width_px = 1.5;
  bool dashed = false;
};

// A stretch of x with a background of its own.
struct Band {
  double from_x = 0.0;
  double to_x = 0.0;
  image::Color color{};
};

// Several charts stand above each other on one x axis.
struct ChartAxis {
  std::string label;
  std::vector<double> x;        // of all curves' values, rising
  std::vector<double> borders;  // fine vertical lines
  std::vector<Band> bands;
};

struct StripChart {
  std::string title;
  std::vector<Curve> curves;
  // The y range is at least this, and more where the values ask for it.
  double least_y = 0.0;
  double largest_y = 1.0;
};

struct PixelBox {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return left + width; }
  [[nodiscard]] double bottom() const { return top + height; }
};

// Draws into `box`, which holds the curves; the title and legend lie above it, y labels left of it.
void DrawStrip(Drawing& drawing, const PixelBox& box, const ChartAxis& axis,
               const StripChart& chart);
// The ticks and the label of the common axis, below `box`.
void DrawChartAxis(Drawing& drawing, const PixelBox& box, const ChartAxis& axis);

}  // namespace trailcast::plot
