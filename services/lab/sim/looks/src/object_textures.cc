#include <array>
#include <cmath>
#include <string>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/looks/src/pattern.h"

namespace trailcast::sim {
namespace {

using image::Canvas;
using image::Color;

constexpr std::array<const char*, 24> kWords = {
    "VISION", "ROBOT",   "FUNNEL", "CAMERA",  "LASER",  "MOTION", "DATA",  "OPTICS",
    "FIELD",  "SIGNALS", "MAPS",   "LAB",     "SYSTEM", "THEORY", "GRAPH", "CONTROL",
    "ATLAS",  "LINEAR",  "SPACE",  "PHYSICS", "RADIO",  "MODELS", "NOTES", "SURVEY"};
constexpr std::array<Color, 10> kInks = {{{190, 40, 40},
                                          {30, 70, 150},
                                          {40, 120, 60},
                                          {220, 160, 30},
                                          {90, 50, 120},
                                          {30, 30, 35},
                                          {20, 130, 150},
                                          {200, 100, 40},
                                          {235, 232, 222},
                                          {120, 90, 60}}};

const char* Word(Random& random) { return kWords[static_cast<std::size_t>(random.Integer(0, 23))]; }
Color Ink(Random& random) { return kInks[static_cast<std::size_t>(random.Integer(0, 9))]; }
Color Contrast(Color paper) {
  const int brightness = 3 * paper[0] + 6 * paper[1] + paper[2];
  return brightness > 1300 ? Color{25, 25, 30} : Color{240, 240, 235};
}

// Draws lines of text too small to read: dashes with the lengths of words.
void SmallPrint(Canvas& canvas, Random& random, double x, double y, double width, int lines,
                double line_px, Color color) {
  for (int line = 0; line < lines; ++line, y += line_px) {
    double at = x;
    const double end = x + width * (line + 1 == lines ? random.Uniform(0.3, 0.8) : 1.0);
    while (at < end) {
      const double length = random.Uniform(1.5, 6.0) * line_px * 0.5;
      canvas.Line({{at, y}, {std::min(end, at + length), y}}, color, 0.45 * line_px);
      at += length + 0.5 * line_px;
    }
  }
}

void Curve(Canvas& canvas, Random& random, double x, double y, double width, double height,
           Color color) {
  std::vector<image::PixelPoint> points;
  points.reserve(61);
  const double waves = random.Uniform(1.0, 3.0);
  const double phase = random.Uniform(0.0, 6.0);
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 60.0;
    points.push_back({x + t * width, y + height * (0.5 + 0.42 * std::sin(6.28 * waves * t + phase) *
                                                             (1.0 - 0.6 * t))});
  }
  canvas.Line(points, color, 2.0);
}

void Chart(Canvas& canvas, Random& random, double x, double y, double width, double height) {
  Block(canvas, x, y, width, height, {250, 250, 248});
  canvas.Line({{x + 6, y + 4}, {x + 6, y + height - 6}, {x + width - 4, y + height - 6}},
              {40, 40, 40}, 2.0);
  if (random.Uniform() < 0.5) {
    Curve(canvas, random, x + 8, y + 6, width - 14, height - 14, Ink(random));
    Curve(canvas, random, x + 8, y + 6, width - 14, height - 14, Ink(random));
    return;
  }
  const int bars = random.Integer(4, 8);
  const double step = (width - 16) / bars;
  for (int i = 0; i < bars; ++i) {
    const double tall = random.Uniform(0.2, 0.9) * (height - 14);
    Block(canvas, x + 10 + i * step, y + height - 7 - tall, 0.7 * step, tall, Ink(random));
  }
}

void Shapes(Canvas& canvas, Random& random, double x, double y, double width, double height) {
  for (int i = 0; i < 7; ++i) {
    const double cx = x + random.Uniform(0.15, 0.85) * width;
    const double cy = y + random.Uniform(0.15, 0.85) * height;
    const double size = random.Uniform(0.06, 0.16) * std::min(width, height);
    if (random.Uniform() < 0.5) {
      canvas.Disc({cx, cy}, size, Ink(random));
    } else {
      canvas.FillPolygon({{cx - size, cy + size}, {cx + size, cy + 0.6 * size}, {cx, cy - size}},
                         Ink(random));
    }
  }
}

}  // namespace

