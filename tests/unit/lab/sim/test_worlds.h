#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "services/image/canvas.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::sim::test {

// These are small worlds that are easy to reason about: a grey floor of 20 m x 20 m at z = 0 and
// what a test puts on it. There is no sun, only ambient light that is the same from everywhere, so
// that grey levels are those of the materials.
class SmallWorld {
 public:
  SmallWorld() {
    floor_ = builder_.AddMaterial("floor", {100, 100, 100});
    white_ = builder_.AddMaterial("white", {250, 250, 250});
    builder_.Panel(floor_, {-10, 10, 0}, {20, 0, 0}, {0, -20, 0});
  }
  SmallWorld& WhiteBox(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    builder_.Box(white_, low, high);
    return *this;
  }
  // Adds a picture that stands across the x axis at `x`, as seen from the origin, with its lower
  // edge on the floor.
  SmallWorld& Picture(const image::RgbImage& picture, float x, float width, float height) {
    const auto material =
        builder_.AddMaterial("picture", {255, 255, 255}, std::make_shared<Texture>(picture));
    builder_.Panel(material, {x, width / 2, height}, {0, -width, 0}, {0, 0, -height});
    return *this;
  }
  // Adds a slope that rises by `rise` a metre ahead, over x from 1 to 8.
  SmallWorld& Slope(float rise) {
    builder_.Panel(floor_, {8, 5, 7 * rise}, {0, -10, 0}, {-7, 0, -7 * rise});
    return *this;
  }
  SmallWorld& Sun(const Eigen::Vector3f& toward) {
    toward_sun_ = toward.normalized();
    sun_ = 0.7F;
    return *this;
  }
  SmallWorld& Ground(GroundMode mode) {
    ground_ = mode;
    return *this;
  }
  std::shared_ptr<const World> Build() {
    Scene scene = builder_.Take("small");
    scene.ground = ground_;
    scene.lighting.sun = sun_;
    scene.lighting.toward_sun = toward_sun_;
    scene.lighting.ambient = 1.0F - sun_;
    scene.lighting.ambient_by_direction = false;
    auto world = World::Build(std::move(scene));
    EXPECT_TRUE(world);
    return world ? *world : nullptr;
  }

 private:
  SceneBuilder builder_;
  MaterialId floor_, white_;
  float sun_ = 0.0F;
  Eigen::Vector3f toward_sun_ = Eigen::Vector3f::UnitZ();
  GroundMode ground_ = GroundMode::kMesh;
};

}  // namespace trailcast::sim::test
