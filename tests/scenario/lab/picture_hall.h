#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>

#include "services/image/canvas.h"
#include "services/lab/sim/core/path.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::trial::test {

// This is a hall of 9 m x 9 m with pictures all round, no two alike.
inline std::shared_ptr<const sim::World> PictureHall() {
  constexpr float kHalf_m = 4.5F;
  sim::SceneBuilder builder;
  builder.Panel(builder.AddMaterial("floor", {110, 105, 100}), {-kHalf_m, kHalf_m, 0},
                {2 * kHalf_m, 0, 0}, {0, -2 * kHalf_m, 0});
  std::mt19937 random(5);
  const auto upTo = [&](double most) {
    return most * static_cast<double>(random()) / 4294967296.0;
  };
  for (int side = 0; side < 4; ++side) {
    builder.Place({0, 0, 0}, static_cast<float>(side) * 1.5707963F);
    for (float y = kHalf_m; y > -kHalf_m; y -= 1.5F) {
      image::Canvas picture(192, 256, {200, 195, 190});
      for (int patch = 0; patch < 25; ++patch) {
        const image::PixelPoint corner{upTo(170.0), upTo(200.0)};
        const auto grey = static_cast<std::uint8_t>(40.0 + upTo(190.0));
        picture.FillBox(corner, {corner.x + 8.0 + upTo(40.0), corner.y + 8.0 + upTo(50.0)},
                        {grey, grey, grey});
      }
      const auto material = builder.AddMaterial("picture", {255, 255, 255},
                                                std::make_shared<sim::Texture>(picture.picture()));
      builder.Panel(material, {kHalf_m, y, 2}, {0, -1.5F, 0}, {0, 0, -2});
    }
  }
  auto world = sim::World::Build(builder.Take("hall"));
  EXPECT_TRUE(world);
  return world ? *world : nullptr;
}

// This leads once round it, with four bends, back to the start.
inline sim::Polyline RoundTheHall() {
  return {{0.0, -1.5}, {1.2, -1.5}, {1.5, -1.2},  {1.5, 1.2},   {1.2, 1.5},
          {-1.2, 1.5}, {-1.5, 1.2}, {-1.5, -1.2}, {-1.2, -1.5}, {0.0, -1.5}};
}

}  // namespace trailcast::trial::test