TexturePtr Poster(std::uint64_t seed) {
  Random random(seed, "poster");
  const Color paper = random.Uniform() < 0.6 ? Color{244, 242, 234} : Ink(random);
  const Color ink = Contrast(paper);
  Canvas canvas(420, 594, paper);
  Block(canvas, 0, 0, 420, 86, Ink(random));
  canvas.Text(Word(random), {24, 64}, 42, {250, 250, 250});
  const bool picture_first = random.Uniform() < 0.5;
  const double picture_y = picture_first ? 110 : 330;
  const double text_y = picture_first ? 380 : 120;
  if (random.Uniform() < 0.5) {
    Chart(canvas, random, 24, picture_y, 372, 220);
  } else {
    Block(canvas, 24, picture_y, 372, 220, Ink(random));
    Shapes(canvas, random, 24, picture_y, 372, 220);
  }
  SmallPrint(canvas, random, 24, text_y, 172, 12, 14, ink);
  SmallPrint(canvas, random, 222, text_y, 172, 9, 14, ink);
  canvas.Text(Word(random), {24, 580}, 14, ink);
  canvas.Line({{2, 2}, {418, 2}, {418, 592}, {2, 592}, {2, 2}}, {60, 60, 60}, 3);
  return Finish(canvas);
}

TexturePtr Screen(std::uint64_t seed) {
  Random random(seed, "screen");
  const bool dark = random.Uniform() < 0.5;
  Canvas canvas(480, 270, dark ? Color{30, 60, 90} : Color{70, 120, 150});
  Block(canvas, 0, 256, 480, 14, {28, 28, 32});
  for (int window = 0; window < 2; ++window) {
    const double x = window == 0 ? random.Uniform(8, 40) : random.Uniform(200, 250);
    const double y = random.Uniform(8, 40);
    const Color paper = dark ? Color{38, 40, 48} : Color{246, 246, 246};
    Block(canvas, x, y, 215, 205, paper);
    Block(canvas, x, y, 215, 14, {90, 95, 110});
    if (random.Uniform() < 0.4) {
      Chart(canvas, random, x + 10, y + 24, 195, 90);
      SmallPrint(canvas, random, x + 10, y + 130, 190, 8, 9, Contrast(paper));
    } else {
      for (int line = 0; line < 18; ++line) {
        const double indent = 8.0 * random.Integer(0, 4);
        SmallPrint(canvas, random, x + 10 + indent, y + 26 + 10 * line, random.Uniform(30, 150), 1,
                   8, line % 3 == 0 ? Ink(random) : Contrast(paper));
      }
    }
  }
  return Finish(canvas);
}

TexturePtr Keyboard() {
  Canvas canvas(300, 100, {45, 45, 48});
  for (int row = 0; row < 5; ++row) {
    for (int key = 0; key < 15; ++key) {
      if (row == 4 && key > 3 && key < 9) continue;
      Block(canvas, 8 + 19 * key + 3 * (row % 3), 8 + 18 * row, 15, 14, {78, 78, 82});
    }
  }
  Block(canvas, 8 + 19 * 4, 80, 95, 14, {78, 78, 82});
  return Finish(canvas);
}

TexturePtr BookSpines(std::uint64_t seed) {
  Random random(seed, "spines");
  constexpr int kSpine_px = 48;
  Canvas canvas(kSpines * kSpine_px, 320, {90, 80, 70});
  for (int i = 0; i < kSpines; ++i) {
    const double x = i * kSpine_px;
    const Color cloth = Ink(random);
    Block(canvas, x, 0, kSpine_px, 320, cloth);
    Canvas title(200, kSpine_px, cloth);
    title.Text(Word(random), {8, 34}, random.Uniform(15, 24), Contrast(cloth));
    // The title runs down the spine, so its picture is turned by a quarter.
    image::RgbImage turned{kSpine_px, 200, std::vector<std::uint8_t>(std::size_t{600} * kSpine_px)};
    for (int row = 0; row < kSpine_px; ++row) {
      for (int column = 0; column < 200; ++column) {
        const auto from = 3 * image::PixelIndex(column, row, 200);
        const auto to = 3 * image::PixelIndex(kSpine_px - 1 - row, column, kSpine_px);
        for (std::size_t c = 0; c < 3; ++c)
          turned.pixels[to + c] = title.picture().pixels[from + c];
      }
    }
    canvas.Paste(turned, static_cast<int>(x), 30, kSpine_px, 200);
    if (random.Uniform() < 0.6) Block(canvas, x, 250, kSpine_px, 8, Contrast(cloth));
    if (random.Uniform() < 0.4) Block(canvas, x, 14, kSpine_px, 5, Contrast(cloth));
    if (random.Uniform() < 0.3) canvas.Disc({x + 24, 290}, 12, Contrast(cloth));
    canvas.Line({{x, 0}, {x, 320}}, {20, 20, 20}, 2);
  }
  return Finish(canvas);
}

