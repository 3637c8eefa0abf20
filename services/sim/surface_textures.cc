#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/sim/indoor_textures.h"
#include "services/sim/random.h"

namespace trailcast::sim {
namespace {

// Smooth random field that repeats after `period` cells: values at lattice points, blended.
class Field {
 public:
  Field(int period_x, int period_y, Random& random) : width_(period_x), height_(period_y) {
    for (int i = 0; i < period_x * period_y; ++i) values_.push_back(random.Uniform(-1.0, 1.0));
  }
  // x, y in 0..1 over the picture.
  [[nodiscard]] double At(double x, double y) const {
    const double u = x * width_;
    const double v = y * height_;
    const double a = Smooth(u - std::floor(u));
    const double b = Smooth(v - std::floor(v));
    const int i = static_cast<int>(std::floor(u));
    const int j = static_cast<int>(std::floor(v));
    const double upper = (1.0 - a) * Value(i, j) + a * Value(i + 1, j);
    const double lower = (1.0 - a) * Value(i, j + 1) + a * Value(i + 1, j + 1);
    return (1.0 - b) * upper + b * lower;
  }

 private:
  static double Smooth(double t) { return t * t * (3.0 - 2.0 * t); }
  [[nodiscard]] double Value(int i, int j) const {
    const int x = ((i % width_) + width_) % width_;
    const int y = ((j % height_) + height_) % height_;
    return values_[image::PixelIndex(x, y, width_)];
  }
  int width_;
  int height_;
  std::vector<double> values_;
};

// A square picture whose pixels are `tint` made lighter or darker by `change(x, y)` grey levels.
template <typename Change>
image::RgbImage Tinted(int size, image::Color tint, const Change& change) {
  image::RgbImage picture{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double levels = change((x + 0.5) / size, (y + 0.5) / size);
      for (const std::uint8_t channel : tint) {
        picture.pixels.push_back(
            static_cast<std::uint8_t>(std::clamp(channel + levels, 0.0, 255.0)));
      }
    }
  }
  return picture;
}

TexturePtr Finish(const image::RgbImage& picture) { return std::make_shared<Texture>(picture); }

// How far a place is from the joints of a grid, in shares of a cell.
double JointDistance(double share) {
  const double inside = share - std::floor(share);
  return std::min(inside, 1.0 - inside);
}

}  // namespace

TexturePtr WoodGrain(image::Color tint, std::uint64_t seed) {
  Random random(seed, "wood");
  const Field bend(3, 3, random);
  const Field rings(2, 24, random);
  const Field fibres(16, 256, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double across = y + 0.03 * bend.At(x, y);
    return 16.0 * rings.At(x, across) + 5.0 * fibres.At(x, across);
  }));
}

TexturePtr FloorBoards(std::uint64_t seed) {
  Random random(seed, "boards");
  constexpr int kBoards = 16;
  constexpr int kLengths = 2;
  std::vector<double> tones;
  std::vector<double> offsets;
  tones.reserve(std::size_t{kBoards} * kLengths);
  offsets.reserve(kBoards);
  for (int i = 0; i < kBoards; ++i) {
    offsets.push_back(random.Uniform());
    for (int j = 0; j < kLengths; ++j) tones.push_back(random.Uniform(-22.0, 22.0));
  }
  const Field rings(6, 160, random);
  const Field fibres(24, 512, random);
  return Finish(Tinted(1024, {168, 128, 88}, [&](double x, double y) {
    const int board = static_cast<int>(y * kBoards);
    const double along = x * kLengths + offsets[static_cast<std::size_t>(board)];
    const int piece = static_cast<int>(along) % kLengths;
    const double joint = std::min(JointDistance(y * kBoards) / kBoards, JointDistance(along) / 2.0);
    const double tone = tones[image::PixelIndex(piece, board, kLengths)];
    return tone + 11.0 * rings.At(x, y) + 5.0 * fibres.At(x, y) - (joint < 0.0012 ? 55.0 : 0.0);
  }));
}

TexturePtr CarpetTiles(image::Color tint, std::uint64_t seed) {
  Random random(seed, "carpet");
  const Field tufts(128, 128, random);
  const Field wear(3, 3, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double joint = std::min(JointDistance(2.0 * x), JointDistance(2.0 * y));
    const bool turned = (static_cast<int>(2.0 * x) + static_cast<int>(2.0 * y)) % 2 == 1;
    return 7.0 * tufts.At(x, y) + 5.0 * wear.At(x, y) + (turned ? 7.0 : 0.0) -
           (joint < 0.008 ? 14.0 : 0.0);
  }));
}

TexturePtr Plaster(image::Color tint, std::uint64_t seed) {
  Random random(seed, "plaster");
  const Field stains(4, 4, random);
  const Field roller(48, 48, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    return 3.0 * stains.At(x, y) + 1.5 * roller.At(x, y);
  }));
}

TexturePtr Brickwork(std::uint64_t seed) {
  Random random(seed, "bricks");
  constexpr int kCourses = 20;
  constexpr int kBricks = 6;
  std::vector<double> tones;
  tones.reserve(std::size_t{kCourses} * kBricks);
  for (int i = 0; i < kCourses * kBricks; ++i) tones.push_back(random.Uniform(-25.0, 25.0));
  const Field rough(128, 128, random);
  return Finish(Tinted(1024, {176, 116, 92}, [&](double x, double y) {
    const int course = static_cast<int>(y * kCourses);
    const double along = x * kBricks + (course % 2 == 0 ? 0.0 : 0.5);
    const int brick = static_cast<int>(along) % kBricks;
    const double upright_m = JointDistance(along) * 0.25;
    const double level_m = JointDistance(y * kCourses) * 0.075;
    if (std::min(upright_m, level_m) < 0.005) return 48.0 + 4.0 * rough.At(x, y);
    return tones[image::PixelIndex(brick, course, kBricks)] + 9.0 * rough.At(x, y);
  }));
}

TexturePtr CeilingTiles(std::uint64_t seed) {
  Random random(seed, "ceiling");
  const Field holes(160, 160, random);
  return Finish(Tinted(512, {222, 222, 218}, [&](double x, double y) {
    const double joint = std::min(JointDistance(2.0 * x), JointDistance(2.0 * y));
    return (joint < 0.02 ? -45.0 : 0.0) - 16.0 * std::max(0.0, holes.At(x, y) - 0.4);
  }));
}

TexturePtr Fabric(image::Color tint, std::uint64_t seed) {
  Random random(seed, "fabric");
  const Field folds(3, 3, random);
  return Finish(Tinted(256, tint, [&](double x, double y) {
    const double weave =
        std::sin(128.0 * std::numbers::pi * x) * std::sin(128.0 * std::numbers::pi * y);
    return 6.0 * weave + 6.0 * folds.At(x, y);
  }));
}

}  // namespace trailcast::sim
