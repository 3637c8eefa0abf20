#include "services/lab/sim/looks/src/pedestrian_textures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/src/pattern.h"

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;

enum class Weave { kPlain, kStriped, kChecked };

// Returns the grey levels that a pattern adds to its cloth.
double Pattern(Weave weave, double repeats, double x, double y) {
  const double across = std::sin(kFullTurn_rad * repeats * x);
  const double along = std::sin(kFullTurn_rad * repeats * y);
  if (weave == Weave::kStriped) return along > 0.55 ? 46.0 : 0.0;
  if (weave == Weave::kChecked) return (across > 0.5 ? 22.0 : 0.0) - (along > 0.5 ? 26.0 : 0.0);
  return 0.0;
}

Canvas OnCanvas(const image::RgbImage& cloth) {
  Canvas canvas(cloth.width, cloth.height, {0, 0, 0});
  canvas.Paste(cloth, 0, 0, cloth.width, cloth.height);
  return canvas;
}

}  // namespace

TexturePtr Jacket(Color tint, std::uint64_t seed) {
  constexpr double kSize = 512.0;
  Random random(seed, "jacket");
  const RandomField folds(7, 5, random);
  const RandomField creases(23, 16, random);
  const auto weave = static_cast<Weave>(random.Integer(0, 2));
  const double repeats = random.Integer(6, 12);
  Canvas canvas = OnCanvas(Tinted(static_cast<int>(kSize), tint, [&](double x, double y) {
    return Pattern(weave, repeats, x, y) + 11.0 * folds.At(x, y) + 8.0 * creases.At(x, y);
  }));
  const Color dark = Lighter(tint, -42.0);
  const Color light = Lighter(tint, 38.0);
  const double middle = 0.5 * kSize;
  Block(canvas, 0.0, 0.0, kSize, 0.07 * kSize, dark);           // collar
  Block(canvas, 0.0, 0.95 * kSize, kSize, 0.05 * kSize, dark);  // hem
  canvas.Line({{middle, 0.0}, {middle, kSize}}, dark, 7.0);     // zip
  canvas.Line({{middle, 0.0}, {middle, kSize}}, light, 2.0);
  for (const double side : {-1.0, 1.0}) {
    const double pocket = middle + side * 0.13 * kSize;
    canvas.Line({{pocket - 26.0, 0.70 * kSize}, {pocket + 26.0, 0.68 * kSize}}, dark, 5.0);
    canvas.Line({{pocket - 26.0, 0.715 * kSize}, {pocket + 26.0, 0.695 * kSize}}, light, 2.0);
    const double seam = middle + side * 0.25 * kSize;
    canvas.Line({{seam, 0.0}, {seam, kSize}}, dark, 2.0);
  }
  Block(canvas, middle + 0.07 * kSize, 0.22 * kSize, 0.07 * kSize, 0.035 * kSize, light);  // badge
  return Finish(canvas);
}

TexturePtr TrouserLeg(Color tint, std::uint64_t seed) {
  Random random(seed, "trousers");
  const RandomField folds(3, 9, random);
  const RandomField creases(11, 34, random);
  Canvas canvas = OnCanvas(Tinted(256, tint, [&](double x, double y) {
    const double worn = 16.0 * std::exp(-60.0 * (x - 0.5) * (x - 0.5));  // over the knee
    return worn + 9.0 * folds.At(x, y) + 9.0 * creases.At(x, y);
  }));
  for (const double seam : {0.25, 0.75}) {
    canvas.Line({{256.0 * seam, 0.0}, {256.0 * seam, 256.0}}, Lighter(tint, -30.0), 3.0);
  }
  Block(canvas, 0.0, 246.0, 256.0, 3.0, Lighter(tint, -30.0));
  return Finish(canvas);
}

TexturePtr Head(Color skin, Color hair, std::uint64_t seed) {
  Random random(seed, "head");
  const RandomField strands(32, 5, random);
  const RandomField flush(4, 4, random);
  const double length = random.Uniform(0.45, 0.95);  // of the hair at the back
  Canvas canvas = OnCanvas(Painted(256, [&](double x, double y) {
    const double off_front = std::abs(x - 0.5);
    const bool face = off_front < 0.19 && y > 0.34 + 0.3 * off_front;
    const bool neck = off_front >= 0.19 && y > length;
    if (face || neck) return Lighter(skin, 7.0 * flush.At(x, y) - 40.0 * std::max(0.0, y - 0.85));
    return Lighter(hair, 24.0 * strands.At(x, y));
  }));
  const Color shadow = Lighter(skin, -48.0);
  for (const double side : {-1.0, 1.0}) {
    const double eye = 128.0 + side * 17.0;
    canvas.Disc({eye, 132.0}, 5.5, {236, 234, 230});
    canvas.Disc({eye, 132.0}, 3.2, {40, 34, 30});
    canvas.Line({{eye - 9.0, 122.0}, {eye + 9.0, 121.0}}, hair, 4.0);
    canvas.Line({{128.0 + side * 6.0, 168.0}, {128.0 + side * 2.0, 140.0}}, shadow, 2.5);
  }
  canvas.Line({{114.0, 190.0}, {128.0, 193.0}, {142.0, 190.0}}, {140, 70, 66}, 5.0);
  return Finish(canvas);
}

}  // namespace trailcast::sim
