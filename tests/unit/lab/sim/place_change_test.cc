#include "services/lab/sim/places/place_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/lab/sim/core/camera_renderer.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/places/place_options.h"

namespace trailcast::sim {
namespace {

// From where the scout sets out.
std::vector<float> LookInto(const Place& place) {
  const CameraModel camera = *FindCamera("webcam");
  CameraRenderer renderer(place.world, camera);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector2d at = place.path.points.front();
  pose.translation() = Eigen::Vector3d(at.x(), at.y(), camera.height_m);
  pose.rotate(BodyFromCamera(0.0, 0.0));
  return renderer.Render(pose).gray;
}

// Returns the share of pixels that differ by more than a few grey levels.
double Changed(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) changed += std::abs(a[i] - b[i]) > 8.0F ? 1 : 0;
  return static_cast<double>(changed) / static_cast<double>(a.size());
}

TEST(PlaceChange, NoneIsThePlaceItselfAndEachKindShows) {
  PlaceOptions as_it_is;
  as_it_is.world = "indoor";
  const auto now = OpenPlace(as_it_is);
  ASSERT_TRUE(now);
  const std::vector<float> view = LookInto(*now);
  const auto after = [&](const PlaceChange& change) {
    const auto place = OpenChangedPlace("indoor", change);
    EXPECT_TRUE(place) << place.error().message;
    return Changed(view, LookInto(*place));
  };
  EXPECT_EQ(after({}), 0.0);
  EXPECT_GT(after({.night = 1.0}), 0.5);
  const double third = after({.textures = 1.0 / 3.0});
  EXPECT_GT(third, 0.02);
  EXPECT_GT(after({.textures = 1.0}), third);
  EXPECT_GT(after({.moved = 1.0 / 3.0}), 0.02);
}

TEST(PlaceChange, OfAThirdOfTheFurnitureNoneIsMovedIntoTheWay) {
  const auto place = OpenChangedPlace("indoor", {.moved = 1.0 / 3.0});
  ASSERT_TRUE(place);
  const PathFollowDriver driver(place->path.points);
  for (const Eigen::Vector2d& at : driver.path()) {
    for (const float height_m : {0.06F, 0.2F, 0.5F}) {
      for (int i = 0; i < 36; ++i) {
        const auto angle = static_cast<float>(i) * 0.17453F;
        ASSERT_FALSE(place->world->CastRay(
            {static_cast<float>(at.x()), static_cast<float>(at.y()), height_m},
            {std::cos(angle), std::sin(angle), 0.0F}, 0.35))
            << "at " << at.transpose() << " height " << height_m;
      }
    }
  }
}

TEST(PlaceChange, ALargerShareOfTexturesChangesWhatASmallerOneDoes) {
  Scene scene;
  for (int i = 0; i < 60; ++i) {
    image::RgbImage picture{1, 1, {static_cast<std::uint8_t>(i), 0, 0}};
    scene.materials.push_back({"", {}, std::make_shared<Texture>(picture)});
  }
  scene.materials.push_back({"plain", {}, nullptr});
  Scene some = scene;
  Scene more = scene;
  ChangeTextures(0.2, 7, some);
  ChangeTextures(0.5, 7, more);
  int changed = 0;
  int changed_more = 0;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const bool other = some.materials[i].texture != scene.materials[i].texture;
    if (other) {
      EXPECT_EQ(more.materials[i].texture, some.materials[i].texture);
    }
    changed += other ? 1 : 0;
    changed_more += more.materials[i].texture != scene.materials[i].texture ? 1 : 0;
  }
  EXPECT_NEAR(changed, 12, 7);
  EXPECT_NEAR(changed_more, 30, 10);
}

TEST(PlaceChange, APlaceThatKnowsNoneIsNamedWithThatWhichDoes) {
  const auto place = OpenChangedPlace("ramp", {});
  ASSERT_FALSE(place);
  EXPECT_NE(place.error().message.find("ramp"), std::string::npos);
  EXPECT_NE(place.error().message.find("indoor"), std::string::npos);
}

}  // namespace
}  // namespace trailcast::sim
