#include "services/explain/src/run_path_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/explain/run_plot.h"
#include "services/explain/src/run_index.h"
#include "services/plot/plot_style.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunLog;
using image::Color;
using image::PixelPoint;
using plot::Drawing;

constexpr Color kPaleGrid{232, 232, 232};  // pale, because the path is thin
constexpr double kTextHeight_px = 10.0;
constexpr double kHighest_px = 420.0;
constexpr double kLowest_px = 120.0;
constexpr double kScaleBar_px = 140.0;
constexpr double kLeastDriven_m = 0.1;  // a shorter path is not drawn
// Smaller offsets are all good, and a run without trouble must not look colourful.
constexpr double kLeastFullScale_m = 0.1;

struct Extent {
  double min_x = std::numeric_limits<double>::infinity();
  double max_x = -std::numeric_limits<double>::infinity();
  double min_y = std::numeric_limits<double>::infinity();
  double max_y = -std::numeric_limits<double>::infinity();
};

Extent ExtentOf(const RunLog& log) {
  constexpr double kMargin_m = 0.4;
  Extent extent;
  for (const FrameRow& row : log.frames) {
    if (!row.x_m || !row.y_m) continue;
    extent.min_x = std::min(extent.min_x, *row.x_m - kMargin_m);
    extent.max_x = std::max(extent.max_x, *row.x_m + kMargin_m);
    extent.min_y = std::min(extent.min_y, *row.y_m - kMargin_m);
    extent.max_y = std::max(extent.max_y, *row.y_m + kMargin_m);
  }
  return extent;
}

struct Map {
  Extent extent;
  plot::PixelBox box;
  double px_per_m = 1.0;

  [[nodiscard]] PixelPoint At(double x_m, double y_m) const {
    const double mid_x = 0.5 * (extent.min_x + extent.max_x);
    const double mid_y = 0.5 * (extent.min_y + extent.max_y);
    return {box.left + 0.5 * box.width + px_per_m * (x_m - mid_x),
            box.top + 0.5 * box.height - px_per_m * (y_m - mid_y)};
  }
};

// Returns blue on the path, through yellow, to red far beside it.
Color OffsetColor(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [&](double from, double half, double to) {
    const double value =
        s < 0.5 ? from + 2.0 * s * (half - from) : half + (2.0 * s - 1.0) * (to - half);
    return static_cast<std::uint8_t>(std::lround(value));
  };
  return {mix(0, 240, 200), mix(114, 180, 20), mix(178, 40, 20)};
}

double FullScale_m(const RunLog& log) {
  double largest_m = kLeastFullScale_m;
  for (const FrameRow& row : log.frames) {
    largest_m = std::max(largest_m, std::abs(row.left_m.value_or(0.0)));
  }
  return largest_m;
}

void DrawGrid(Drawing& drawing, const Map& map) {
  const double half_width_m = 0.5 * map.box.width / map.px_per_m;
  const double half_height_m = 0.5 * map.box.height / map.px_per_m;
  const double mid_x = 0.5 * (map.extent.min_x + map.extent.max_x);
  const double mid_y = 0.5 * (map.extent.min_y + map.extent.max_y);
  for (const double x_m : plot::RoundTicks(mid_x - half_width_m, mid_x + half_width_m, 10.0)) {
    const double x = map.At(x_m, 0.0).x;
    drawing.Line({{x, map.box.top}, {x, map.box.bottom()}}, kPaleGrid, 1.0);
    const std::string text = fmt::format("{:g}", x_m);
    drawing.Text(text,
                 {x - 0.5 * Drawing::TextWidth(text, kTextHeight_px), map.box.bottom() + 16.0},
                 kTextHeight_px, plot::kInk);
  }
  for (const double y_m : plot::RoundTicks(mid_y - half_height_m, mid_y + half_height_m, 4.0)) {
    const double y = map.At(0.0, y_m).y;
    drawing.Line({{map.box.left, y}, {map.box.right(), y}}, kPaleGrid, 1.0);
    const std::string text = fmt::format("{:g}", y_m);
    drawing.Text(text, {map.box.left - 6.0 - Drawing::TextWidth(text, kTextHeight_px), y + 4.0},
                 kTextHeight_px, plot::kInk);
  }
}

