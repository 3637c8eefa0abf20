#include "services/plot/plan_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "services/base/text_file.h"
#include "services/plot/plot_style.h"

namespace trailcast::plot {
namespace {

using image::Color;
using image::PixelPoint;

constexpr double kTextHeight_px = 12.0;
constexpr double kTitleHeight_px = 15.0;
constexpr double kLegendLine_px = 20.0;
constexpr double kLongSide_px = 900.0;
constexpr double kLeft_px = 70.0;
constexpr double kRight_px = 25.0;
constexpr double kTop_px = 45.0;
constexpr double kBottom_px = 60.0;
constexpr double kLegendSample_px = 36.0;

// The place of the world's plane in the picture.
struct Frame {
  PlanArea area;
  double px_per_m = 1.0;

  [[nodiscard]] PixelPoint At(const Eigen::Vector2d& point_m) const {
    return {kLeft_px + (point_m.x() - area.min_m.x()) * px_per_m,
            kTop_px + (area.max_m.y() - point_m.y()) * px_per_m};
  }
  [[nodiscard]] double width_px() const { return area.size_m().x() * px_per_m; }
  [[nodiscard]] double height_px() const { return area.size_m().y() * px_per_m; }
};

void DrawAxes(Drawing& drawing, const Frame& frame, bool grid) {
  const PlanArea& area = frame.area;
  const double step_m = TickStep(std::max(area.size_m().x(), area.size_m().y()), 8.0);
  const double bottom = kTop_px + frame.height_px();
  const double right = kLeft_px + frame.width_px();
  for (const double x_m : Ticks(area.min_m.x(), area.max_m.x(), step_m)) {
    const double x = frame.At({x_m, 0.0}).x;
    if (grid) drawing.Line({{x, kTop_px}, {x, bottom}}, kGrid, 1.0);
    drawing.Line({{x, bottom}, {x, bottom + 5.0}}, kInk, 1.0);
    const std::string text = fmt::format("{:g}", x_m);
    drawing.Text(text, {x - 0.5 * Drawing::TextWidth(text, kTextHeight_px), bottom + 20.0},
                 kTextHeight_px, kInk);
  }
  for (const double y_m : Ticks(area.min_m.y(), area.max_m.y(), step_m)) {
    const double y = frame.At({0.0, y_m}).y;
    if (grid) drawing.Line({{kLeft_px, y}, {right, y}}, kGrid, 1.0);
    drawing.Line({{kLeft_px - 5.0, y}, {kLeft_px, y}}, kInk, 1.0);
    const std::string text = fmt::format("{:g}", y_m);
    drawing.Text(
        text, {kLeft_px - 9.0 - Drawing::TextWidth(text, kTextHeight_px), y + 0.4 * kTextHeight_px},
        kTextHeight_px, kInk);
  }
  drawing.Line({{kLeft_px, kTop_px},
                {right, kTop_px},
                {right, bottom},
                {kLeft_px, bottom},
                {kLeft_px, kTop_px}},
               kInk, 1.0);
  drawing.Text("x [m]", {right - Drawing::TextWidth("x [m]", kTextHeight_px), bottom + 40.0},
               kTextHeight_px, kInk);
  drawing.Text("y [m]", {8.0, kTop_px - 8.0}, kTextHeight_px, kInk);
}

double WidthOf(const PlottedPath& path) {
  if (path.band) return 14.0;
  return path.taught ? 4.0 : 2.0;
}

// Points closer than a pixel cannot be seen, and would make dashes run into each other.
std::vector<PixelPoint> PixelsOf(const Frame& frame, const PlottedPath& path) {
  std::vector<PixelPoint> points;
  points.reserve(path.points_m.size());
  for (const Eigen::Vector2d& point_m : path.points_m) {
    const PixelPoint point = frame.At(point_m);
    if (points.empty() || std::hypot(point.x - points.back().x, point.y - points.back().y) >= 1.0) {
      points.push_back(point);
    }
  }
  return points;
}

void DrawPath(Drawing& drawing, const Frame& frame, const PlottedPath& path) {
  if (path.points_m.empty()) return;
  const std::vector<PixelPoint> points = PixelsOf(frame, path);
  if (points.size() > 1) drawing.Line(points, path.color, WidthOf(path), path.taught);
  if (path.band) return;
  if (path.taught) drawing.Disc(points.front(), 5.0, path.color);
  if (path.failed) {
    drawing.Cross(points.back(), 8.0, path.color, 3.0);
  } else {
    drawing.Disc(points.back(), 5.0, path.color);
  }
}

bool HasLabel(const PlottedPath& path) { return !path.label.empty(); }

void DrawLegend(Drawing& drawing, const Frame& frame, const std::vector<PlottedPath>& paths) {
  double y = kTop_px + frame.height_px() + kBottom_px;
  for (const PlottedPath& path : paths) {
    if (!HasLabel(path)) continue;
    const double middle = y - 0.4 * kTextHeight_px;
    drawing.Line({{kLeft_px, middle}, {kLeft_px + kLegendSample_px, middle}}, path.color,
                 WidthOf(path), path.taught);
    drawing.Text(path.label, {kLeft_px + kLegendSample_px + 10.0, y}, kTextHeight_px, kInk);
    y += kLegendLine_px;
  }
}

Frame FrameOf(const Plan& plan) {
  Frame frame;
  frame.area = plan.backdrop ? plan.backdrop->area : AreaAround(plan.paths, 1.0);
  const Eigen::Vector2d size_m = frame.area.size_m();
  frame.px_per_m = kLongSide_px / std::max(size_m.x(), size_m.y());
  return frame;
}

// Draws a disc that stands until `from`, drives until `to`, and stands at the path's end until the
// animation begins anew; both are shares of `period_s`. SVG counts from pixels' corners, points
// from their middles.
std::string MovingDisc(const Frame& frame, const PlottedPath& path, double from, double to,
                       double period_s) {
  std::string way;
  for (const PixelPoint& point : PixelsOf(frame, path)) {
    way += fmt::format("{}{:.1f} {:.1f}", way.empty() ? "M" : "L", point.x + 0.5, point.y + 0.5);
  }
  return fmt::format(
      "<circle r=\"8\" fill=\"#{:02x}{:02x}{:02x}\" stroke=\"#fff\" stroke-width=\"2\">"
      "<animateMotion dur=\"{:.2f}s\" repeatCount=\"indefinite\" calcMode=\"linear\" "
      "keyTimes=\"0;{:.4f};{:.4f};1\" keyPoints=\"0;0;1;1\" path=\"{}\"/></circle>\n",
      path.color[0], path.color[1], path.color[2], period_s, from, to, way);
}

double WidestText(const Plan& plan) {
  double widest = Drawing::TextWidth(plan.title, kTitleHeight_px);
  for (const PlottedPath& path : plan.paths) {
    widest =
        std::max(widest, kLegendSample_px + 10.0 + Drawing::TextWidth(path.label, kTextHeight_px));
  }
  return widest;
}

}  // namespace

PlanArea AreaAround(const std::vector<PlottedPath>& paths, double margin_m) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PlanArea area{{kFar, kFar}, {-kFar, -kFar}};
  for (const PlottedPath& path : paths) {
    for (const Eigen::Vector2d& point_m : path.points_m) {
      area.min_m = area.min_m.cwiseMin(point_m);
      area.max_m = area.max_m.cwiseMax(point_m);
    }
  }
  if (!(area.min_m.x() <= area.max_m.x())) area = {};
  area.min_m.array() -= margin_m;
  area.max_m.array() += margin_m;
  return area;
}

