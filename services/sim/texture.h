#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "services/image/image.h"

namespace trailcast::sim {

// A picture on a surface with its mip-maps, in colour and in grey. u runs to the right and v down,
// 0 to 1 over the picture, repeating beyond. `level` 0 is full resolution, each next one half of
// it; levels between are blended. Values are grey levels as stored, 0 to 255 (not linear light).
class Texture {
 public:
  // `picture` must not be empty.
  explicit Texture(const image::RgbImage& picture);

  [[nodiscard]] float GrayOnLevel(float u, float v, int level) const;
  [[nodiscard]] float Gray(float u, float v, float level) const;
  [[nodiscard]] Eigen::Vector3f Rgb(float u, float v, float level) const;
  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    // Each texel with its right, lower and lower right neighbours (round the picture's edges):
    // what one lookup needs, in one place.
    std::vector<std::array<std::uint8_t, 4>> gray;
    std::vector<std::uint8_t> rgb;
  };
  static Level Halve(const Level& level);
  static void FillGray(Level& level);

  std::vector<Level> levels_;
};

}  // namespace trailcast::sim
