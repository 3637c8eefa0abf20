#include "services/lab/trial/spoiled_eyes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/random.h"

namespace trailcast::trial {
namespace {

constexpr int kSpots = 24;
constexpr double kLeastRadius = 0.04;  // of the picture's width
constexpr double kMostRadius = 0.09;
constexpr double kCovers = 0.9;  // share of the light, in a spot's middle
constexpr double kGrain_grey = 25.0;

void Mirror(image::GrayImage& picture) {
  for (int y = 0; y < picture.height; ++y) {
    const auto row = picture.pixels.begin() +
                     static_cast<std::ptrdiff_t>(y) * static_cast<std::ptrdiff_t>(picture.width);
    std::reverse(row, row + picture.width);
  }
}

void Dirty(std::uint64_t seed, image::GrayImage& picture) {
  sim::Random random(seed, "dirt");
  for (int spot = 0; spot < kSpots; ++spot) {
    const double x = random.Uniform(0.0, picture.width);
    const double y = random.Uniform(0.0, picture.height);
    const double radius = picture.width * random.Uniform(kLeastRadius, kMostRadius);
    const double grey = random.Uniform(20.0, 120.0);
    sim::Random grain(random.Bits(), "grain");
    const auto from = [&](double middle) { return std::max(0, static_cast<int>(middle - radius)); };
    const auto to = [&](double middle, int size) {
      return std::min(size, static_cast<int>(middle + radius) + 2);
    };
    for (int v = from(y); v < to(y, picture.height); ++v) {
      for (int u = from(x); u < to(x, picture.width); ++u) {
        const double distance = std::hypot(u - x, v - y);
        if (distance >= radius) continue;
        const double share = kCovers * std::min(1.0, 4.0 * (1.0 - distance / radius));
        auto& pixel = picture.pixels[image::PixelIndex(u, v, picture.width)];
        const double dirt = grey + kGrain_grey * grain.Normal();
        pixel =
            static_cast<std::uint8_t>(std::clamp((1.0 - share) * pixel + share * dirt, 0.0, 255.0));
      }
    }
  }
}

}  // namespace

const std::vector<std::string>& SpoiledNames() {
  static const std::vector<std::string> names = {"mirror", "dirt", "aside"};
  return names;
}

Result<Spoiled> FindSpoiled(const std::string& name) {
  if (name.empty()) return Spoiled::kNothing;
  if (name == "mirror") return Spoiled::kMirror;
  if (name == "dirt") return Spoiled::kDirt;
  if (name == "aside") return Spoiled::kAside;
  return Fail(ErrorCode::kNotFound, "nothing is spoiled by '{}'; there are: {}", name,
              fmt::join(SpoiledNames(), ", "));
}

void Spoil(Spoiled what, std::uint64_t seed, image::GrayImage& picture) {
  if (picture.empty()) return;
  if (what == Spoiled::kMirror) Mirror(picture);
  if (what == Spoiled::kDirt) Dirty(seed, picture);
}

}  // namespace trailcast::trial
