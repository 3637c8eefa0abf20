#include "services/sim/texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace trailcast::sim {
namespace {

// The four texels round a place and the weights of the right and lower ones.
struct Taps {
  std::size_t upper_left, upper_right, lower_left, lower_right;
  float right, lower;
};

// Position along one repeating axis: the two neighbouring texels and the second one's weight.
struct AxisTaps {
  int first, second;
  float weight;
};
AxisTaps AlongAxis(float coordinate, int size) {
  const float at = (coordinate - std::floor(coordinate)) * static_cast<float>(size) - 0.5F;
  const float below = std::floor(at);
  const int first = static_cast<int>(below);
  const int second = first + 1 >= size ? 0 : first + 1;
  return {first < 0 ? size - 1 : std::min(first, size - 1), second, at - below};
}

Taps TapsAt(float u, float v, int width, int height) {
  const AxisTaps x = AlongAxis(u, width);
  const AxisTaps y = AlongAxis(v, height);
  const auto row = [&](int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
  };
  const std::size_t upper = row(y.first);
  const std::size_t lower = row(y.second);
  const auto left = static_cast<std::size_t>(x.first);
  const auto right = static_cast<std::size_t>(x.second);
  return {upper + left, upper + right, lower + left, lower + right, x.weight, y.weight};
}

float Blend(const Taps& taps, float a, float b, float c, float d) {
  const float upper = a + taps.right * (b - a);
  const float lower = c + taps.right * (d - c);
  return upper + taps.lower * (lower - upper);
}

}  // namespace

Texture::Texture(const image::RgbImage& picture) {
  assert(!picture.empty());
  levels_.push_back({picture.width, picture.height, {}, picture.pixels});
  FillGray(levels_.back());
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(Halve(levels_.back()));
  }
}

void Texture::FillGray(Level& level) {
  level.gray.resize(level.rgb.size() / 3);
  for (std::size_t i = 0; i < level.gray.size(); ++i) {
    const std::uint8_t* p = &level.rgb[3 * i];
    level.gray[i] = static_cast<std::uint8_t>((77 * p[0] + 150 * p[1] + 29 * p[2] + 128) >> 8);
  }
}

Texture::Level Texture::Halve(const Level& level) {
  Level half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}, {}};
  half.rgb.reserve(3U * static_cast<std::size_t>(half.width) *
                   static_cast<std::size_t>(half.height));
  // Odd sizes: each texel averages the share of rows and columns that fall to it.
  for (int y = 0; y < half.height; ++y) {
    const int y0 = y * level.height / half.height;
    const int y1 = std::max(y0 + 1, (y + 1) * level.height / half.height);
    for (int x = 0; x < half.width; ++x) {
      const int x0 = x * level.width / half.width;
      const int x1 = std::max(x0 + 1, (x + 1) * level.width / half.width);
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int row = y0; row < y1; ++row) {
          for (int column = x0; column < x1; ++column) {
            sum += level.rgb[static_cast<std::size_t>(3 * (row * level.width + column) + channel)];
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

float Texture::Gray(float u, float v, float level) const {
  const float top = static_cast<float>(levels_.size() - 1);
  const float clamped = std::clamp(level, 0.0F, top);
  const auto fine = static_cast<std::size_t>(clamped);
  const float share = clamped - static_cast<float>(fine);
  const auto at = [&](const Level& l) {
    const Taps taps = TapsAt(u, v, l.width, l.height);
    return Blend(taps, l.gray[taps.upper_left], l.gray[taps.upper_right], l.gray[taps.lower_left],
                 l.gray[taps.lower_right]);
  };
  const float value = at(levels_[fine]);
  if (share < 0.02F) return value;
  return value + share * (at(levels_[fine + 1]) - value);
}

Eigen::Vector3f Texture::Rgb(float u, float v, float level) const {
  const float top = static_cast<float>(levels_.size() - 1);
  const Level& l = levels_[static_cast<std::size_t>(std::clamp(level + 0.5F, 0.0F, top))];
  const Taps taps = TapsAt(u, v, l.width, l.height);
  Eigen::Vector3f color;
  for (int channel = 0; channel < 3; ++channel) {
    const auto texel = [&](std::size_t i) {
      return static_cast<float>(l.rgb[3 * i + static_cast<std::size_t>(channel)]);
    };
    color[channel] = Blend(taps, texel(taps.upper_left), texel(taps.upper_right),
                           texel(taps.lower_left), texel(taps.lower_right));
  }
  return color;
}

}  // namespace trailcast::sim
