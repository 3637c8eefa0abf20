#include <string>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

// These are the surfaces of vehicles.

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

std::string PlateText(Random& random) {
  const auto any = [&random](char first, char last) {
    return static_cast<char>(random.Integer(first, last));
  };
  std::string text = {any('A', 'Z'), any('A', 'Z'), ' '};
  for (int i = 0; i < 4; ++i) text += any('0', '9');
  return text;
}

// Draws a lamp: a bright glass in a dark bezel.
void LampGlass(Canvas& canvas, double x, double y, double width, double height, Color glass) {
  Block(canvas, x, y, width, height, {40, 40, 42});
  Block(canvas, x + 4, y + 4, width - 8, height - 8, glass);
  canvas.Disc({x + 0.5 * width, y + 0.5 * height}, 0.28 * height, Lighter(glass, 40.0));
}

}  // namespace

TexturePtr CarPaint(Color tint, std::uint64_t seed) {
  Random random(seed, "car paint");
  const RandomField mirrored(5, 3, random);
  const RandomField dust(60, 60, random);
  return Finish(Painted(128, [&](double x, double y) {
    // The horizon's reflection runs along the flank; the sill takes the dust of the road.
    const double band = 0.42 + 0.05 * mirrored.At(x, y);
    const double mirror = y < band ? 26.0 * (1.0 - y / band) : -20.0;
    const double dirt = std::clamp(1.8 * (y - 0.68), 0.0, 0.5) + 0.05 * dust.At(x, y);
    return Mix(Lighter(tint, mirror), {118, 112, 102}, std::clamp(dirt, 0.0, 1.0));
  }));
}

TexturePtr CarGlass(std::uint64_t seed) {
  Random random(seed, "car glass");
  Canvas canvas(128, 96, {44, 50, 56});
  for (int i = 0; i < 32; ++i) {
    Block(canvas, 0, 3 * i, 128, 3, Mix({134, 150, 164}, {36, 40, 44}, i / 32.0));
  }
  for (const double x : {34.0, 92.0}) {  // head rests and seats
    Block(canvas, x - 12, 34, 24, 16, {32, 33, 36});
    Block(canvas, x - 20, 52, 40, 44, {36, 37, 40});
  }
  for (int i = 0; i < 7; ++i) {  // trees mirrored
    canvas.Disc({random.Uniform(0, 128), random.Uniform(0, 26)}, random.Uniform(5, 13),
                Lighter({74, 84, 78}, random.Uniform(-14, 14)));
  }
  return Finish(canvas);
}

TexturePtr NumberPlate(std::uint64_t seed) {
  Random random(seed, "plate");
  Canvas canvas(192, 42, {238, 236, 226});
  Block(canvas, 0, 0, 18, 42, {36, 66, 150});
  canvas.Text(PlateText(random), {26, 33}, 24, {24, 24, 26});
  canvas.Line({{1, 1}, {190, 1}, {190, 40}, {1, 40}, {1, 1}}, {40, 40, 40}, 2);
  return Finish(canvas);
}

TexturePtr CarFront(Color tint, std::uint64_t seed) {
  Random random(seed, "car front");
  Canvas canvas(256, 96, tint);
  const double grille = random.Uniform(60, 110);
  Block(canvas, 128 - grille / 2, 22, grille, 26, {34, 34, 36});
  for (int i = 0; i < 4; ++i) {
    Block(canvas, 128 - grille / 2, 25 + 6 * i, grille, 2, {120, 122, 124});
  }
  canvas.Disc({128, 34}, 9, {176, 178, 180});
  LampGlass(canvas, 8, 18, 52, 30, {206, 210, 214});
  LampGlass(canvas, 196, 18, 52, 30, {206, 210, 214});
  Block(canvas, 0, 56, 256, 3, Lighter(tint, -40.0));
  Block(canvas, 40, 74, 176, 18, {38, 38, 40});
  canvas.Disc({26, 82}, 7, {200, 200, 196});
  canvas.Disc({230, 82}, 7, {200, 200, 196});
  return Finish(canvas);
}

TexturePtr CarRear(Color tint, std::uint64_t seed) {
  Random random(seed, "car rear");
  Canvas canvas(256, 96, tint);
  const double wide = random.Uniform(30, 54);
  LampGlass(canvas, 6, 10, wide, 34, {166, 30, 28});
  LampGlass(canvas, 250 - wide, 10, wide, 34, {166, 30, 28});
  Block(canvas, 6, 34, wide, 8, {214, 150, 60});
  Block(canvas, 250 - wide, 34, wide, 8, {214, 150, 60});
  Block(canvas, 0, 54, 256, 3, Lighter(tint, -40.0));
  Block(canvas, 0, 78, 256, 18, {40, 40, 42});
  canvas.Disc({60, 90}, 5, {110, 110, 110});
  return Finish(canvas);
}

TexturePtr Wheel() {
  Canvas canvas(128, 128, {28, 28, 30});
  canvas.Disc({64, 64}, 42, {150, 152, 156});
  for (int i = 0; i < 5; ++i) {
    constexpr double kTurn[5][2] = {
        {0.0, -1.0}, {0.951, -0.309}, {0.588, 0.809}, {-0.588, 0.809}, {-0.951, -0.309}};
    const double x = kTurn[i][0];
    const double y = kTurn[i][1];
    canvas.Disc({64 - 26 * x, 64 - 26 * y}, 10, {36, 36, 38});
  }
  canvas.Disc({64, 64}, 10, {96, 98, 102});
  return Finish(canvas);
}

}  // namespace trailcast::sim
