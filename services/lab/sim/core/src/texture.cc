#include "services/lab/sim/core/texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace trailcast::sim {
namespace {

// std::floor is a function call on processors before SSE4.1, and this is the innermost loop of
// rendering.
inline int FloorOf(float x) {
  const int cut = static_cast<int>(x);
  return cut - (static_cast<float>(cut) > x ? 1 : 0);
}

constexpr float kFarthest = 1e6F;  // repeats; beyond that, a float has no digits left for the texel

// Returns a repeating coordinate in 2^-32 of the picture.
inline std::uint32_t Fixed(float coordinate) {
  const float bounded = std::max(-kFarthest, std::min(kFarthest, coordinate));
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(bounded * 0x1.0p32F));
}

// The texel before a place along one axis, and the next one's weight in 256ths.
struct FixedTap {
  int texel;
  int weight;
};
inline FixedTap AlongFixedAxis(std::uint32_t at, int size, std::uint32_t half_texel) {
  const std::uint64_t place = std::uint64_t{at - half_texel} * static_cast<std::uint32_t>(size);
  return {static_cast<int>(place >> 32U), static_cast<int>((place >> 24U) & 0xFFU)};
}

// Where a lookup falls along one repeating axis: the texel before it and the next one's weight.
struct AxisTap {
  int texel;
  float weight;
};
inline AxisTap AlongAxis(float coordinate, int size) {
  const float bounded = std::min(std::max(coordinate, -kFarthest), kFarthest);
  const float share = bounded - static_cast<float>(FloorOf(bounded));
  // Adding one picture keeps the value above 0 when half a texel is taken off.
  const float at = (share + 1.0F) * static_cast<float>(size) - 0.5F;
  const int texel = static_cast<int>(at);
  return {texel >= size ? texel - size : texel, at - static_cast<float>(texel)};
}

inline float Blend(const AxisTap& x, const AxisTap& y, float a, float b, float c, float d) {
  const float upper = a + x.weight * (b - a);
  const float lower = c + x.weight * (d - c);
  return upper + y.weight * (lower - upper);
}

}  // namespace

Texture::Texture(const image::RgbImage& picture) {
  assert(!picture.empty());
  levels_.push_back({picture.width, picture.height, picture.pixels, {}});
  FillGray(levels_.back());
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(Halve(levels_.back()));
  }
}

void Texture::FillGray(Level& level) {
  const auto gray = [&](int x, int y) {
    const std::size_t i = image::PixelIndex(x % level.width, y % level.height, level.width);
    const std::uint8_t* p = &level.rgb[3 * i];
    return static_cast<std::uint8_t>((77 * p[0] + 150 * p[1] + 29 * p[2] + 128) >> 8);
  };
  level.half_texel = {0x80000000U / static_cast<std::uint32_t>(level.width),
                      0x80000000U / static_cast<std::uint32_t>(level.height)};
  level.tiles_a_row = (level.width + Tile::kSide - 1) / Tile::kSide;
  const int tile_rows = (level.height + Tile::kSide - 1) / Tile::kSide;
  level.gray.reserve(static_cast<std::size_t>(level.tiles_a_row) *
                     static_cast<std::size_t>(tile_rows));
  for (int row = 0; row < tile_rows; ++row) {
    for (int column = 0; column < level.tiles_a_row; ++column) {
      Tile tile;
      for (int i = 0; i < Tile::kStride * Tile::kStride; ++i) {
        tile.gray[static_cast<std::size_t>(i)] =
            gray(Tile::kSide * column + i % Tile::kStride, Tile::kSide * row + i / Tile::kStride);
      }
      level.gray.push_back(tile);
    }
  }
}

