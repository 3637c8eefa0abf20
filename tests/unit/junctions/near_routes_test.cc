#include "services/junctions/near_routes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/view/key_views.h"
#include "tests/support/seen_segment.h"

namespace trailcast::junctions {
namespace {

using testing::IsEmpty;

route::RouteKey Key(char id) { return {RouteId(std::string(32, id)), TeachingId(1)}; }

// Segments that look like nothing else but what was taught with the same numbers.
std::vector<route::Segment> Route(unsigned from, unsigned to) {
  std::vector<route::Segment> segments;
  for (unsigned number = from; number < to; ++number) {
    segments.push_back(test::SegmentToSee(number, number - from));
  }
  return segments;
}

view::ViewIndex IndexOf(const std::vector<std::pair<char, std::vector<route::Segment>>>& routes) {
  view::ViewIndex index;
  for (const auto& [id, segments] : routes) {
    for (const route::Segment& segment : segments) EXPECT_TRUE(index.Add(Key(id), segment));
  }
  return index;
}

TEST(NearRoutes, AreThoseWithSegmentsThatAreAlikeInOrder) {
  auto index = IndexOf({{'a', Route(0, 20)}, {'b', Route(100, 120)}});
  // The likest alone: a view has a few features in common with any segment.
  const auto near = NearRoutes(index, RouteId("new"), Route(8, 12), {.most_alike = 1});
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].key, Key('a'));
  EXPECT_EQ(near[0].first.value(), 5U) << "the eighth, and a margin of three";
  EXPECT_EQ(near[0].last.value(), 14U);
  EXPECT_EQ(near[0].views, 12U) << "three of each segment";
}

TEST(NearRoutes, AreNotTheRouteItself) {
  auto index = IndexOf({{'a', Route(0, 20)}});
  EXPECT_THAT(NearRoutes(index, Key('a').route, Route(0, 20)), IsEmpty());
}

TEST(NearRoutes, PutTheOneFirstThatIsAlikeForLonger) {
  auto index = IndexOf({{'a', Route(0, 3)}, {'b', Route(0, 12)}});
  const auto near = NearRoutes(index, RouteId("new"), Route(0, 12));
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].key, Key('b'));
  EXPECT_EQ(near[1].first.value(), 0U);
}

TEST(NearRoutes, AreTwoSectionsOfOneThatIsMetInAnotherOrder) {
  auto index = IndexOf({{'a', Route(0, 40)}});
  auto route = Route(30, 36);
  for (const route::Segment& segment : Route(5, 9)) route.push_back(segment);
  const auto near = NearRoutes(index, RouteId("new"), route, {.most_alike = 1});
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].first.value(), 27U);
  EXPECT_EQ(near[0].last.value(), 38U);
  EXPECT_EQ(near[1].first.value(), 2U);
  EXPECT_EQ(near[1].last.value(), 11U);
}

TEST(NearRoutes, OfTheLastViewsAreThoseThatTheRouteIsAtNow) {
  auto index = IndexOf({{'a', Route(0, 6)}, {'b', Route(100, 106)}});
  NearRouteSearch search(RouteId("new"), {.most_alike = 1});
  const auto look = [&](const std::vector<route::Segment>& segments) {
    for (const route::Segment& segment : segments) {
      for (const auto& view : view::KeyViewsOf(segment)) search.Look(index, view.features);
    }
  };
  look(Route(0, 6));
  look(Route(100, 104));
  EXPECT_EQ(search.Found().size(), 2U);
  search.KeepLast(3);
  ASSERT_EQ(search.Found().size(), 1U);
  EXPECT_EQ(search.Found()[0].key, Key('b'));
  EXPECT_EQ(search.Found()[0].first.value(), 0U);
}

TEST(NearRoutes, AreNoneOfAnEmptyIndexNorForAnEmptyRoute) {
  view::ViewIndex empty;
  EXPECT_THAT(NearRoutes(empty, RouteId("new"), Route(0, 3)), IsEmpty());
  auto index = IndexOf({{'a', Route(0, 3)}});
  EXPECT_THAT(NearRoutes(index, RouteId("new"), {}), IsEmpty());
}

}  // namespace
}  // namespace trailcast::junctions
