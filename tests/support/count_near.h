#pragma once

#include <cmath>
#include <cstddef>

#include "services/image/canvas.h"
#include "services/image/image.h"

namespace trailcast::test {

// Returns how many pixels have about this colour.
inline int CountNear(const image::RgbImage& picture, image::Color color) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
    int difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      difference += std::abs(static_cast<int>(picture.pixels[i + c]) - color[c]);
    }
    count += difference < 30 ? 1 : 0;
  }
  return count;
}

}  // namespace trailcast::test
