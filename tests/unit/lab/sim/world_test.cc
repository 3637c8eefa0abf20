#include "services/lab/sim/core/world.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

using test::SmallWorld;

TEST(World, GroundIsTheHighestSurfaceBelowTheGivenHeight) {
  const auto world = SmallWorld().WhiteBox({2, -1, 0}, {3, 1, 0.4F}).Build();
  EXPECT_NEAR(*world->GroundHeight(0.0, 0.0, 1.0), 0.0, 1e-4);
  EXPECT_NEAR(*world->GroundHeight(2.5, 0.0, 1.0), 0.4, 1e-4);
  EXPECT_NEAR(*world->GroundHeight(2.5, 0.0, 0.2), 0.0, 1e-4);
  EXPECT_FALSE(world->GroundHeight(15.0, 0.0, 1.0));
}

TEST(World, FlatGroundIsAtZeroWhateverIsThere) {
  const auto world =
      SmallWorld().WhiteBox({2, -1, 0}, {3, 1, 0.4F}).Ground(GroundMode::kFlat).Build();
  EXPECT_EQ(*world->GroundHeight(2.5, 0.0, 1.0), 0.0);
  EXPECT_EQ(*world->FloorHeight(99.0, 0.0), 0.0);
}

TEST(World, FloorIsUnderTheRoofAndAboveTheGapBelow) {
  // A thin slab 10 cm above the earth, and a roof.
  const auto world = SmallWorld()
                         .WhiteBox({-3, -3, 0.1F}, {3, 3, 0.15F})
                         .WhiteBox({-3, -3, 2.5F}, {3, 3, 2.7F})
                         .Build();
  EXPECT_NEAR(*world->FloorHeight(0.0, 0.0), 0.15, 1e-4);
  EXPECT_FALSE(world->FloorHeight(50.0, 0.0));
}

TEST(World, RayStopsAtItsDistance) {
  const auto world = SmallWorld().WhiteBox({2, -1, 0}, {3, 1, 1}).Build();
  const auto hit = world->CastRay({0, 0, 0.5F}, Eigen::Vector3f::UnitX(), 5.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 2.0, 1e-4);
  EXPECT_NEAR(std::abs(hit->normal.x()), 1.0F, 1e-5F);
  EXPECT_FALSE(world->CastRay({0, 0, 0.5F}, Eigen::Vector3f::UnitX(), 1.5));
}

TEST(World, WithoutTrianglesIsRefused) {
  const auto world = World::Build(Scene{});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::kInvalidArgument);
}

TEST(World, TrianglesWithoutAreaOrWithNumbersThatAreNoneAreLeftOut) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {kNan, 0, 0}};
  mesh.uvs = {{kNan, 0}, {1, 0}, {0, 0}, {0, 1}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 4}, {0, 1, 3}};
  scene.meshes.push_back(mesh);
  const auto world = World::Build(scene);
  ASSERT_TRUE(world);
  ASSERT_EQ((*world)->surfaces().size(), 1U);
  EXPECT_TRUE((*world)->surfaces()[0].uv.allFinite());
}

}  // namespace
}  // namespace trailcast::sim
