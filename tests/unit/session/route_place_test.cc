#include "agent/session/src/place/route_place.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast::agent {
namespace {

RoutePlace PlaceOf(const std::vector<double>& lengths, bool odometry) {
  RoutePlace place;
  for (std::uint32_t i = 0; i < lengths.size(); ++i) {
    route::Segment segment;
    segment.index = SegmentIndex(i);
    segment.has_odometry = odometry;
    segment.length_m = odometry ? lengths[i] : 0.0;
    segment.duration_s = odometry ? 77.0 : lengths[i];
    const std::vector<route::KeyView> views{{0.0, {}}, {0.5, {}}};
    place.Learn(segment, views, std::vector<std::optional<double>>(views.size()));
  }
  return place;
}

TEST(RoutePlace, IsInMetres) {
  const RoutePlace place = PlaceOf({1.0, 2.0, 0.5}, true);
  EXPECT_TRUE(place.metric());
  EXPECT_EQ(place.belief().length(), 3.5);
  ASSERT_EQ(place.belief().views(), 6U);
  EXPECT_EQ(place.belief().view_at(3), 2.0);
  EXPECT_EQ(place.ExtentOf(SegmentIndex(1)), 2.0);
  EXPECT_EQ(place.PaceAt(0.5), 1.0 / 77.0);
}

// Whatever the frames' rate was said to be, and however slowly the scout drove: what changed in the
// picture is the measure.
TEST(RoutePlace, IsAsLongAsWhatChangesInThePictureWithoutOdometry) {
  const RoutePlace place = PlaceOf({1.0, 1.0, 1.0, 1.0}, false);
  const RoutePlace slower = PlaceOf({7.0, 7.0, 7.0, 7.0}, false);
  EXPECT_FALSE(place.metric());
  EXPECT_NEAR(place.belief().length(), 2.0, 1e-9);  // eight views
  EXPECT_NEAR(slower.belief().length(), 2.0, 1e-9);
  EXPECT_NEAR(place.PaceAt(1.9), 0.5, 1e-9);
  EXPECT_NEAR(slower.PaceAt(1.9), 0.5 / 7.0, 1e-9);
}

TEST(RoutePlace, FollowsHowDenselyViewsComeSlowly) {
  const std::vector<double> lengths = {1.0, 1.0, 10.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  const RoutePlace place = PlaceOf(lengths, false);
  const double wait = place.ExtentOf(SegmentIndex(2));
  EXPECT_GT(wait, 3.0);  // nearly as long as it took, in the units so far
  EXPECT_LT(wait, 5.0);
  EXPECT_NEAR(place.ExtentOf(SegmentIndex(9)), 0.5, 0.1);
}

TEST(RoutePlace, PointsAndPlacesAreTheSame) {
  const RoutePlace place = PlaceOf({1.0, 2.0, 0.5}, true);
  for (const auto& [along, segment, fraction] : {std::tuple{0.0, 0U, 0.0},
                                                 {0.25, 0U, 0.25},
                                                 {1.0, 1U, 0.0},
                                                 {2.5, 1U, 0.75},
                                                 {3.25, 2U, 0.5},
                                                 {3.5, 2U, 1.0}}) {
    const RoutePoint point = place.PointAt(along);
    EXPECT_EQ(point.segment, SegmentIndex(segment)) << along;
    EXPECT_NEAR(point.fraction, fraction, 1e-9) << along;
    EXPECT_NEAR(place.AlongOf(point), along, 1e-9);
  }
  EXPECT_EQ(place.PointAt(99.0).segment, SegmentIndex(2));
  EXPECT_EQ(place.PointAt(-1.0).segment, SegmentIndex(0));
}

}  // namespace
}  // namespace trailcast::agent
