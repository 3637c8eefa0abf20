#include <array>
#include <string>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

// These are the openings in the walls of houses, and the signs on them.

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

constexpr std::array<const char*, 14> kShops = {
    "BAKERY",   "CAR PARTS", "HARDWARE", "SHOES",   "LAUNDRY", "BOOKS",  "GARDEN",
    "OPTICIAN", "BICYCLES",  "CAFE",     "FLOWERS", "MARKET",  "PAINTS", "TOOLS"};
constexpr std::array<Color, 6> kSignInks = {
    {{170, 40, 36}, {34, 66, 132}, {36, 104, 66}, {226, 178, 48}, {52, 52, 58}, {226, 224, 214}}};

Color SignInk(Random& random) {
  return kSignInks[static_cast<std::size_t>(
      random.Integer(0, static_cast<int>(kSignInks.size()) - 1))];
}
Color Readable(Color ground) {
  return ground[0] + ground[1] + ground[2] > 420 ? Color{30, 30, 34} : Color{238, 236, 228};
}

// A pane mirrors the sky, and below it the roofs and trees on the other side.
void Pane(Canvas& canvas, Random& random, double x, double y, double width, double height) {
  constexpr int kSteps = 24;
  for (int i = 0; i < kSteps; ++i) {
    Block(canvas, x, y + height * i / kSteps, width, height / kSteps + 1.0,
          Mix({128, 146, 164}, {62, 70, 78}, static_cast<double>(i) / kSteps));
  }
  double at = x;
  while (at < x + width) {
    const double wide = std::min(random.Uniform(0.15, 0.4) * width, x + width - at);
    const double tall = random.Uniform(0.25, 0.5) * height;
    Block(canvas, at, y + height - tall, wide, tall,
          Lighter({58, 62, 60}, random.Uniform(-14.0, 16.0)));
    at += wide;
  }
}

void Outline(Canvas& canvas, double inset, Color color, double width_px) {
  const double right = canvas.picture().width - inset;
  const double bottom = canvas.picture().height - inset;
  canvas.Line({{inset, inset}, {right, inset}, {right, bottom}, {inset, bottom}, {inset, inset}},
              color, width_px);
}

}  // namespace

TexturePtr HouseWindow(std::uint64_t seed) {
  Random random(seed, "house window");
  Canvas canvas(176, 264, {222, 220, 212});
  Pane(canvas, random, 12, 12, 152, 240);
  const double kind = random.Uniform();
  if (kind < 0.45) {  // curtains
    const Color cloth = Lighter({206, 200, 188}, random.Uniform(-50.0, 20.0));
    for (const double x : {12.0, 128.0}) {
      for (int fold = 0; fold < 4; ++fold) {
        Block(canvas, x + 9 * fold, 12, 9, 240, Lighter(cloth, fold % 2 == 0 ? -22.0 : 0.0));
      }
    }
  } else if (kind < 0.7) {  // a blind let down some way
    const int slats = random.Integer(6, 22);
    for (int i = 0; i < slats; ++i) {
      Block(canvas, 12, 12 + 9 * i, 152, 9,
            i % 2 == 0 ? Color{204, 200, 190} : Color{182, 178, 168});
    }
  } else if (kind < 0.85) {  // a pot plant on the sill
    Block(canvas, 70, 214, 34, 38, {150, 90, 64});
    for (int i = 0; i < 20; ++i) {
      canvas.Disc({87 + random.Uniform(-30, 30), 190 + random.Uniform(-26, 24)}, 9,
                  Lighter({66, 98, 58}, random.Uniform(-20, 26)));
    }
  }
  Block(canvas, 83, 0, 10, 264, {216, 214, 206});
  Block(canvas, 0, 84, 176, 8, {216, 214, 206});
  Outline(canvas, 5, {226, 224, 216}, 10);
  Outline(canvas, 11, {96, 94, 90}, 1);
  Outline(canvas, 1, {120, 116, 110}, 2);
  return Finish(canvas);
}

