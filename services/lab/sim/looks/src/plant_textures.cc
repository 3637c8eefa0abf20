#include <cmath>
#include <numbers>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

// These are leaves, bark, planks and tiles, as pictures that repeat.

namespace trailcast::sim {

using image::Canvas;
using image::Color;

TexturePtr Foliage(Color tint, std::uint64_t seed) {
  Random random(seed, "foliage");
  const RandomField boughs(5, 5, random);
  Canvas canvas(512, 512, Lighter(tint, -64.0));
  constexpr int kLeaves = 1100;
  for (int i = 0; i < kLeaves; ++i) {
    // Later leaves lie on top, in the light.
    const double depth = static_cast<double>(i) / kLeaves;
    const double x = random.Uniform(0.0, 512.0);
    const double y = random.Uniform(0.0, 512.0);
    const double length = random.Uniform(12.0, 22.0);
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double wide = 0.32 * length;
    const Color leaf = Lighter(tint, -46.0 + 54.0 * depth + 30.0 * boughs.At(x / 512.0, y / 512.0) +
                                         random.Uniform(-18.0, 18.0));
    WrappedPolygon(canvas,
                   {{x - length * c, y - length * s},
                    {x - wide * s, y + wide * c},
                    {x + length * c, y + length * s},
                    {x + wide * s, y - wide * c}},
                   leaf);
    WrappedLine(canvas, {x - length * c, y - length * s},
                {x + 0.8 * length * c, y + 0.8 * length * s}, Lighter(leaf, -14.0), 1.0);
  }
  return Finish(canvas);
}

TexturePtr Bark(std::uint64_t seed) {
  Random random(seed, "bark");
  const RandomField ridges(14, 4, random);
  const RandomField cracks(40, 9, random);
  const RandomField fine(100, 60, random);
  return Finish(Tinted(256, {108, 94, 78}, [&](double x, double y) {
    return 16.0 * ridges.At(x, y) - 42.0 * std::max(0.0, cracks.At(x, y) - 0.2) +
           12.0 * fine.At(x, y);
  }));
}

TexturePtr Planks(Color tint, std::uint64_t seed) {
  Random random(seed, "planks");
  constexpr int kPlanks = 8;
  std::vector<double> tones(kPlanks);
  for (double& tone : tones) tone = random.Uniform(-18.0, 18.0);
  const RandomField grain(70, 4, random);
  const RandomField weather(5, 5, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double joint = JointDistance(x * kPlanks);
    return tones[static_cast<std::size_t>(x * kPlanks)] + 13.0 * grain.At(x, y) +
           10.0 * weather.At(x, y) - (joint < 0.04 ? 55.0 : 0.0);
  }));
}

TexturePtr RoofTiles(Color tint, std::uint64_t seed) {
  Random random(seed, "tiles");
  constexpr int kRows = 8;
  constexpr int kColumns = 10;
  std::vector<double> tones(std::size_t{kRows} * kColumns);
  for (double& tone : tones) tone = random.Uniform(-16.0, 16.0);
  const RandomField moss(6, 6, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double down = y * kRows - std::floor(y * kRows);
    const double round = std::sin(std::numbers::pi * (x * kColumns - std::floor(x * kColumns)));
    const auto tile =
        image::PixelIndex(static_cast<int>(x * kColumns), static_cast<int>(y * kRows), kColumns);
    return tones[tile] + 16.0 * round - 8.0 + 9.0 * moss.At(x, y) - (down > 0.88 ? 38.0 : 0.0);
  }));
}

}  // namespace trailcast::sim
