#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trailcast::image {

// Returns the index of pixel (x, y) in row-major pixels without padding.
[[nodiscard]] constexpr std::size_t PixelIndex(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

// An 8-bit grey picture, row-major without padding: pixel (x, y) is pixels[y * width + x].
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  [[nodiscard]] bool empty() const { return pixels.empty(); }
  [[nodiscard]] std::uint8_t at(int x, int y) const { return pixels[PixelIndex(x, y, width)]; }
};

// An 8-bit RGB picture, row-major, 3 bytes a pixel in the order red, green, blue.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  [[nodiscard]] bool empty() const { return pixels.empty(); }
};

}  // namespace trailcast::image