TexturePtr ShopWindow(std::uint64_t seed) {
  Random random(seed, "shop window");
  Canvas canvas(512, 256, {70, 72, 76});
  Pane(canvas, random, 8, 8, 496, 240);
  for (int i = 0; i < 9; ++i) {  // goods and posters behind it
    const double x = random.Uniform(14, 440);
    const double wide = random.Uniform(24, 60);
    const double tall = random.Uniform(30, 90);
    const Color color = Mix(SignInk(random), {90, 96, 102}, 0.35);
    Block(canvas, x, 240 - tall, wide, tall, color);
    Block(canvas, x + 5, 246 - tall, wide - 10, 5, Readable(color));
  }
  canvas.Text(kShops[static_cast<std::size_t>(random.Integer(0, 13))], {30, 70}, 26,
              {224, 222, 212});
  for (const double x : {169.0, 340.0}) Block(canvas, x, 0, 8, 256, {58, 60, 64});
  Outline(canvas, 4, {58, 60, 64}, 8);
  return Finish(canvas);
}

TexturePtr HouseDoor(Color tint, const char* number) {
  Canvas canvas(160, 320, tint);
  for (const double y : {30.0, 190.0}) {
    Block(canvas, 22, y, 116, y < 100 ? 130 : 100, Lighter(tint, -24.0));
    Block(canvas, 28, y + 6, 104, y < 100 ? 118 : 88, Lighter(tint, 10.0));
  }
  Block(canvas, 50, 52, 60, 74, {84, 98, 110});
  canvas.Line({{80, 52}, {80, 126}}, Lighter(tint, 10.0), 4);
  Block(canvas, 56, 168, 50, 12, {196, 176, 110});
  canvas.Disc({142, 176}, 6, {206, 190, 130});
  canvas.Text(number, {66, 24}, 15, Readable(tint));
  Block(canvas, 0, 306, 160, 14, {120, 116, 110});
  Outline(canvas, 2, Lighter(tint, -40.0), 4);
  return Finish(canvas);
}

TexturePtr GarageDoor(Color tint) {
  Canvas canvas(320, 288, tint);
  for (int row = 0; row < 8; ++row) {
    Block(canvas, 0, 36 * row + 32, 320, 4, Lighter(tint, -46.0));
    Block(canvas, 0, 36 * row, 320, 3, Lighter(tint, 16.0));
  }
  Block(canvas, 142, 228, 36, 8, {70, 70, 72});
  Outline(canvas, 3, {206, 204, 196}, 6);
  return Finish(canvas);
}

TexturePtr ShopSign(std::uint64_t seed) {
  Random random(seed, "shop sign");
  const Color ground = SignInk(random);
  Canvas canvas(576, 96, ground);
  const std::string name = kShops[static_cast<std::size_t>(random.Integer(0, 13))];
  const double width = Canvas::TextWidth(name, 48);
  canvas.Text(name, {(576 - width) / 2, 72}, 48, Readable(ground));
  canvas.Disc({44, 48}, 26, Readable(ground));
  canvas.Disc({44, 48}, 17, SignInk(random));
  Outline(canvas, 5, Readable(ground), 3);
  return Finish(canvas);
}

TexturePtr ParkingSign(const char* line) {
  Canvas canvas(128, 192, {30, 76, 154});
  canvas.Text("P", {36, 104}, 78, {240, 240, 240});
  Block(canvas, 8, 128, 112, 56, {238, 238, 234});
  canvas.Text(line, {14, 164}, 20, {24, 24, 28});
  Outline(canvas, 4, {236, 236, 234}, 5);
  return Finish(canvas);
}

TexturePtr RoundSign(const char* text) {
  Canvas canvas(128, 128, {186, 36, 34});
  canvas.Disc({64, 64}, 46, {240, 240, 238});
  canvas.Text(text, {64 - Canvas::TextWidth(text, 38) / 2, 82}, 38, {22, 22, 24});
  return Finish(canvas);
}

TexturePtr ManholeCover() {
  Canvas canvas(160, 160, {84, 84, 84});
  canvas.Disc({80, 80}, 72, {66, 65, 64});
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 7; ++column) {
      Block(canvas, 24 + 16.5 * column, 24 + 16.5 * row, 11, 11, {98, 96, 92});
    }
  }
  return Finish(canvas);
}

}  // namespace trailcast::sim
