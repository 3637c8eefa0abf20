#include "services/lab/sim/looks/src/pattern.h"

#include <cmath>
#include <memory>

namespace trailcast::sim {
namespace {

double Smooth(double t) { return t * t * (3.0 - 2.0 * t); }

// Returns the shifts, in picture sizes, at which a shape touches the picture; 0 is always one.
std::vector<double> Shifts(double low_px, double high_px, int size_px) {
  std::vector<double> shifts = {0.0};
  if (low_px < 0.0) shifts.push_back(size_px);
  if (high_px > size_px) shifts.push_back(-size_px);
  return shifts;
}

std::vector<image::PixelPoint> Shifted(std::vector<image::PixelPoint> points, double dx,
                                       double dy) {
  for (image::PixelPoint& point : points) point = {point.x + dx, point.y + dy};
  return points;
}

// Calls `draw` with the points, and with their copies beyond the edges over which they reach.
template <typename Draw>
void Wrapped(const image::RgbImage& picture, const std::vector<image::PixelPoint>& points,
             double margin_px, const Draw& draw) {
  const auto [left, right] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [top, bottom] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  for (const double dx : Shifts(left->x - margin_px, right->x + margin_px, picture.width)) {
    for (const double dy : Shifts(top->y - margin_px, bottom->y + margin_px, picture.height)) {
      draw(Shifted(points, dx, dy));
    }
  }
}

}  // namespace

RandomField::RandomField(int period_x, int period_y, Random& random)
    : width_(period_x), height_(period_y) {
  for (int i = 0; i < period_x * period_y; ++i) values_.push_back(random.Uniform(-1.0, 1.0));
}

double RandomField::Value(int i, int j) const {
  const int x = ((i % width_) + width_) % width_;
  const int y = ((j % height_) + height_) % height_;
  return values_[image::PixelIndex(x, y, width_)];
}

double RandomField::At(double x, double y) const {
  const double u = x * width_;
  const double v = y * height_;
  const double a = Smooth(u - std::floor(u));
  const double b = Smooth(v - std::floor(v));
  const int i = static_cast<int>(std::floor(u));
  const int j = static_cast<int>(std::floor(v));
  const double upper = (1.0 - a) * Value(i, j) + a * Value(i + 1, j);
  const double lower = (1.0 - a) * Value(i, j + 1) + a * Value(i + 1, j + 1);
  return (1.0 - b) * upper + b * lower;
}

double JointDistance(double share) {
  const double inside = share - std::floor(share);
  return std::min(inside, 1.0 - inside);
}

void Block(image::Canvas& canvas, double x, double y, double width, double height,
           image::Color color) {
  canvas.FillPolygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, color);
}

void WrappedLine(image::Canvas& canvas, image::PixelPoint from, image::PixelPoint to,
                 image::Color color, double width_px) {
  Wrapped(canvas.picture(), {from, to}, width_px,
          [&](const auto& points) { canvas.Line(points, color, width_px); });
}

void WrappedPolygon(image::Canvas& canvas, const std::vector<image::PixelPoint>& corners,
                    image::Color color) {
  Wrapped(canvas.picture(), corners, 1.0,
          [&](const auto& points) { canvas.FillPolygon(points, color); });
}

TexturePtr Finish(const image::RgbImage& picture) { return std::make_shared<Texture>(picture); }

TexturePtr Finish(const image::Canvas& canvas) { return Finish(canvas.picture()); }

}  // namespace trailcast::sim