Texture::Level Texture::Halve(const Level& level) {
  Level half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}, {}};
  half.rgb.reserve(3U * static_cast<std::size_t>(half.width) *
                   static_cast<std::size_t>(half.height));
  // At odd sizes, each texel averages its share of rows and columns.
  for (int y = 0; y < half.height; ++y) {
    const int y0 = y * level.height / half.height;
    const int y1 = std::max(y0 + 1, (y + 1) * level.height / half.height);
    for (int x = 0; x < half.width; ++x) {
      const int x0 = x * level.width / half.width;
      const int x1 = std::max(x0 + 1, (x + 1) * level.width / half.width);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int row = y0; row < y1; ++row) {
          for (int column = x0; column < x1; ++column) {
            sum += level.rgb[3 * image::PixelIndex(column, row, level.width) + channel];
          }
        }
        const int count = (y1 - y0) * (x1 - x0);
        half.rgb.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
      }
    }
  }
  FillGray(half);
  return half;
}

Texture::Point Texture::PointAt(float u, float v) { return {Fixed(u), Fixed(v)}; }

inline float Texture::GrayOnLevel(Point at, int level) const {
  const int top = static_cast<int>(levels_.size()) - 1;
  const Level& l = levels_[static_cast<std::size_t>(std::clamp(level, 0, top))];
  const FixedTap x = AlongFixedAxis(at.u, l.width, l.half_texel.u);
  const FixedTap y = AlongFixedAxis(at.v, l.height, l.half_texel.v);
  const int column = x.texel / Tile::kSide;
  const int row = y.texel / Tile::kSide;
  const Tile& tile = l.gray[image::PixelIndex(column, row, l.tiles_a_row)];
  const auto* texels = &tile.gray[image::PixelIndex(x.texel - Tile::kSide * column,
                                                    y.texel - Tile::kSide * row, Tile::kStride)];
  const auto* below = texels + Tile::kStride;
  const int upper_row = 256 * texels[0] + x.weight * (texels[1] - texels[0]);
  const int lower_row = 256 * below[0] + x.weight * (below[1] - below[0]);
  return static_cast<float>(256 * upper_row + y.weight * (lower_row - upper_row)) *
         (1.0F / 65536.0F);
}

float Texture::Gray(float u, float v, float level) const {
  const float clamped = std::clamp(level, 0.0F, static_cast<float>(levels_.size() - 1));
  const int fine = static_cast<int>(clamped);
  const float share = clamped - static_cast<float>(fine);
  const Point at = PointAt(u, v);
  const float value = GrayOnLevel(at, fine);
  if (share < 0.02F) return value;
  return value + share * (GrayOnLevel(at, fine + 1) - value);
}

float Texture::GrayAlong(const Eigen::Vector2f& middle, const Eigen::Vector2f& step, int count,
                         float level) const {
  const Eigen::Vector2f first = middle - 0.5F * static_cast<float>(count - 1) * step;
  Point at = PointAt(first.x(), first.y());
  const Point stride = PointAt(step.x(), step.y());
  const float share = 1.0F / static_cast<float>(count);
  float lookup_level = std::max(level, 0.0F) + 0.5F * share;
  float sum = 0.0F;
  for (int i = 0; i < count; ++i, lookup_level += share) {
    sum += GrayOnLevel(at, static_cast<int>(lookup_level));
    at = {at.u + stride.u, at.v + stride.v};
  }
  return sum * share;
}

Eigen::Vector3f Texture::Rgb(float u, float v, float level) const {
  const float top = static_cast<float>(levels_.size() - 1);
  const Level& l = levels_[static_cast<std::size_t>(std::clamp(level + 0.5F, 0.0F, top))];
  const AxisTap x = AlongAxis(u, l.width);
  const AxisTap y = AlongAxis(v, l.height);
  const int next_x = x.texel + 1 == l.width ? 0 : x.texel + 1;
  const int next_y = y.texel + 1 == l.height ? 0 : y.texel + 1;
  Eigen::Vector3f color;
  for (int channel = 0; channel < 3; ++channel) {
    const auto texel = [&](int column, int row) {
      const std::size_t i =
          3 * image::PixelIndex(column, row, l.width) + static_cast<std::size_t>(channel);
      return static_cast<float>(l.rgb[i]);
    };
    color[channel] = Blend(x, y, texel(x.texel, y.texel), texel(next_x, y.texel),
                           texel(x.texel, next_y), texel(next_x, next_y));
  }
  return color;
}

}  // namespace trailcast::sim
