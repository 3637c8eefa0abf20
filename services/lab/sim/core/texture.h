#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/image/image.h"

namespace trailcast::sim {

// A picture on a surface with its mip-maps, in colour and in grey. u runs to the right and v down,
// from 0 to 1 over the picture, repeating beyond. `level` 0 is full resolution, and each further
// one is half the last; levels between are blended. Values are grey levels as stored, 0 to 255 (not
// linear light).
class Texture {
 public:
  // `picture` must not be empty.
  explicit Texture(const image::RgbImage& picture);

  [[nodiscard]] float Gray(float u, float v, float level) const;
  // Returns the average of `count` lookups in line, `step` apart, about `middle`. The lookups are
  // shared out between the two levels, instead of blending each of them.
  [[nodiscard]] float GrayAlong(const Eigen::Vector2f& middle, const Eigen::Vector2f& step,
                                int count, float level) const;
  [[nodiscard]] Eigen::Vector3f Rgb(float u, float v, float level) const;
  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }

 private:
  // 7 x 7 grey texels with the next column and row (round the picture's edges). Everything that one
  // lookup needs is in one cache line, and so is what its neighbours need.
  struct alignas(64) Tile {
    static constexpr int kSide = 7;
    static constexpr int kStride = 8;
    std::array<std::uint8_t, static_cast<std::size_t>(kStride* kStride)> gray;
  };
  // A point in 2^-32 of width and height, because whole numbers repeat by themselves.
  struct Point {
    std::uint32_t u = 0;
    std::uint32_t v = 0;
  };
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<Tile> gray;
    int tiles_a_row = 0;
    Point half_texel = {};
  };
  static Point PointAt(float u, float v);
  [[nodiscard]] float GrayOnLevel(Point at, int level) const;
  static Level Halve(const Level& level);
  static void FillGray(Level& level);

  std::vector<Level> levels_;
};

using TexturePtr = std::shared_ptr<const Texture>;

}  // namespace trailcast::sim
