#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "services/image/files.h"
#include "services/image/image.h"

namespace trailcast::test {

// Returns picture `frame` of a camera that goes straight at a wall, each nearer than the one before
// by one percent. The wall has blocks of all sizes, so that there are corners to track however near
// it is.
inline image::GrayImage WalkFrame(int frame, int width = 160, int height = 120) {
  const auto brightness = [](std::int64_t column, std::int64_t row, std::uint64_t size) {
    std::uint64_t hash = static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15ULL ^
                         static_cast<std::uint64_t>(row) * 0xC2B2AE3D27D4EB4FULL ^
                         size * 0x165667B1ULL;
    hash = (hash ^ (hash >> 29U)) * 0xBF58476D1CE4E5B9ULL;
    return static_cast<double>((hash ^ (hash >> 32U)) & 0xFFU);
  };
  const double zoom = std::exp(0.01 * frame);
  image::GrayImage picture{width, height, {}};
  picture.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wall_x = (x - width / 2.0) / zoom;
      const double wall_y = (y - height / 2.0) / zoom;
      double grey = 0.0;
      double size = 27.0;
      for (std::uint64_t octave = 0; octave < 4; ++octave, size /= 3.0) {
        grey += 0.25 * brightness(static_cast<std::int64_t>(std::floor(wall_x / size)),
                                  static_cast<std::int64_t>(std::floor(wall_y / size)), octave);
      }
      picture.pixels.push_back(static_cast<std::uint8_t>(grey));
    }
  }
  return picture;
}

// Writes the first `count` pictures of the walk into `folder`, which it makes.
inline void WriteWalk(const std::filesystem::path& folder, int count, int width = 160,
                      int height = 120, int first = 0) {
  std::filesystem::create_directories(folder);
  for (int i = first; i < first + count; ++i) {
    const auto file = folder / (std::to_string(100'000 + i).substr(1) + ".png");
    if (!image::WritePng(WalkFrame(i, width, height), file)) {
      throw std::runtime_error("cannot write " + file.string());
    }
  }
}

}  // namespace trailcast::test
