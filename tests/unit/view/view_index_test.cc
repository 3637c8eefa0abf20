#include "services/view/view_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"
#include "tests/support/seen_segment.h"

namespace trailcast::view {
namespace {

using test::KeyNumber;
using test::SegmentToSee;
using test::ViewOf;
using testing::ElementsAre;
using testing::IsEmpty;

ViewIndex::Place PlaceOf(unsigned route, std::uint32_t segment) {
  return {KeyNumber(route), SegmentIndex(segment)};
}

// Routes 1 to `routes` of ten segments each, every segment of another number.
void AddRoutes(ViewIndex& index, unsigned routes) {
  for (unsigned route = 1; route <= routes; ++route) {
    for (unsigned segment = 0; segment < 10; ++segment) {
      ASSERT_TRUE(index.Add(KeyNumber(route), SegmentToSee(10 * route + segment, segment)));
    }
  }
}

TEST(ViewIndex, FindsEachSegmentFirstAmongHundreds) {
  ViewIndex index;
  AddRoutes(index, 60);
  EXPECT_EQ(index.size(), 600U);
  EXPECT_EQ(index.routes(), 60U);
  for (const auto& [route, segment] : {std::pair(1U, 0U), {30U, 7U}, {60U, 9U}}) {
    const auto found = index.Candidates(ViewOf(SegmentToSee(10 * route + segment, segment)), 5);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front(), PlaceOf(route, segment));
  }
}

TEST(ViewIndex, FindsTheOnlySegment) {
  ViewIndex index;
  ASSERT_TRUE(index.Add(KeyNumber(1), SegmentToSee(1, 4)));
  EXPECT_THAT(index.Candidates(ViewOf(SegmentToSee(1, 4)), 5), ElementsAre(PlaceOf(1, 4)));
}

TEST(ViewIndex, GivesNoMoreThanAskedForAndNothingForAnEmptyView) {
  ViewIndex index;
  for (unsigned i = 0; i < 5; ++i) ASSERT_TRUE(index.Add(KeyNumber(1), SegmentToSee(1, i)));
  EXPECT_EQ(index.Candidates(ViewOf(SegmentToSee(1, 0)), 3).size(), 3U);
  EXPECT_THAT(index.Candidates({}, 3), IsEmpty());
}

TEST(ViewIndex, TellsWhichSegmentsLieAroundOne) {
  ViewIndex index;
  for (const std::uint32_t segment : {0U, 1U, 4U, 5U, 9U}) {
    ASSERT_TRUE(index.Add(KeyNumber(1), SegmentToSee(segment, segment)));
  }
  ASSERT_TRUE(index.Add(KeyNumber(2), SegmentToSee(4, 4)));
  EXPECT_THAT(index.Around(PlaceOf(1, 4), 1), ElementsAre(PlaceOf(1, 1), PlaceOf(1, 5)));
  EXPECT_THAT(index.Around(PlaceOf(1, 0), 2), ElementsAre(PlaceOf(1, 1), PlaceOf(1, 4)));
  EXPECT_EQ(index.Around(PlaceOf(1, 9), 8).size(), 4U);
  EXPECT_THAT(index.Around(PlaceOf(2, 4), 8), IsEmpty());
  EXPECT_THAT(index.Around(PlaceOf(3, 0), 8), IsEmpty());
}

TEST(ViewIndex, AFeatureNearThePicturesEdgeIsDescribedByNothingAndLikeNothing) {
  ViewIndex index;
  route::Segment segment = SegmentToSee(1, 0);
  for (route::Feature& feature : segment.features) feature.descriptor = {};
  ASSERT_TRUE(index.Add(KeyNumber(1), segment));
  EXPECT_THAT(index.Candidates(ViewOf(segment, {.flipped_bits = 0}), 5), IsEmpty());
}

TEST(ViewIndex, ARemovedRouteIsNotFoundAndTheOthersAre) {
  ViewIndex index;
  AddRoutes(index, 3);
  index.Remove(KeyNumber(2));
  index.Remove(KeyNumber(9));
  EXPECT_EQ(index.size(), 20U);
  EXPECT_FALSE(index.Holds(PlaceOf(2, 5)));
  for (const auto& place : index.Candidates(ViewOf(SegmentToSee(25, 5)), 20)) {
    EXPECT_NE(place.key, KeyNumber(2));
  }
  EXPECT_EQ(index.Candidates(ViewOf(SegmentToSee(35, 5)), 1), std::vector{PlaceOf(3, 5)});
}

TEST(ViewIndex, IsFullAtItsBoundAndHasRoomAgainAfterARemoval) {
  ViewIndex index({.most_segments = 20});
  AddRoutes(index, 2);
  EXPECT_TRUE(index.full());
  EXPECT_FALSE(index.Add(KeyNumber(3), SegmentToSee(30, 0)));
  EXPECT_EQ(index.size(), 20U);
  index.Remove(KeyNumber(1));
  ASSERT_TRUE(index.Add(KeyNumber(3), SegmentToSee(30, 0)));
  EXPECT_TRUE(index.Holds(PlaceOf(3, 0)));
  EXPECT_FALSE(index.Holds(PlaceOf(3, 1)));
  EXPECT_EQ(index.Candidates(ViewOf(SegmentToSee(30, 0)), 1), std::vector{PlaceOf(3, 0)});
}

TEST(ViewIndex, ASegmentThatIsHeldTakesNoMoreRoom) {
  ViewIndex index({.most_segments = 2});
  for (int times = 0; times < 3; ++times) {
    ASSERT_TRUE(index.Add(KeyNumber(1), SegmentToSee(10, 7)));
    ASSERT_TRUE(index.Add(KeyNumber(1), SegmentToSee(10, 2)));
  }
  EXPECT_EQ(index.size(), 2U);
  EXPECT_TRUE(index.Holds(PlaceOf(1, 2)));
  EXPECT_TRUE(index.Holds(PlaceOf(1, 7)));
  EXPECT_FALSE(index.Holds(PlaceOf(1, 5)));
}

TEST(ViewIndex, IsFullAtItsBytesAndHasRoomAgainAfterARemoval) {
  ViewIndex empty;
  ViewIndex index({.most_bytes = empty.bytes() + 50'000});
  unsigned segments = 0;
  for (; !index.full(); ++segments) {
    ASSERT_LT(segments, 1000U);
    ASSERT_TRUE(index.Add(KeyNumber(1 + segments % 2), SegmentToSee(segments, segments)));
  }
  EXPECT_FALSE(index.Add(KeyNumber(3), SegmentToSee(2000, 0)));
  EXPECT_LT(index.bytes(), empty.bytes() + 60'000);
  index.Remove(KeyNumber(1));
  EXPECT_FALSE(index.full());
  EXPECT_TRUE(index.Add(KeyNumber(3), SegmentToSee(2000, 0)));
}

TEST(ViewIndex, AFewRoutesThatComeAndGoTakeNoMoreMemory) {
  ViewIndex index;
  const auto come_and_go = [&](unsigned from, unsigned until) {
    for (unsigned route = from; route < until; ++route) {
      for (unsigned segment = 0; segment < 4; ++segment) {
        ASSERT_TRUE(index.Add(KeyNumber(route), SegmentToSee(10 * route + segment, segment)));
      }
      if (route > 1) index.Remove(KeyNumber(route - 1));
    }
  };
  come_and_go(1, 30);
  const std::size_t bytes = index.bytes();
  come_and_go(30, 300);
  EXPECT_LE(index.bytes(), bytes + bytes / 50);
}

TEST(ViewIndex, RoutesThatComeAndGoTakeNoMoreMemory) {
  ViewIndex index({.most_segments = 30});
  AddRoutes(index, 3);
  const std::size_t bytes = index.bytes();
  for (unsigned round = 0; round < 20; ++round) {
    for (unsigned route = 1; route <= 3; ++route) index.Remove(KeyNumber(route));
    AddRoutes(index, 3);
  }
  EXPECT_EQ(index.bytes(), bytes);
  EXPECT_EQ(index.Candidates(ViewOf(SegmentToSee(25, 5)), 1), std::vector{PlaceOf(2, 5)});
}

}  // namespace
}  // namespace trailcast::view
