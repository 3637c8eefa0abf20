#include <string>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

// These are the room's fittings: doors, cupboards, windows, and the laboratory's devices.

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

}  // namespace

TexturePtr DoorLeaf(const char* sign) {
  Canvas canvas(270, 600, {150, 112, 74});
  for (int i = 0; i < 12; ++i) {
    canvas.Line({{23.0 * i + 6, 0}, {23.0 * i + 14, 600}}, {142, 104, 68}, 3);
  }
  Block(canvas, 60, 60, 150, 120, {196, 210, 214});
  canvas.Line({{60, 60}, {210, 60}, {210, 180}, {60, 180}, {60, 60}}, {90, 70, 50}, 5);
  Block(canvas, 75, 215, 120, 44, {240, 240, 240});
  canvas.Text(sign, {84, 246}, 20, {20, 40, 120});
  Block(canvas, 0, 540, 270, 60, {150, 150, 152});
  Block(canvas, 226, 300, 22, 60, {180, 180, 184});
  return Finish(canvas);
}

TexturePtr CupboardDoors(const char* label) {
  Canvas canvas(300, 560, {176, 180, 182});
  canvas.Line({{150, 0}, {150, 560}}, {70, 72, 74}, 4);
  canvas.Line({{3, 3}, {297, 3}, {297, 557}, {3, 557}, {3, 3}}, {110, 112, 115}, 5);
  for (int side = 0; side < 2; ++side) {
    const double x = side == 0 ? 40 : 190;
    for (int slot = 0; slot < 6; ++slot) Block(canvas, x, 40 + 14 * slot, 70, 5, {80, 82, 84});
    Block(canvas, side == 0 ? 128 : 162, 250, 10, 64, {50, 50, 52});
  }
  Block(canvas, 36, 170, 84, 40, {244, 240, 200});
  canvas.Text(label, {42, 197}, 15, {30, 30, 30});
  Block(canvas, 186, 176, 60, 60, {240, 200, 40});
  canvas.FillPolygon({{216, 184}, {238, 226}, {194, 226}}, {30, 30, 30});
  return Finish(canvas);
}

TexturePtr Instrument(std::uint64_t seed) {
  Random random(seed, "instrument");
  Canvas canvas(320, 160, {206, 204, 196});
  Block(canvas, 14, 16, 150, 112, {18, 46, 34});
  for (int i = 1; i < 6; ++i) {
    canvas.Line({{14 + 25.0 * i, 16}, {14 + 25.0 * i, 128}}, {40, 82, 62}, 1);
    if (i < 5) canvas.Line({{14, 16 + 22.0 * i}, {164, 16 + 22.0 * i}}, {40, 82, 62}, 1);
  }
  std::vector<image::PixelPoint> trace;
  trace.reserve(150);
  const double period = random.Uniform(20, 50);
  for (int x = 0; x < 150; ++x) {
    trace.push_back({14.0 + x, static_cast<int>(x / period) % 2 == 0 ? 50.0 : 96.0});
  }
  canvas.Line(trace, {150, 250, 120}, 2);
  for (int i = 0; i < 6; ++i) {
    const int row = i / 3;
    const int column = i % 3;
    canvas.Disc({190 + 44.0 * column, 44 + 56.0 * row}, random.Uniform(9, 16), {60, 60, 64});
    canvas.Disc({190 + 44.0 * column, 40 + 56.0 * row}, 3, {230, 230, 230});
  }
  for (int i = 0; i < 4; ++i) canvas.Disc({40 + 40.0 * i, 145}, 7, {190, 170, 90});
  return Finish(canvas);
}

TexturePtr WindowView(std::uint64_t seed) {
  Random random(seed, "window");
  Canvas canvas(480, 420, {214, 224, 234});
  for (int i = 0; i < 40; ++i) {
    const auto tone = static_cast<std::uint8_t>(196 + i);
    Block(canvas, 0, 6 * i, 480, 7, {tone, static_cast<std::uint8_t>(tone + 8), 240});
  }
  Block(canvas, 40, 90, 170, 220, {186, 152, 128});  // the building across the yard
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      Block(canvas, 54 + 31 * column, 104 + 40 * row, 18, 26, {92, 104, 118});
    }
  }
  for (int tree = 0; tree < 3; ++tree) {
    const double x = 270 + 80 * tree + random.Uniform(-15, 15);
    Block(canvas, x - 5, 230, 10, 90, {92, 74, 56});
    for (int i = 0; i < 26; ++i) {
      const auto green = static_cast<std::uint8_t>(random.Integer(95, 150));
      canvas.Disc({x + random.Uniform(-42, 42), 190 + random.Uniform(-50, 50)},
                  random.Uniform(8, 18), {static_cast<std::uint8_t>(green - 40), green, 70});
    }
  }
  Block(canvas, 0, 308, 480, 112, {130, 150, 104});
  Block(canvas, 0, 350, 480, 26, {168, 166, 160});
  return Finish(canvas);
}

}  // namespace trailcast::sim