Drawing DrawPlan(const Plan& plan) {
  const Frame frame = FrameOf(plan);
  const auto entries =
      static_cast<double>(std::count_if(plan.paths.begin(), plan.paths.end(), HasLabel));
  const double width = kLeft_px + std::max(frame.width_px(), WidestText(plan)) + kRight_px;
  const double height = kTop_px + frame.height_px() + kBottom_px + entries * kLegendLine_px;
  Drawing drawing(static_cast<int>(width), static_cast<int>(height), kWhite);
  if (plan.backdrop) {
    drawing.Paste(plan.backdrop->picture, static_cast<int>(kLeft_px), static_cast<int>(kTop_px),
                  static_cast<int>(frame.width_px()), static_cast<int>(frame.height_px()));
  }
  DrawAxes(drawing, frame, !plan.backdrop);
  drawing.Text(plan.title, {kLeft_px, 24.0}, kTitleHeight_px, kInk);
  for (const PlottedPath& path : plan.paths) {
    if (path.band) DrawPath(drawing, frame, path);
  }
  for (const PlottedPath& path : plan.paths) {
    if (path.taught) DrawPath(drawing, frame, path);
  }
  for (const PlottedPath& path : plan.paths) {
    if (!path.taught && !path.band) DrawPath(drawing, frame, path);
  }
  DrawLegend(drawing, frame, plan.paths);
  return drawing;
}

Result<void> WriteMovingPlan(const Plan& plan, const PlanMotion& motion,
                             const std::filesystem::path& file) {
  constexpr double kPause_s = 2.0;
  constexpr const char* kEnd = "</svg>";
  if (file.extension() != ".svg") {
    return Fail(ErrorCode::kInvalidArgument, "{}: a picture that moves is an .svg", file.string());
  }
  if (auto drawn = DrawPlan(plan).Write(file); !drawn) return drawn;
  auto text = ReadTextFile(file);
  if (!text) return tl::unexpected(text.error());
  const auto moves = [](const PlottedPath& path) { return !path.band && path.points_m.size() > 1; };
  const auto count =
      static_cast<double>(std::count_if(plan.paths.begin(), plan.paths.end(), moves));
  const double period_s = motion.takes_s + motion.apart_s * std::max(count - 1.0, 0.0) + kPause_s;
  const Frame frame = FrameOf(plan);
  std::string discs;
  double begins_s = 0.0;
  for (const PlottedPath& path : plan.paths) {
    if (!moves(path)) continue;
    discs += MovingDisc(frame, path, begins_s / period_s, (begins_s + motion.takes_s) / period_s,
                        period_s);
    begins_s += motion.apart_s;
  }
  text->insert(text->rfind(kEnd), discs);
  return WriteTextFile(file, *text);
}

image::Color PathColor(std::size_t index) {
  static constexpr std::array<Color, 7> kColors{
      {kBlack, kOrange, kBlue, kGreen, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};
  return index == 0 ? kColors[0] : kColors[1 + (index - 1) % (kColors.size() - 1)];
}

}  // namespace trailcast::plot
