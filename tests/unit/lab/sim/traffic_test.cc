#include "services/lab/sim/places/traffic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace trailcast::sim {
namespace {

Place Open(const char* name) {
  PlaceOptions options;
  options.world = name;
  return *OpenPlace(options);
}

const Place& Road() {
  static const Place road = Open("road");
  return road;
}

// A robot that drives along the middle of the path at the place's speed: how near an actor comes,
// and where along the path that is.
struct Nearby {
  double distance_m = std::numeric_limits<double>::infinity();
  double along_m = 0.0;
};
Nearby NearestTo(const Place& place, const Actor& actor) {
  Nearby nearest;
  const double length_m = Length(place.path.points);
  for (double along_m = 0.0; along_m < length_m; along_m += 0.05) {
    const auto state = actor.timetable->At(along_m / place.speed_mps);
    if (!state) continue;
    const double distance_m =
        (motion::Position(state->pose) - PointAlong(place.path.points, along_m)).norm();
    if (distance_m < nearest.distance_m) nearest = {distance_m, along_m};
  }
  return nearest;
}

TEST(RoadTraffic, APedestrianAndThenAVanPassTheFollowerClosely) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto actors = TrafficFor(Road(), Role::kFollower, seed);
    ASSERT_TRUE(actors);
    ASSERT_EQ(actors->size(), 2U);
    const Nearby pedestrian = NearestTo(Road(), (*actors)[0]);
    const Nearby van = NearestTo(Road(), (*actors)[1]);
    EXPECT_GT(pedestrian.distance_m, 0.7);  // without touching
    EXPECT_LT(pedestrian.distance_m, 2.0);
    EXPECT_GT(van.distance_m, 1.6);
    EXPECT_LT(van.distance_m, 3.0);
    EXPECT_GT(pedestrian.along_m, 15.0);
    EXPECT_GT(van.along_m, pedestrian.along_m + 5.0);
  }
}

TEST(RoadTraffic, NobodyComesNearWhileTheScoutTeaches) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto actors = TrafficFor(Road(), Role::kScout, seed);
    ASSERT_TRUE(actors);
    for (const Actor& actor : *actors) EXPECT_GT(NearestTo(Road(), actor).distance_m, 5.0);
  }
}

TEST(RoadTraffic, SameSeedSameTrafficOtherSeedOther) {
  const auto at = [](std::uint64_t seed) {
    const auto actors = *TrafficFor(Road(), Role::kFollower, seed);
    return actors[0].timetable->until_s();
  };
  EXPECT_EQ(at(5), at(5));
  EXPECT_NE(at(5), at(6));
}

TEST(PavementTraffic, PeopleWalkInSightAndOutOfTheWayOthersEachTime) {
  const Place lot = Open("paved");
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto taught = TrafficFor(lot, Role::kScout, seed);
    const auto followed = TrafficFor(lot, Role::kFollower, seed);
    ASSERT_TRUE(taught && followed);
    EXPECT_FALSE(taught->empty());
    ASSERT_FALSE(followed->empty());
    EXPECT_NE(followed->front().timetable->until_s(), taught->front().timetable->until_s());
    for (const Actor& actor : *followed) {
      const Nearby nearest = NearestTo(lot, actor);
      EXPECT_GT(nearest.distance_m, 5.0);
      EXPECT_LT(nearest.distance_m, 40.0);
    }
  }
}

TEST(SomebodyInTheWay, StandsOnTheMiddleOfThePath) {
  const auto somebody = SomebodyInTheWay(Road(), 3, 0.8);
  ASSERT_TRUE(somebody);
  ASSERT_TRUE(somebody->encounter);
  const PlaceOnPath where = Nearest(Road().path.points, somebody->encounter->place);
  EXPECT_NEAR(where.distance_m, 0.0, 1e-6);
  EXPECT_GT(where.along_m, 20.0);
  EXPECT_LT(where.along_m, 60.0);
}

}  // namespace
}  // namespace trailcast::sim
