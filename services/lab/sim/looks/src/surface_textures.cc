#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

namespace trailcast::sim {

TexturePtr WoodGrain(image::Color tint, std::uint64_t seed) {
  Random random(seed, "wood");
  const RandomField bend(3, 3, random);
  const RandomField rings(2, 24, random);
  const RandomField fibres(16, 256, random);
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
  const RandomField rings(6, 160, random);
  const RandomField fibres(24, 512, random);
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
  const RandomField tufts(128, 128, random);
  const RandomField wear(3, 3, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double joint = std::min(JointDistance(2.0 * x), JointDistance(2.0 * y));
    const bool turned = (static_cast<int>(2.0 * x) + static_cast<int>(2.0 * y)) % 2 == 1;
    return 7.0 * tufts.At(x, y) + 5.0 * wear.At(x, y) + (turned ? 7.0 : 0.0) -
           (joint < 0.008 ? 14.0 : 0.0);
  }));
}

TexturePtr Plaster(image::Color tint, std::uint64_t seed) {
  Random random(seed, "plaster");
  const RandomField stains(4, 4, random);
  const RandomField roller(48, 48, random);
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
  const RandomField rough(128, 128, random);
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
  const RandomField holes(160, 160, random);
  return Finish(Tinted(512, {222, 222, 218}, [&](double x, double y) {
    const double joint = std::min(JointDistance(2.0 * x), JointDistance(2.0 * y));
    return (joint < 0.02 ? -45.0 : 0.0) - 16.0 * std::max(0.0, holes.At(x, y) - 0.4);
  }));
}

TexturePtr Fabric(image::Color tint, std::uint64_t seed) {
  Random random(seed, "fabric");
  const RandomField folds(3, 3, random);
  return Finish(Tinted(256, tint, [&](double x, double y) {
    const double weave =
        std::sin(128.0 * std::numbers::pi * x) * std::sin(128.0 * std::numbers::pi * y);
    return 6.0 * weave + 6.0 * folds.At(x, y);
  }));
}

}  // namespace trailcast::sim
