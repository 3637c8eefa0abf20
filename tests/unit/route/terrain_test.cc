#include "services/route/terrain.h"

#include <gtest/gtest.h>

#include "services/route/terrain_profile.h"

namespace trailcast::route {
namespace {

TEST(Terrain, IsAsRoughAsItsAccelerationWhereThatIsKnown) {
  EXPECT_EQ(RoughnessOf({.vertical_mps2 = 0.1}), Roughness::kSmooth);
  EXPECT_EQ(RoughnessOf({.vertical_mps2 = 0.5}), Roughness::kUneven);
  EXPECT_EQ(RoughnessOf({.vertical_mps2 = 1.0}), Roughness::kRough);
  EXPECT_EQ(RoughnessOf({.vertical_mps2 = 5.0}), Roughness::kVeryRough);
  EXPECT_EQ(RoughnessOf({.shake = 0.5, .vertical_mps2 = 0.1}), Roughness::kSmooth);
}

TEST(Terrain, IsAsRoughAsThePictureShakesWithoutAnImu) {
  EXPECT_EQ(RoughnessOf({.shake = 0.001}), Roughness::kSmooth);
  EXPECT_EQ(RoughnessOf({.shake = 0.5}), Roughness::kVeryRough);
}

TEST(Terrain, OfWhichNothingOrTheSlopeAloneIsKnownHasNoRoughness) {
  EXPECT_EQ(RoughnessOf({}), std::nullopt);
  EXPECT_EQ(RoughnessOf({.slope_rad = 0.1}), std::nullopt);
}

TEST(Terrain, RoughnessIsFoundByItsName) {
  for (const RoughnessClass& each : RoughnessClasses()) {
    EXPECT_EQ(FindRoughness(NameOf(each.roughness)), each.roughness);
  }
  EXPECT_EQ(FindRoughness("bumpy"), std::nullopt);
}

Segment Felt(std::uint32_t index, const Terrain& terrain) {
  Segment segment;
  segment.index = SegmentIndex(index);
  segment.has_odometry = true;
  segment.length_m = 2.0;
  segment.duration_s = 5.0;
  segment.terrain = terrain;
  return segment;
}

TEST(TerrainProfile, PutsTogetherWhatIsAsRoughAndMuchAsSteep) {
  TerrainProfile profile;
  profile.Add(Felt(0, {0.001, 0.1, 0.00}));
  profile.Add(Felt(1, {0.002, 0.2, 0.02}));
  profile.Add(Felt(2, {0.002, 0.2, 0.08}));
  profile.Add(Felt(3, {0.002, 1.2, 0.08}));
  profile.Add(Felt(4, {0.001, 1.0, 0.07}));
  profile.Add(Felt(5, {}));
  const auto& sections = profile.sections();
  ASSERT_EQ(sections.size(), 4U);
  EXPECT_EQ(sections[0].end, 4.0);
  EXPECT_EQ(sections[0].terrain.vertical_mps2, 0.2) << "the roughest";
  EXPECT_NEAR(sections[0].terrain.slope_rad.value(), 0.01, 1e-9) << "the mean";
  EXPECT_EQ(sections[2].begin, 6.0);
  EXPECT_EQ(sections[2].end, 10.0);
  EXPECT_EQ(sections[2].first, SegmentIndex(3));
  EXPECT_EQ(TerrainText(sections[2].terrain), "rough (1.20 m/s2), 4.3 degrees uphill");
  EXPECT_EQ(TerrainText(sections[3].terrain), "not known");
}

TEST(TerrainProfile, OfARouteWithoutOdometryIsInSeconds) {
  TerrainProfile profile;
  Segment segment = Felt(0, {0.001, {}, {}});
  segment.has_odometry = false;
  segment.length_m = 0.0;
  profile.Add(segment);
  EXPECT_EQ(profile.sections().front().end, 5.0);
}

}  // namespace
}  // namespace trailcast::route
