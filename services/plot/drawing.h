#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/canvas.h"
#include "services/image/image.h"

// These are Cairo's, whose headers only drawing.cc includes.
struct _cairo;          // NOLINT(bugprone-reserved-identifier)
struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier)

namespace trailcast::plot {

// A page to draw plots on with Cairo, which is then written as pixels or as vectors. Points are in
// pixels from the middle of the upper left pixel.
class Drawing {
 public:
  Drawing(int width, int height, image::Color background);

  void Line(std::vector<image::PixelPoint> points, image::Color color, double width_px,
            bool dashed = false);
  void FillPolygon(std::vector<image::PixelPoint> corners, image::Color color);
  // A box is upright and given by two opposite corners.
  void FillBox(image::PixelPoint from, image::PixelPoint to, image::Color color);
  void OutlineBox(image::PixelPoint from, image::PixelPoint to, image::Color color,
                  double width_px);
  void Disc(image::PixelPoint center, double radius_px, image::Color color);
  void Cross(image::PixelPoint center, double radius_px, image::Color color, double width_px);
  // Draws text whose baseline begins at `at`; `height_px` is the height of a capital letter.
  void Text(const std::string& text, image::PixelPoint at, double height_px, image::Color color);
  [[nodiscard]] static double TextWidth(const std::string& text, double height_px);
  // Draws `picture`, scaled to the given size, with its upper left corner at (x, y).
  void Paste(const image::RgbImage& picture, double x, double y, double width, double height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] image::RgbImage Render() const;
  // Writes SVG if the file's name ends so, else PNG. kUnavailable gives the reason.
  [[nodiscard]] Result<void> Write(const std::filesystem::path& file) const;

 private:
  using Stroke = std::function<void(_cairo* context)>;
  void Draw(_cairo_surface* page) const;

  int width_;
  int height_;
  std::vector<Stroke> strokes_;  // in the order in which they were drawn
};

}  // namespace trailcast::plot