TexturePtr Binders(std::uint64_t seed) {
  Random random(seed, "binders");
  Canvas canvas(kSpines * 48, 320, {60, 60, 60});
  const Color cover = Ink(random);
  for (int i = 0; i < kSpines; ++i) {
    const double x = i * 48;
    Block(canvas, x, 0, 48, 320, random.Uniform() < 0.75 ? cover : Ink(random));
    Block(canvas, x + 7, 40, 34, 130, {245, 245, 240});
    SmallPrint(canvas, random, x + 10, 55, 28, random.Integer(2, 6), 12, {40, 40, 60});
    canvas.Disc({x + 24, 265}, 13, {25, 25, 25});
    canvas.Line({{x, 0}, {x, 320}}, {20, 20, 20}, 2);
  }
  return Finish(canvas);
}

TexturePtr Carton(std::uint64_t seed) {
  Random random(seed, "carton");
  Canvas canvas(256, 192, {178, 140, 98});
  Block(canvas, 0, 86, 256, 16, {196, 172, 130});
  const double x = random.Uniform(14, 110);
  Block(canvas, x, 112, 120, 64, {242, 242, 238});
  canvas.Text(Word(random), {x + 6, 134}, 13, {30, 30, 30});
  SmallPrint(canvas, random, x + 6, 148, 100, 3, 9, {50, 50, 50});
  canvas.Text(Word(random), {16, 66}, 26, {110, 70, 40});
  return Finish(canvas);
}

TexturePtr Whiteboard(std::uint64_t seed) {
  Random random(seed, "whiteboard");
  Canvas canvas(720, 400, {236, 238, 240});
  canvas.Text("u' = f x / z", {40, 70}, 30, {30, 60, 150});
  canvas.Text("|uC| < |uD|", {420, 90}, 30, {170, 40, 40});
  Curve(canvas, random, 60, 130, 280, 180, {40, 110, 60});
  canvas.Line({{60, 320}, {350, 320}}, {40, 40, 40}, 3);
  canvas.Line({{60, 120}, {60, 320}}, {40, 40, 40}, 3);
  for (int i = 0; i < 3; ++i) {
    const double x = 430 + 90 * i;
    canvas.Line({{x, 180}, {x + 60, 180}, {x + 60, 230}, {x, 230}, {x, 180}}, {30, 60, 150}, 3);
    canvas.Line({{x + 60, 205}, {x + 90, 205}}, {30, 60, 150}, 3);
  }
  canvas.Text("todo:", {430, 290}, 20, {170, 40, 40});
  for (int i = 0; i < 3; ++i) canvas.Text(Word(random), {450, 320.0 + 28 * i}, 16, {40, 40, 40});
  canvas.Line({{4, 4}, {716, 4}, {716, 396}, {4, 396}, {4, 4}}, {120, 122, 126}, 10);
  return Finish(canvas);
}

TexturePtr PrintedPage(std::uint64_t seed) {
  Random random(seed, "page");
  Canvas canvas(210, 297, {248, 248, 246});
  canvas.Text(Word(random), {20, 34}, 14, {30, 30, 30});
  SmallPrint(canvas, random, 20, 54, 170, 10, 9, {60, 60, 60});
  Chart(canvas, random, 30, 155, 150, 70);
  SmallPrint(canvas, random, 20, 242, 170, 5, 9, {60, 60, 60});
  return Finish(canvas);
}

}  // namespace trailcast::sim
