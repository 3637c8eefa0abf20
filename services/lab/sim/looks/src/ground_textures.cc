#include <cmath>
#include <numbers>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

// These are the ground out of doors and what is beside it, as pictures that repeat.

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

Canvas CanvasOn(const image::RgbImage& picture) {
  Canvas canvas(picture.width, picture.height, {0, 0, 0});
  canvas.Paste(picture, 0, 0, picture.width, picture.height);
  return canvas;
}

// Draws blades of grass: short strokes, more or less upright, each of a tone of its own.
void DrawBlades(Canvas& canvas, Random& random, int count, Color tint, double longest_px) {
  const double size = canvas.picture().width;
  for (int i = 0; i < count; ++i) {
    const image::PixelPoint root{random.Uniform(0.0, size), random.Uniform(0.0, size)};
    const double length = random.Uniform(0.4, 1.0) * longest_px;
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const Color color =
        Mix(Lighter(tint, random.Uniform(-34.0, 34.0)), {176, 164, 96}, random.Uniform(0.0, 0.35));
    WrappedLine(canvas, root,
                {root.x + length * std::cos(angle), root.y + length * std::sin(angle)}, color,
                random.Uniform() < 0.3 ? 2.0 : 1.0);
  }
}

void DrawPebbles(Canvas& canvas, Random& random, int count, double largest_px) {
  const double size = canvas.picture().width;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(0.0, size);
    const double y = random.Uniform(0.0, size);
    const double radius = random.Uniform(0.25, 1.0) * largest_px;
    std::vector<image::PixelPoint> outline;
    for (int corner = 0; corner < 6; ++corner) {
      const double angle = corner * std::numbers::pi / 3.0;
      const double reach = radius * random.Uniform(0.7, 1.1);
      outline.push_back({x + reach * std::cos(angle), y + 0.8 * reach * std::sin(angle)});
    }
    WrappedPolygon(canvas, outline, Lighter({142, 134, 122}, random.Uniform(-36.0, 40.0)));
  }
}

}  // namespace

TexturePtr Asphalt(Color tint, std::uint64_t seed) {
  Random random(seed, "asphalt");
  const RandomField stains(4, 4, random);
  const RandomField blotches(13, 13, random);
  const RandomField worn(48, 48, random);
  const RandomField gravel(340, 340, random);
  const RandomField fine(512, 512, random);
  Canvas canvas = CanvasOn(Tinted(1024, tint, [&](double x, double y) {
    const double stone = std::max(0.0, gravel.At(x, y) - 0.35);
    return 9.0 * stains.At(x, y) + 8.0 * blotches.At(x, y) + 5.0 * worn.At(x, y) + 50.0 * stone +
           14.0 * fine.At(x, y);
  }));
  for (int i = 0; i < 14; ++i) {  // oil drops and chewing gum
    canvas.Disc({random.Uniform(20.0, 1000.0), random.Uniform(20.0, 1000.0)},
                random.Uniform(2.0, 7.0), Lighter(tint, random.Uniform(-30.0, -12.0)));
  }
  return Finish(canvas);
}

TexturePtr Concrete(Color tint, std::uint64_t seed) {
  Random random(seed, "concrete");
  const RandomField stains(4, 4, random);
  const RandomField streaks(40, 2, random);
  const RandomField pores(180, 180, random);
  return Finish(Tinted(512, tint, [&](double x, double y) {
    const double joint = JointDistance(x) < 0.003 || JointDistance(y) < 0.003 ? -42.0 : 0.0;
    const double pore = std::max(0.0, pores.At(x, y) - 0.62);
    return 9.0 * stains.At(x, y) + 6.0 * streaks.At(x, y) - 75.0 * pore + joint;
  }));
}

