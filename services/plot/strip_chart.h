#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/plot/drawing.h"

namespace trailcast::plot {

// One curve over the chart's common x; it has a gap where there is no value.
struct Curve {
  std::string label;  // an empty one is left out of the legend
  image::Color color{};
  std::vector<std::optional<double>> values;
  double width_px = 1.5;
  bool dashed = false;
};

// A range of x with a background of its own.
struct Band {
  double from_x = 0.0;
  double to_x = 0.0;
  image::Color color{};
};

// The x axis that several charts, one above the other, share.
struct ChartAxis {
  std::string label;
  std::vector<double> x;        // of all curves' values, rising
  std::vector<double> borders;  // where fine vertical lines are drawn
  std::vector<Band> bands;
};

struct StripChart {
  std::string title;
  std::vector<Curve> curves;
  // The y range includes this one, and grows if the values need it.
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

// Draws the curves into `box`, the title and the legend above it, and the y labels left of it.
void DrawStrip(Drawing& drawing, const PixelBox& box, const ChartAxis& axis,
               const StripChart& chart);
// Draws the ticks and the label of the common axis below `box`.
void DrawChartAxis(Drawing& drawing, const PixelBox& box, const ChartAxis& axis);

}  // namespace trailcast::plot
