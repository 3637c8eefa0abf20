#include "services/image/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace trailcast::image {
namespace {

// OpenCV draws at fixed-point coordinates; 4 fractional bits are a 16th of a pixel.
constexpr int kShift = 4;
constexpr double kShiftScale = 1 << kShift;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
// The height in pixels of a capital in this font at scale 1, from its glyph table.
constexpr double kCapitalHeight_px = 21.0;
constexpr double kDash_px = 8.0;

cv::Mat View(RgbImage& picture) {
  return {picture.height, picture.width, CV_8UC3, picture.pixels.data()};
}
cv::Scalar ToScalar(Color color) {
  return {static_cast<double>(color[0]), static_cast<double>(color[1]),
          static_cast<double>(color[2])};
}
cv::Point ToFixed(PixelPoint point) {
  return {static_cast<int>(std::lround(point.x * kShiftScale)),
          static_cast<int>(std::lround(point.y * kShiftScale))};
}
int Thickness(double width_px) { return std::max(1, static_cast<int>(std::lround(width_px))); }

PixelPoint Mix(PixelPoint from, PixelPoint to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

// Draws every second piece of kDash_px; `phase_px` carries the pattern round corners.
void DashedStretch(cv::Mat& view, PixelPoint from, PixelPoint to, const cv::Scalar& color,
                   int thickness, double& phase_px) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  double at = 0.0;
  while (at < length) {
    const double in_dash = std::fmod(phase_px, kDash_px);
    const double end = std::min(length, at + kDash_px - in_dash);
    if (std::fmod(phase_px, 2.0 * kDash_px) < kDash_px) {
      cv::line(view, ToFixed(Mix(from, to, at / length)), ToFixed(Mix(from, to, end / length)),
               color, thickness, cv::LINE_AA, kShift);
    }
    // A step as small as a rounding error would never end the loop.
    const double step = std::max(end - at, 1e-6);
    phase_px += step;
    at += step;
  }
}

struct TextStyle {
  double scale;
  int thickness;
};
TextStyle StyleOf(double height_px) {
  return {height_px / kCapitalHeight_px, Thickness(height_px / 10.0)};
}

}  // namespace

Canvas::Canvas(int width, int height, Color background) {
  picture_.width = std::max(1, width);
  picture_.height = std::max(1, height);
  picture_.pixels.resize(3U * static_cast<std::size_t>(picture_.width) *
                         static_cast<std::size_t>(picture_.height));
  View(picture_).setTo(ToScalar(background));
}

void Canvas::Line(const std::vector<PixelPoint>& points, Color color, double width_px,
                  bool dashed) {
  cv::Mat view = View(picture_);
  double phase_px = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (dashed) {
      DashedStretch(view, points[i - 1], points[i], ToScalar(color), Thickness(width_px), phase_px);
    } else {
      cv::line(view, ToFixed(points[i - 1]), ToFixed(points[i]), ToScalar(color),
               Thickness(width_px), cv::LINE_AA, kShift);
    }
  }
}

void Canvas::FillPolygon(const std::vector<PixelPoint>& corners, Color color) {
  if (corners.size() < 3) return;
  std::vector<cv::Point> fixed;
  fixed.reserve(corners.size());
  for (const PixelPoint& corner : corners) fixed.push_back(ToFixed(corner));
  cv::Mat view = View(picture_);
  const std::vector<std::vector<cv::Point>> polygons = {fixed};
  cv::fillPoly(view, polygons, ToScalar(color), cv::LINE_AA, kShift);
}

void Canvas::FillBox(PixelPoint from, PixelPoint to, Color color) {
  FillPolygon({from, {to.x, from.y}, to, {from.x, to.y}}, color);
}

void Canvas::OutlineBox(PixelPoint from, PixelPoint to, Color color, double width_px) {
  Line({from, {to.x, from.y}, to, {from.x, to.y}, from}, color, width_px);
}

void Canvas::Disc(PixelPoint center, double radius_px, Color color) {
  cv::Mat view = View(picture_);
  const int radius = std::max(1, static_cast<int>(std::lround(radius_px * kShiftScale)));
  cv::circle(view, ToFixed(center), radius, ToScalar(color), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::Cross(PixelPoint center, double radius_px, Color color, double width_px) {
  Line({{center.x - radius_px, center.y - radius_px}, {center.x + radius_px, center.y + radius_px}},
       color, width_px);
  Line({{center.x - radius_px, center.y + radius_px}, {center.x + radius_px, center.y - radius_px}},
       color, width_px);
}

void Canvas::Text(const std::string& text, PixelPoint at, double height_px, Color color) {
  cv::Mat view = View(picture_);
  const TextStyle style = StyleOf(height_px);
  const cv::Point baseline_left(static_cast<int>(std::lround(at.x)),
                                static_cast<int>(std::lround(at.y)));
  cv::putText(view, text, baseline_left, kFont, style.scale, ToScalar(color), style.thickness,
              cv::LINE_AA);
}

double Canvas::TextWidth(const std::string& text, double height_px) {
  const TextStyle style = StyleOf(height_px);
  int baseline = 0;
  return cv::getTextSize(text, kFont, style.scale, style.thickness, &baseline).width;
}

void Canvas::Paste(const RgbImage& picture, int x, int y, int width, int height) {
  if (picture.empty() || width <= 0 || height <= 0) return;
  RgbImage source = picture;
  cv::Mat scaled;
  cv::resize(View(source), scaled, {width, height}, 0.0, 0.0,
             width < picture.width ? cv::INTER_AREA : cv::INTER_LINEAR);
  const cv::Rect target(x, y, width, height);
  const cv::Rect visible = target & cv::Rect(0, 0, picture_.width, picture_.height);
  if (visible.empty()) return;
  const cv::Rect part(visible.x - x, visible.y - y, visible.width, visible.height);
  scaled(part).copyTo(View(picture_)(visible));
}

}  // namespace trailcast::image
