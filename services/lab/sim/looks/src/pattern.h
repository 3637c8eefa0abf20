#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "services/image/canvas.h"
#include "services/image/image.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// The textures here are made of these.

// A smooth random field that repeats with the picture: values at lattice points, blended.
class RandomField {
 public:
  RandomField(int period_x, int period_y, Random& random);
  // x, y in 0..1 over the picture; the value is in -1..1.
  [[nodiscard]] double At(double x, double y) const;

 private:
  [[nodiscard]] double Value(int i, int j) const;

  int width_;
  int height_;
  std::vector<double> values_;
};

// Returns `tint` made lighter or darker by so many grey levels.
[[nodiscard]] inline image::Color Lighter(image::Color tint, double levels) {
  for (std::uint8_t& channel : tint) {
    channel = static_cast<std::uint8_t>(std::clamp(channel + levels, 0.0, 255.0));
  }
  return tint;
}

[[nodiscard]] inline image::Color Mix(image::Color a, image::Color b, double share_of_b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double mixed = a[i] + share_of_b * (b[i] - a[i]);
    a[i] = static_cast<std::uint8_t>(std::clamp(mixed, 0.0, 255.0));
  }
  return a;
}

// Returns a square picture whose pixels are `color_at(x, y)`, with x and y in 0..1.
template <typename ColorAt>
[[nodiscard]] image::RgbImage Painted(int size, const ColorAt& color_at) {
  image::RgbImage picture{size, size, {}};
  picture.pixels.reserve(3U * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const image::Color color = color_at((x + 0.5) / size, (y + 0.5) / size);
      picture.pixels.insert(picture.pixels.end(), color.begin(), color.end());
    }
  }
  return picture;
}

// Returns a square picture whose pixels are `tint`, made lighter or darker by `change(x, y)` grey
// levels.
template <typename Change>
[[nodiscard]] image::RgbImage Tinted(int size, image::Color tint, const Change& change) {
  return Painted(size, [&](double x, double y) { return Lighter(tint, change(x, y)); });
}

// Returns how far a place is from the joints of a grid, in shares of a cell.
[[nodiscard]] double JointDistance(double share);

void Block(image::Canvas& canvas, double x, double y, double width, double height,
           image::Color color);
// These draw on a picture that repeats: a shape that leaves it on one side comes in on the other.
void WrappedLine(image::Canvas& canvas, image::PixelPoint from, image::PixelPoint to,
                 image::Color color, double width_px);
void WrappedPolygon(image::Canvas& canvas, const std::vector<image::PixelPoint>& corners,
                    image::Color color);

[[nodiscard]] TexturePtr Finish(const image::RgbImage& picture);
[[nodiscard]] TexturePtr Finish(const image::Canvas& canvas);

}  // namespace trailcast::sim
