#include "services/plot/strip_chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/plot/plot_style.h"

namespace trailcast::plot {
namespace {

using image::Color;
using image::PixelPoint;

constexpr Color kBorder{170, 170, 170};
constexpr double kStripTextHeight_px = 10.0;
constexpr double kStripTitleHeight_px = 11.0;
// A robot that stands takes no room on an axis of metres, but its band must be visible.
constexpr double kNarrowestBand_px = 4.0;

struct Range {
  double from = 0.0;
  double to = 1.0;

  [[nodiscard]] double ShareOf(double value) const {
    return to > from ? (value - from) / (to - from) : 0.0;
  }
};

Range XRange(const ChartAxis& axis) {
  if (axis.x.empty()) return {};
  return {axis.x.front(), std::max(axis.x.back(), axis.x.front() + 1e-6)};
}

Range YRange(const StripChart& chart) {
  Range range{chart.least_y, chart.largest_y};
  for (const Curve& curve : chart.curves) {
    for (const auto& value : curve.values) {
      range.from = std::min(range.from, value.value_or(range.from));
      range.to = std::max(range.to, value.value_or(range.to));
    }
  }
  // A curve on the frame's own line could not be seen.
  const double room = 0.05 * (range.to - range.from);
  if (range.from < chart.least_y) range.from -= room;
  if (range.to > chart.largest_y) range.to += room;
  return range;
}

struct Scale {
  PixelBox box;
  Range x;
  Range y;

  [[nodiscard]] double AtX(double value) const { return box.left + box.width * x.ShareOf(value); }
  [[nodiscard]] double AtY(double value) const {
    return box.bottom() - box.height * y.ShareOf(value);
  }
};

void DrawBands(Drawing& drawing, const Scale& scale, const std::vector<Band>& bands) {
  const PixelBox& box = scale.box;
  for (const Band& band : bands) {
    const double from = std::clamp(scale.AtX(band.from_x), box.left, box.right());
    const double to =
        std::min(box.right(), std::max(scale.AtX(band.to_x), from + kNarrowestBand_px));
    drawing.FillBox({from, box.top}, {to, box.bottom()}, band.color);
  }
}

void DrawYAxis(Drawing& drawing, const Scale& scale) {
  const PixelBox& box = scale.box;
  for (const double y : RoundTicks(scale.y.from, scale.y.to, 4.0)) {
    const double at = scale.AtY(y);
    drawing.Line({{box.left, at}, {box.right(), at}}, y == 0.0 ? kBorder : kGrid, 1.0);
    const std::string text = fmt::format("{:g}", y);
    drawing.Text(text, {box.left - 6.0 - Drawing::TextWidth(text, kStripTextHeight_px), at + 4.0},
                 kStripTextHeight_px, kInk);
  }
}

void DrawCurve(Drawing& drawing, const Scale& scale, const ChartAxis& axis, const Curve& curve) {
  std::vector<PixelPoint> points;
  const auto draw = [&] {
    if (points.size() > 1) drawing.Line(points, curve.color, curve.width_px, curve.dashed);
    points.clear();
  };
  for (std::size_t i = 0; i < std::min(axis.x.size(), curve.values.size()); ++i) {
    if (curve.values[i]) {
      points.push_back({scale.AtX(axis.x[i]), scale.AtY(*curve.values[i])});
    } else {
      draw();
    }
  }
  draw();
}

void DrawLegend(Drawing& drawing, const PixelBox& box, const StripChart& chart) {
  const double baseline = box.top - 7.0;
  drawing.Text(chart.title, {box.left, baseline}, kStripTitleHeight_px, kInk);
  double x = box.right();
  for (auto curve = chart.curves.rbegin(); curve != chart.curves.rend(); ++curve) {
    if (curve->label.empty()) continue;
    x -= Drawing::TextWidth(curve->label, kStripTextHeight_px);
    drawing.Text(curve->label, {x, baseline}, kStripTextHeight_px, kInk);
    x -= 30.0;
    drawing.Line({{x, baseline - 4.0}, {x + 24.0, baseline - 4.0}}, curve->color,
                 std::max(2.0, curve->width_px), curve->dashed);
    x -= 14.0;
  }
}

}  // namespace

void DrawStrip(Drawing& drawing, const PixelBox& box, const ChartAxis& axis,
               const StripChart& chart) {
  const Scale scale{box, XRange(axis), YRange(chart)};
  DrawBands(drawing, scale, axis.bands);
  DrawYAxis(drawing, scale);
  for (const double x : axis.borders) {
    drawing.Line({{scale.AtX(x), box.top}, {scale.AtX(x), box.bottom()}}, kBorder, 1.0);
  }
  for (const Curve& curve : chart.curves) DrawCurve(drawing, scale, axis, curve);
  drawing.OutlineBox({box.left, box.top}, {box.right(), box.bottom()}, kInk, 1.0);
  DrawLegend(drawing, box, chart);
}

void DrawChartAxis(Drawing& drawing, const PixelBox& box, const ChartAxis& axis) {
  const Scale scale{box, XRange(axis), {}};
  for (const double x : RoundTicks(scale.x.from, scale.x.to, 10.0)) {
    const double at = scale.AtX(x);
    drawing.Line({{at, box.bottom()}, {at, box.bottom() + 5.0}}, kInk, 1.0);
    const std::string text = fmt::format("{:g}", x);
    drawing.Text(text,
                 {at - 0.5 * Drawing::TextWidth(text, kStripTextHeight_px), box.bottom() + 19.0},
                 kStripTextHeight_px, kInk);
  }
  drawing.Text(
      axis.label,
      {box.right() - Drawing::TextWidth(axis.label, kStripTextHeight_px), box.bottom() + 36.0},
      kStripTextHeight_px, kInk);
}

}  // namespace trailcast::plot
