#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "services/image/image.h"

namespace trailcast::image {

using Color = std::array<std::uint8_t, 3>;  // red, green, blue

struct PixelPoint {
  double x = 0.0;
  double y = 0.0;
};

// A picture to draw on, with anti-aliased lines, marks and text.
class Canvas {
 public:
  Canvas(int width, int height, Color background);

  void Line(const std::vector<PixelPoint>& points, Color color, double width_px,
            bool dashed = false);
  void FillPolygon(const std::vector<PixelPoint>& corners, Color color);
  // A box is upright and given by two opposite corners.
  void FillBox(PixelPoint from, PixelPoint to, Color color);
  void OutlineBox(PixelPoint from, PixelPoint to, Color color, double width_px);
  void Disc(PixelPoint center, double radius_px, Color color);
  void Cross(PixelPoint center, double radius_px, Color color, double width_px);
  // Draws text whose baseline begins at `at`; `height_px` is the height of a capital letter.
  void Text(const std::string& text, PixelPoint at, double height_px, Color color);
  [[nodiscard]] static double TextWidth(const std::string& text, double height_px);
  // Copies `picture`, scaled to the given size, with its upper left corner at (x, y).
  void Paste(const RgbImage& picture, int x, int y, int width, int height);

  [[nodiscard]] const RgbImage& picture() const { return picture_; }

 private:
  RgbImage picture_;
};

}  // namespace trailcast::image
