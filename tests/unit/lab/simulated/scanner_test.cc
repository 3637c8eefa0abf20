#include "services/lab/simulated/scanner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

// A wall 3 m ahead.
std::shared_ptr<const sim::World> Wall() {
  sim::SceneBuilder builder;
  const auto grey = builder.AddMaterial("grey", {110, 105, 100});
  builder.Panel(grey, {3, 5, 2}, {0, -10, 0}, {0, 0, -2});
  return *sim::World::Build(builder.Take("wall"));
}

Eigen::Isometry3d Above(double x_m, double y_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.2);
  return pose;
}

// The range straight ahead, to the left, and behind.
void ExpectRanges(const motion::Scan& scan, float ahead_m, float left_m, float behind_m) {
  ASSERT_TRUE(motion::Plausible(scan));
  ASSERT_EQ(scan.ranges_m.size(), 360U);
  EXPECT_FLOAT_EQ(scan.ranges_m[180], ahead_m);
  EXPECT_FLOAT_EQ(scan.ranges_m[270], left_m);
  EXPECT_FLOAT_EQ(scan.ranges_m[0], behind_m);
}

constexpr float kNothing = std::numeric_limits<float>::infinity();

TEST(Scanner, SeesTheWorldAndWhatStandsInIt) {
  const auto world = Wall();
  ExpectRanges(LookAround(*world, sim::Stage(world, {}), Above(1.0, 0.0), {}), 2.0F, kNothing,
               kNothing);
  const Pillar ahead{{2.0, 0.0}, 0.25, {}};
  const Pillar left{{1.0, 1.5}, 0.5, {}};
  ExpectRanges(LookAround(*world, sim::Stage(world, {}), Above(1.0, 0.0), {ahead, left}), 0.75F,
               1.0F, kNothing);
  const Pillar behind_the_wall{{4.0, 0.0}, 0.25, {}};
  ExpectRanges(LookAround(*world, sim::Stage(world, {}), Above(1.0, 0.0), {behind_the_wall}), 2.0F,
               kNothing, kNothing);
}

TEST(Scanner, SeesWhoIsThere) {
  const auto world = Wall();
  sim::SceneBuilder builder;
  builder.Box(builder.AddMaterial("grey", {110, 105, 100}), {-0.25, -0.25, 0}, {0.25, 0.25, 1});
  auto shape = std::make_shared<sim::ActorShape>();
  shape->parts.push_back({*sim::World::Build(builder.Take("box"))});
  sim::Timetable stands(0.0, {2.25, 0.0, 0.0});
  stands.Stand(10.0);
  sim::Stage stage(world, {sim::Actor{shape, stands, std::nullopt}});
  stage.Advance(1.0, {1.0, 0.0, 0.0});
  ExpectRanges(LookAround(*world, stage, Above(1.0, 0.0), {}), 1.0F, kNothing, kNothing);
  EXPECT_FLOAT_EQ(LookAhead(*world, stage, Above(1.0, 0.0), {}).range_m, 1.0F);
}

TEST(Sonar, SeesTheNearestWithinItsCone) {
  const auto world = Wall();
  EXPECT_TRUE(motion::Plausible(LookAhead(*world, sim::Stage(world, {}), Above(1.0, 0.0), {})));
  EXPECT_FLOAT_EQ(LookAhead(*world, sim::Stage(world, {}), Above(1.0, 0.0), {}).range_m, 2.0F);
  const Pillar aside{{2.0, 0.3}, 0.1, {}};
  const float range_m = LookAhead(*world, sim::Stage(world, {}), Above(1.0, 0.0), {aside}).range_m;
  EXPECT_GT(range_m, 0.9F);
  EXPECT_LT(range_m, 1.05F);
  const Pillar outside{{2.0, 0.6}, 0.1, {}};
  EXPECT_FLOAT_EQ(LookAhead(*world, sim::Stage(world, {}), Above(1.0, 0.0), {outside}).range_m,
                  2.0F);
  EXPECT_EQ(LookAhead(*world, sim::Stage(world, {}), Above(-3.0, 0.0), {}).range_m, kNothing);
}

TEST(Pillar, IsAPlaceAWidthAndATime) {
  const auto pillar = ParsePillar("3,-1.5,0.2@1+10");
  ASSERT_TRUE(pillar) << pillar.error().message;
  EXPECT_EQ(pillar->at, Eigen::Vector2d(3.0, -1.5));
  EXPECT_EQ(pillar->radius_m, 0.2);
  EXPECT_FALSE(pillar->spell.contains(0.5));
  EXPECT_TRUE(pillar->spell.contains(10.5));
  EXPECT_FALSE(pillar->spell.contains(11.5));
  EXPECT_TRUE(ParsePillar("3,1,0.2@0")->spell.contains(1e9));
}

TEST(Pillar, OneThatIsNotUnderstoodSaysWhatIsExpected) {
  for (const char* text : {"", "3,1,0.2", "3,1@2", "3@1,1,2", "x,1,0.2@0", "3,1,0@0", "3,1,-1@0",
                           "nan,1,0.2@0", "3,1,0.2@", "3,1,0.2@1+x", "3,1,0.2,4@1"}) {
    const auto pillar = ParsePillar(text);
    ASSERT_FALSE(pillar) << text;
    EXPECT_THAT(pillar.error().message, HasSubstr("as 3,1.5,0.2@0+10"));
  }
}

}  // namespace
}  // namespace trailcast::agent
