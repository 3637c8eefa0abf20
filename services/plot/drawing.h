#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/canvas.h"
#include "services/image/image.h"

// Cairo's, which only drawing.cc includes.
struct _cairo;          // NOLINT(bugprone-reserved-identifier)
struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier)

namespace trailcast::plot {

// A page to draw plots on, over Cairo: written as pixels or as vectors. Points are in pixels from
// the upper left pixel's middle.
class Drawing {
 public:
  Drawing(int width, int height, image::Color background);

  void Line(std::vector<image::PixelPoint> points, image::Color color, double width_px,
            bool dashed = false);
  void FillPolygon(std::vector<image::PixelPoint> corners, image::Color color);
  // Upright, between two opposite corners.
  void FillBox(image::PixelPoint from, image::PixelPoint to, image::Color color);
  void OutlineBox(image::PixelPoint from, image::PixelPoint to, image::Color color,
                  double width_px);
  void Disc(image::PixelPoint center, double radius_px, image::Color color);
  void Cross(image::PixelPoint center, double radius_px, image::Color color, double width_px);
  // Baseline-left at `at`; height of a capital letter in pixels.
  void Text(const std::string& text, image::PixelPoint at, double height_px, image::Color color);
  [[nodiscard]] static double TextWidth(const std::string& text, double height_px);
  // With its upper left corner at (x, y), scaled to the given size.
  void Paste(const image::RgbImage& picture, double x, double y, double width, double height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] image::RgbImage Render() const;
  // As SVG where the file's name ends so, else as PNG. Errors: kUnavailable, with the reason.
  [[nodiscard]] Result<void> Write(const std::filesystem::path& file) const;

 private:
  using Stroke = std::function<void(_cairo* context)>;
  void Draw(_cairo_surface* page) const;

  int width_;
  int height_;
  std::vector<Stroke> strokes_;  // in the order in which they were drawn
};

}  // namespace trailcast::plot