// A broad stroke under the path marks where the robot was not sure.
void DrawPath(Drawing& drawing, const Map& map, const RunLog& log, double full_scale_m) {
  for (const bool under : {true, false}) {
    for (std::size_t i = 1; i < log.frames.size(); ++i) {
      const FrameRow& before = log.frames[i - 1];
      const FrameRow& row = log.frames[i];
      if (!before.x_m || !before.y_m || !row.x_m || !row.y_m) continue;
      const bool plain = row.phase == Phase::kSure || row.phase == Phase::kArrived;
      if (under && plain) continue;
      const Color color = under        ? PhaseColor(row.phase)
                          : row.left_m ? OffsetColor(std::abs(*row.left_m) / full_scale_m)
                                       : plot::kInk;
      const PixelPoint at = map.At(*row.x_m, *row.y_m);
      drawing.Line({map.At(*before.x_m, *before.y_m), at}, color, under ? 12.0 : 3.0);
      // A robot that stands would draw no line.
      if (under) drawing.Disc(at, 6.0, color);
    }
  }
}

void DrawSegments(Drawing& drawing, const Map& map, const RunLog& log) {
  PixelPoint last{-1e9, -1e9};
  for (const Stay& stay : StaysOf(log)) {
    const FrameRow& row = log.frames[stay.first];
    if (!row.x_m || !row.y_m) continue;
    const PixelPoint at = map.At(*row.x_m, *row.y_m);
    drawing.Disc(at, 3.0, plot::kInk);
    // Numbers of short segments would overlap.
    if (std::hypot(at.x - last.x, at.y - last.y) < 22.0) continue;
    drawing.Text(std::to_string(stay.segment), {at.x + 5.0, at.y - 6.0}, kTextHeight_px,
                 plot::kInk);
    last = at;
  }
}

void DrawOffsetScale(Drawing& drawing, const plot::PixelBox& box, double full_scale_m) {
  const double baseline = box.top - 7.0;
  const std::string text = fmt::format("{:.2f} m", full_scale_m);
  const double right = box.right() - Drawing::TextWidth(text, kTextHeight_px);
  drawing.Text(text, {right, baseline}, kTextHeight_px, plot::kInk);
  const double left = right - 6.0 - kScaleBar_px;
  for (double x = 0.0; x < kScaleBar_px; x += 2.0) {
    drawing.Line({{left + x, baseline - 4.0}, {left + x + 2.0, baseline - 4.0}},
                 OffsetColor(x / kScaleBar_px), 7.0);
  }
  const std::string label = "estimated distance from the taught path  0";
  drawing.Text(label, {left - 8.0 - Drawing::TextWidth(label, kTextHeight_px), baseline},
               kTextHeight_px, plot::kInk);
}

}  // namespace

double PathPanelHeight(const RunLog& log, double width_px) {
  const Extent extent = ExtentOf(log);
  if (!HasOdometry(log) || PlaceOf(log.frames.back()) < kLeastDriven_m) return 0.0;
  const double height = width_px * (extent.max_y - extent.min_y) / (extent.max_x - extent.min_x);
  return std::clamp(height, kLowest_px, kHighest_px);
}

void DrawPathPanel(Drawing& drawing, const plot::PixelBox& box, const RunLog& log) {
  const Extent extent = ExtentOf(log);
  const Map map{extent, box,
                std::min(box.width / (extent.max_x - extent.min_x),
                         box.height / (extent.max_y - extent.min_y))};
  const double full_scale_m = FullScale_m(log);
  DrawGrid(drawing, map);
  DrawPath(drawing, map, log, full_scale_m);
  DrawSegments(drawing, map, log);
  drawing.OutlineBox({box.left, box.top}, {box.right(), box.bottom()}, plot::kInk, 1.0);
  drawing.Text("path by odometry, x and y [m], with the segments' starts",
               {box.left, box.top - 7.0}, 11.0, plot::kInk);
  const bool estimated = std::any_of(log.frames.begin(), log.frames.end(),
                                     [](const FrameRow& row) { return row.left_m.has_value(); });
  if (estimated) DrawOffsetScale(drawing, box, full_scale_m);
}

}  // namespace trailcast::explain
