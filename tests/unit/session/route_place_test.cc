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

TEST(RoutePlace, IsInMetresOrInSecondsOfTeaching) {
  for (const bool odometry : {true, false}) {
    const RoutePlace place = PlaceOf({1.0, 2.0, 0.5}, odometry);
    EXPECT_EQ(place.metric(), odometry);
    EXPECT_EQ(place.belief().length(), 3.5);
    ASSERT_EQ(place.belief().views(), 6U);
    EXPECT_EQ(place.belief().view_at(3), 2.0);
    EXPECT_EQ(place.ExtentOf(SegmentIndex(1)), 2.0);
  }
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