TexturePtr Slabs(std::uint64_t seed) {
  Random random(seed, "slabs");
  constexpr int kSlabs = 5;
  std::vector<double> tones(std::size_t{kSlabs} * kSlabs);
  for (double& tone : tones) tone = random.Uniform(-12.0, 12.0);
  const RandomField stains(6, 6, random);
  const RandomField fine(256, 256, random);
  return Finish(Tinted(512, {158, 154, 146}, [&](double x, double y) {
    const double joint = std::min(JointDistance(x * kSlabs), JointDistance(y * kSlabs));
    const auto slab =
        image::PixelIndex(static_cast<int>(x * kSlabs), static_cast<int>(y * kSlabs), kSlabs);
    return tones[slab] + 7.0 * stains.At(x, y) + 10.0 * fine.At(x, y) -
           (joint < 0.012 ? 48.0 : 0.0);
  }));
}

TexturePtr Lawn(std::uint64_t seed) {
  Random random(seed, "lawn");
  const RandomField patches(5, 5, random);
  Canvas canvas = CanvasOn(Painted(1024, [&](double x, double y) {
    return Mix({92, 112, 62}, {136, 134, 82}, 0.5 + 0.5 * patches.At(x, y));
  }));
  DrawBlades(canvas, random, 18000, {112, 126, 72}, 15.0);
  return Finish(canvas);
}

TexturePtr Turf(std::uint64_t seed) {
  Random random(seed, "turf");
  const RandomField patches(4, 4, random);
  const RandomField tufts(256, 256, random);
  return Finish(Painted(512, [&](double x, double y) {
    const Color grass = Mix({112, 126, 74}, {126, 132, 84}, 0.5 + 0.5 * patches.At(x, y));
    return Lighter(grass, 5.0 * tufts.At(x, y));
  }));
}

TexturePtr Meadow(std::uint64_t seed) {
  Random random(seed, "meadow");
  const RandomField bare(5, 5, random);
  const RandomField edge(24, 24, random);
  const RandomField fine(300, 300, random);
  const auto earth_share = [&](double x, double y) {
    return std::clamp(1.8 * (bare.At(x, y) + 0.45 * edge.At(x, y)), 0.0, 1.0);
  };
  const image::RgbImage earth = Tinted(1024, {134, 112, 84}, [&](double x, double y) {
    return 16.0 * edge.At(x, y) + 14.0 * fine.At(x, y);
  });
  Canvas soil = CanvasOn(earth);
  DrawPebbles(soil, random, 500, 8.0);
  Canvas grass = CanvasOn(
      Tinted(1024, {96, 108, 62}, [&](double x, double y) { return 14.0 * edge.At(x, y); }));
  DrawBlades(grass, random, 20000, {124, 134, 80}, 14.0);
  image::RgbImage both = grass.picture();
  for (std::size_t i = 0; i < both.pixels.size(); ++i) {
    const auto pixel = static_cast<int>(i / 3);
    const int row = pixel / 1024;
    const double share = earth_share((pixel % 1024 + 0.5) / 1024, (row + 0.5) / 1024);
    both.pixels[i] = static_cast<std::uint8_t>((1.0 - share) * grass.picture().pixels[i] +
                                               share * soil.picture().pixels[i]);
  }
  return Finish(both);
}

TexturePtr WornPaint(std::uint64_t seed) {
  Random random(seed, "paint");
  const RandomField wear(9, 9, random);
  const RandomField grains(160, 160, random);
  return Finish(Painted(512, [&](double x, double y) {
    const double worn = 1.6 * (0.7 * wear.At(x, y) + 0.6 * grains.At(x, y) - 0.35);
    return Mix(Lighter({214, 212, 202}, 6.0 * grains.At(x, y)), {112, 112, 112},
               std::clamp(worn, 0.0, 0.9));
  }));
}

TexturePtr Stone(std::uint64_t seed) {
  Random random(seed, "stone");
  const RandomField blotches(6, 6, random);
  const RandomField grains(90, 90, random);
  return Finish(Tinted(256, {150, 144, 132}, [&](double x, double y) {
    return 20.0 * blotches.At(x, y) + 14.0 * grains.At(x, y);
  }));
}

}  // namespace trailcast::sim
