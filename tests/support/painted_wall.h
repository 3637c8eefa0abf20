#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "services/image/image.h"

namespace trailcast::test {

// This is a flat wall of overlapping rectangles with soft edges, which can be photographed at any
// magnification, shift and gain. Its images are analytic, so that tests know where each point went.
class PaintedWall {
 public:
  explicit PaintedWall(unsigned seed, int rectangles = 160) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    for (int i = 0; i < rectangles; ++i) {
      rectangles_.push_back({uniform(-260, 260), uniform(-200, 200), uniform(8, 45), uniform(8, 45),
                             uniform(-90, 90)});
    }
  }

  // Returns the grey level at a point of the wall, before gain.
  [[nodiscard]] double Level(double x, double y) const {
    double level = 120.0;
    for (const Rectangle& r : rectangles_) {
      if (std::abs(x - r.x) > r.half_width + kSoftEdge ||
          std::abs(y - r.y) > r.half_height + kSoftEdge) {
        continue;
      }
      level += r.contrast * Soft(r.half_width - std::abs(x - r.x)) *
               Soft(r.half_height - std::abs(y - r.y));
    }
    return level;
  }

  // Returns a frame in which the wall's point (x, y) appears at scale * (x, y) + (du, dv) pixels
  // from the image centre, turned clockwise by roll_rad before the shift, with all grey levels
  // multiplied by `gain` and with noise of `noise_grey`.
  struct View {
    double scale = 1.0;
    double du_px = 0.0;
    double dv_px = 0.0;
    double gain = 1.0;
    double noise_grey = 0.0;
    int width = 320;
    int height = 240;
    unsigned noise_seed = 1;
    double roll_rad = 0.0;
  };

  [[nodiscard]] image::GrayImage Photograph(const View& view) const {
    image::GrayImage frame{view.width, view.height, {}};
    std::mt19937 random(view.noise_seed);
    for (int row = 0; row < view.height; ++row) {
      for (int column = 0; column < view.width; ++column) {
        const double u = (column - 0.5 * (view.width - 1) - view.du_px) / view.scale;
        const double v = (row - 0.5 * (view.height - 1) - view.dv_px) / view.scale;
        const double x = std::cos(view.roll_rad) * u + std::sin(view.roll_rad) * v;
        const double y = std::cos(view.roll_rad) * v - std::sin(view.roll_rad) * u;
        // The sum of three uniform numbers is close enough to a Gaussian of standard deviation 1/2.
        double noise = -1.5;
        for (int i = 0; i < 3; ++i) noise += static_cast<double>(random()) / 4294967296.0;
        const double grey = view.gain * Level(x, y) + 2.0 * view.noise_grey * noise;
        frame.pixels.push_back(static_cast<std::uint8_t>(std::clamp(grey + 0.5, 0.0, 255.0)));
      }
    }
    return frame;
  }

 private:
  struct Rectangle {
    double x, y, half_width, half_height, contrast;
  };
  static constexpr double kSoftEdge = 5.0;  // beyond it the step is below 1e-4
  // Returns 0 outside and 1 inside, with a smooth step of about 2 units between.
  static double Soft(double inside) { return 1.0 / (1.0 + std::exp(-2.0 * inside)); }

  std::vector<Rectangle> rectangles_;
};

}  // namespace trailcast::test
