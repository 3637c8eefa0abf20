#include "agent/hand_over.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

// Ten segments; the third has next to no features.
std::vector<route::Segment> Route() {
  std::vector<route::Segment> segments(10);
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    segments[i].index = SegmentIndex(i);
    segments[i].features.resize(i == 2 ? 1 : 20);
  }
  return segments;
}

TEST(WhereItMayBe, IsHereAndTheNextTwo) {
  const auto route = Route();
  for (const bool odometry : {true, false}) {
    const auto ahead = WhereItMayBe(route, SegmentIndex(1), odometry, 60);
    ASSERT_EQ(ahead.size(), 3U);
    EXPECT_EQ(ahead.front().index, SegmentIndex(1));
  }
}

TEST(WhereItMayBe, EndsWithTheRoute) {
  EXPECT_EQ(WhereItMayBe(Route(), SegmentIndex(9), true, 0).size(), 1U);
  EXPECT_EQ(WhereItMayBe(Route(), SegmentIndex(2), false, 1000).size(), 8U);
}

TEST(WhereItMayBe, GrowsOnAStretchWithoutFeaturesThatNoOdometryMeasures) {
  const auto route = Route();
  EXPECT_EQ(WhereItMayBe(route, SegmentIndex(2), false, 0).size(), 3U);
  EXPECT_EQ(WhereItMayBe(route, SegmentIndex(2), false, 20).size(), 7U);
  EXPECT_EQ(WhereItMayBe(route, SegmentIndex(2), true, 20).size(), 3U);
}

}  // namespace
}  // namespace trailcast::agent
