#include "agent/session/src/place/likeliest_place.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast::agent {
namespace {

// All of whose features that should be in view are `in_view`.
PlaceByFeatures Place(double along, int agreeing, int in_view, double unlikely = 0.0) {
  return {along, 0.0, agreeing, static_cast<double>(agreeing) / in_view, 1.0, agreeing - unlikely};
}

void ExpectPlaces(const std::vector<PlaceByFeatures>& compared, double best, double first,
                  double last) {
  const auto likeliest = LikeliestOf(compared);
  ASSERT_TRUE(likeliest);
  EXPECT_DOUBLE_EQ(likeliest->best.along, best);
  EXPECT_DOUBLE_EQ(likeliest->first, first);
  EXPECT_DOUBLE_EQ(likeliest->last, last);
}

TEST(LikeliestPlaceTest, IsNoneOfNone) { EXPECT_FALSE(LikeliestOf({})); }

TEST(LikeliestPlaceTest, IsWhereMostAgree) {
  ExpectPlaces({Place(40.0, 27, 43), Place(45.0, 41, 42), Place(50.0, 30, 49)}, 45.0, 45.0, 45.0);
}

TEST(LikeliestPlaceTest, ACameraThatItCanHardlyHaveCountsAgainstAPlace) {
  ExpectPlaces({Place(116.0, 38, 40), Place(149.0, 39, 49, 11.0)}, 116.0, 116.0, 116.0);
}

TEST(LikeliestPlaceTest, WhereFeaturesDoAboutAsWellItMayBeThere) {
  ExpectPlaces({Place(225.0, 31, 32), Place(228.0, 20, 30), Place(230.0, 29, 42)}, 225.0, 225.0,
               230.0);
}

// Two places look the same, and the segment of one has fewer features.
TEST(LikeliestPlaceTest, WhereAsLargeAShareOfFewerFeaturesAgreesItMayBeThere) {
  ExpectPlaces({Place(9.0, 61, 61), Place(3.0, 50, 52)}, 9.0, 3.0, 9.0);
  ExpectPlaces({Place(9.0, 61, 61), Place(3.0, 40, 40)}, 9.0, 9.0, 9.0);
}

// Far features tell a place along to metres only: how many of them agree makes it no surer.
TEST(LikeliestPlaceTest, ItIsKnownNoBetterThanItsFeaturesTellIt) {
  PlaceByFeatures distant = Place(210.0, 27, 30);
  distant.along_sigma = 2.0;
  PlaceByFeatures near = Place(213.0, 26, 30);
  near.along_sigma = 0.5;
  ExpectPlaces({distant}, 210.0, 208.0, 212.0);
  ExpectPlaces({distant, near}, 210.0, 208.0, 213.5);
}

constexpr RouteExtent kTwentyMetres{20.0, true};

TEST(BeginningTest, IsWhereEnoughAgree) {
  const std::vector<PlaceByFeatures> compared = {Place(4.0, 12, 20), Place(9.0, 30, 32)};
  const Beginning beginning = BeginningBy(compared, 10, kTwentyMetres);
  ASSERT_TRUE(beginning.place);
  EXPECT_EQ(beginning.place->best.along, 9.0);
  EXPECT_EQ(beginning.nowhere, "");
  const Beginning too_few = BeginningBy(compared, 31, kTwentyMetres);
  EXPECT_FALSE(too_few.place);
  EXPECT_EQ(too_few.nowhere, "") << "more may be seen in the next frame";
}

TEST(BeginningTest, IsNowhereAmongPlacesThatLookAlike) {
  const std::vector<PlaceByFeatures> compared = {Place(4.0, 30, 32), Place(9.0, 30, 32)};
  const Beginning beginning = BeginningBy(compared, 10, kTwentyMetres);
  EXPECT_FALSE(beginning.place);
  EXPECT_EQ(beginning.nowhere,
            "from 4.0 m to 9.0 m along the route it looks alike: begin where more is near, or at "
            "the beginning");
  const Beginning without_metres = BeginningBy(compared, 10, {20.0, false});
  EXPECT_EQ(without_metres.nowhere.substr(0, 41), "from 20 % of the route to 45 % of the rou");
  EXPECT_TRUE(
      BeginningBy(std::vector{Place(4.0, 30, 32), Place(7.0, 30, 32)}, 10, kTwentyMetres).place)
      << "that is one place";
}

TEST(BeginningTest, MayBeALittleOutsideTheRoute) {
  const auto from = [](double along) {
    return BeginningBy(std::vector{Place(along, 30, 32)}, 10, kTwentyMetres);
  };
  EXPECT_TRUE(from(-0.9).place);
  EXPECT_TRUE(from(20.9).place);
  EXPECT_EQ(from(-1.1).nowhere,
            "what it sees is of the route, from 1.1 m before its beginning: put it on the route");
  EXPECT_EQ(from(21.5).nowhere,
            "what it sees is of the route, from 1.5 m beyond its end: put it on the route");
  EXPECT_FALSE(from(21.5).place);
}

}  // namespace
}  // namespace trailcast::agent
