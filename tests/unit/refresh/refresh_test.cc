#include "services/refresh/refresh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "services/refresh/successor.h"
#include "services/route/codec.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::refresh {
namespace {

using route::Feature;
using route::Segment;
using testing::HasSubstr;

constexpr int kFeatures = 20;

std::vector<Segment> SampleRoute(int segments = 2) {
  std::vector<Segment> route;
  for (int i = 0; i < segments; ++i) {
    route.push_back(route::SampleSegmentWithKeyViews(static_cast<std::uint32_t>(i), kFeatures));
  }
  return route;
}

Feature NewFeature(int number) {
  Feature feature = route::SampleSegment(99, number + 1).features.back();
  feature.descriptor = {};
  return feature;
}

// Returns a visit of `route` that finds all its features, and offers these in each segment.
Visit VisitOf(const std::vector<Segment>& route, int offered = 0) {
  Visit visit;
  for (const Segment& segment : route) {
    SegmentVisit& each = visit.segments.emplace_back();
    each.index = segment.index;
    each.features.assign(segment.features.size(), Sought::kFound);
    for (int i = 0; i < offered; ++i) each.offered.push_back(NewFeature(i));
  }
  return visit;
}

std::size_t BytesOf(const std::vector<Segment>& route) {
  std::size_t bytes = 0;
  for (const Segment& segment : route) bytes += route::Encode(segment).size();
  return bytes;
}

RefreshOptions WithRoom() {
  RefreshOptions options;
  options.most_bytes_per_m = 1e6;
  return options;
}

TEST(Refresh, AVisitThatFindsAllAndOffersNothingLeavesTheRouteAsItIs) {
  const std::vector<Segment> route = SampleRoute();
  const auto refreshed = Refresh(route, VisitOf(route), WithRoom());
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->segments, route);
  EXPECT_EQ(refreshed->counts, (RefreshCounts{2 * kFeatures, 0, 0, 0, 0}));
}

TEST(Refresh, NewFeaturesComeUpToAShareOfASegmentsAndAllElseStays) {
  const std::vector<Segment> route = SampleRoute();
  const auto refreshed = Refresh(route, VisitOf(route, 30), WithRoom());
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->counts.added, 2 * 5) << "a quarter of 20, in each of two";
  for (std::size_t i = 0; i < route.size(); ++i) {
    Segment rest = refreshed->segments[i];
    ASSERT_EQ(rest.features.size(), 25U);
    rest.features.resize(kFeatures);
    EXPECT_EQ(rest, route[i]);
    EXPECT_EQ(refreshed->segments[i].features[kFeatures], NewFeature(0));
  }
}

TEST(Refresh, AFeatureGoesAfterThreeVisitsInARowThatMissedIt) {
  std::vector<Segment> route = SampleRoute(1);
  const Feature gone = route[0].features[7];
  Visit visit = VisitOf(route);
  visit.segments[0].features[7] = Sought::kMissed;
  for (int missed = 1; missed <= 2; ++missed) {
    auto refreshed = Refresh(route, visit, WithRoom());
    ASSERT_TRUE(refreshed);
    route = refreshed->segments;
    EXPECT_EQ(route[0].features[7].missed, missed);
    EXPECT_EQ(refreshed->counts.dropped, 0);
  }
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->counts.dropped, 1);
  ASSERT_EQ(refreshed->segments[0].features.size(), kFeatures - 1U);
  for (const Feature& left : refreshed->segments[0].features) EXPECT_NE(left.patch, gone.patch);
}

TEST(Refresh, OneThatIsFoundAgainBeginsAnewAndOneUnjudgedStaysAsItWas) {
  std::vector<Segment> route = SampleRoute(1);
  route[0].features[3].missed = 2;
  route[0].features[4].missed = 2;
  Visit visit = VisitOf(route);
  visit.segments[0].features[4] = Sought::kUnjudged;
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->segments[0].features[3].missed, 0);
  EXPECT_EQ(refreshed->segments[0].features[4].missed, 2);
}

TEST(Refresh, ASegmentWhoseFeaturesNobodyJudgedStaysAsItWas) {
  std::vector<Segment> route = SampleRoute(3);
  for (Segment& segment : route) segment.features[3].missed = 9;
  Visit visit = VisitOf(route);
  visit.segments[1].features.clear();  // only its key views were looked at
  visit.segments[1].views.assign(route[1].key_views.size(), Sought::kFound);
  visit.segments.pop_back();  // nor was it sure of its place there
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->segments[1], route[1]);
  EXPECT_EQ(refreshed->segments[2], route[2]);
}

TEST(Refresh, OneVisitTakesAwayNoMoreThanAShareAndAFewAreAlwaysLeft) {
  std::vector<Segment> route = SampleRoute(2);
  for (Feature& feature : route[0].features) feature.missed = 200;
  Visit visit = VisitOf(route);
  visit.segments[0].features.assign(kFeatures, Sought::kUnjudged);
  for (int i = 0; i < 10; ++i) {
    const std::size_t before = route[0].features.size();
    auto refreshed = Refresh(route, visit, WithRoom());
    ASSERT_TRUE(refreshed) << refreshed.error().message;
    route = refreshed->segments;
    EXPECT_GE(route[0].features.size() + std::ceil(0.25 * static_cast<double>(before)), before);
    visit.segments[0].features.assign(route[0].features.size(), Sought::kUnjudged);
  }
  EXPECT_EQ(route[0].features.size(), RefreshOptions{}.fewest_left);
}

TEST(Refresh, ARouteGrowsNoLargerThanItsBudgetAndALargerOneNoLargerThanItIs) {
  std::vector<Segment> route = SampleRoute(2);
  const double length_m = route[0].length_m + route[1].length_m;
  const double is = static_cast<double>(BytesOf(route)) / length_m;
  RefreshOptions options;
  options.most_bytes_per_m = is + 100.0;  // three features a segment
  auto refreshed = Refresh(route, VisitOf(route, 10), options);
  ASSERT_TRUE(refreshed);
  EXPECT_GT(refreshed->counts.added, 0);
  EXPECT_LE(static_cast<double>(BytesOf(refreshed->segments)), options.most_bytes_per_m * length_m);

  options.most_bytes_per_m = 0.5 * is;
  route[0].features[0].missed = 3;
  Visit visit = VisitOf(route, 10);
  visit.segments[0].features[0] = Sought::kMissed;
  refreshed = Refresh(route, visit, options);
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->counts.dropped, 1);
  EXPECT_EQ(refreshed->counts.added, 1) << "in the other's place";
  EXPECT_LE(BytesOf(refreshed->segments), BytesOf(route));
}

TEST(Refresh, AVisitThatFoundLittleIsNotBelieved) {
  const std::vector<Segment> route = SampleRoute(1);
  Visit visit = VisitOf(route, 3);
  visit.segments[0].features.assign(kFeatures, Sought::kMissed);
  visit.segments[0].features[0] = Sought::kFound;
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_FALSE(refreshed);
  EXPECT_EQ(refreshed.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(refreshed.error().message, HasSubstr("5 % were found"));
}

TEST(Refresh, NorOneThatCouldJudgeLittle) {
  const std::vector<Segment> route = SampleRoute(1);
  Visit visit = VisitOf(route);
  visit.segments[0].features.assign(kFeatures, Sought::kUnjudged);
  visit.segments[0].features[0] = Sought::kFound;
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_FALSE(refreshed);
  EXPECT_THAT(refreshed.error().message, HasSubstr("1 of 20 features could be judged"));
  EXPECT_FALSE(Refresh(route, Visit{}, WithRoom()));
}

TEST(Refresh, AVisitOfAnotherRouteIsAnError) {
  const std::vector<Segment> route = SampleRoute(2);
  Visit visit = VisitOf(route);
  visit.segments[1].features.pop_back();
  EXPECT_EQ(Refresh(route, visit).error().code, ErrorCode::kInvalidArgument);
  visit = VisitOf(SampleRoute(3));
  EXPECT_EQ(Refresh(route, visit).error().code, ErrorCode::kInvalidArgument);
  visit = VisitOf(route);
  std::swap(visit.segments[0], visit.segments[1]);
  EXPECT_EQ(Refresh(route, visit).error().code, ErrorCode::kInvalidArgument);
}

TEST(Refresh, WhatNoScoutCouldHaveTaughtIsNotTaken) {
  const std::vector<Segment> route = SampleRoute(1);
  Visit visit = VisitOf(route);
  std::vector<Feature>& offered = visit.segments[0].offered;
  for (int i = 0; i < 4; ++i) offered.push_back(NewFeature(i));
  offered[0].track.clear();
  offered[1].track[1].u_px = std::nanf("");
  offered[2].track[1].s = 0.0F;
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->counts.added, 1);
  EXPECT_EQ(refreshed->segments[0].features.back(), NewFeature(3));
}

// Returns a visit of a route of one segment that recognises all key views, and offers views in
// place of its first and third.
Visit VisitByViews(const std::vector<Segment>& route) {
  Visit visit;
  SegmentVisit& each = visit.segments.emplace_back();
  each.index = route[0].index;
  each.views.assign(route[0].key_views.size(), Sought::kFound);
  each.offered_views = {{0, route[0].key_views[3].features}, {2, route[0].key_views[2].features}};
  return visit;
}

std::vector<route::KeyView> Own(const Segment& segment) {
  std::vector<route::KeyView> own = segment.key_views;
  std::erase_if(own, [](const route::KeyView& view) { return view.missed.has_value(); });
  return own;
}

TEST(RefreshViews, HowAPlaceLooksNowComesBesideTheScoutsViewAndAllElseStays) {
  const std::vector<Segment> route = SampleRoute(1);
  const auto refreshed = Refresh(route, VisitByViews(route), WithRoom());
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->views, (RefreshCounts{4, 0, 0, 0, 2}));
  const std::vector<route::KeyView>& views = refreshed->segments[0].key_views;
  ASSERT_EQ(views.size(), 6U);
  EXPECT_EQ(views[1], (route::KeyView{0.0, route[0].key_views[3].features, std::uint8_t{0}}));
  EXPECT_EQ(views[4], (route::KeyView{route[0].key_views[2].s, route[0].key_views[2].features,
                                      std::uint8_t{0}}));
  EXPECT_EQ(Own(refreshed->segments[0]), route[0].key_views);
  EXPECT_EQ(refreshed->segments[0].features, route[0].features);
  EXPECT_TRUE(IsRefreshed(refreshed->segments[0], route[0]));
  EXPECT_TRUE(IsRefreshed(route[0], refreshed->segments[0]));
  const auto decoded = route::Decode(route::Encode(refreshed->segments[0]));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, refreshed->segments[0]);
}

TEST(RefreshViews, OneMoreIsAllThatAPlaceGets) {
  std::vector<Segment> route = SampleRoute(1);
  route = Refresh(route, VisitByViews(route), WithRoom())->segments;
  Visit visit = VisitByViews(route);
  visit.segments[0].offered_views = {{0, route[0].key_views[2].features},
                                     {5, route[0].key_views[2].features}};
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->views.added, 1) << "beside the last";
  Segment two_beside = route[0];
  two_beside.key_views.insert(two_beside.key_views.begin() + 1, two_beside.key_views[1]);
  EXPECT_FALSE(IsRefreshed(two_beside, route[0]));
  Segment others = route[0];
  others.key_views[0].features.pop_back();
  EXPECT_FALSE(IsRefreshed(others, route[0])) << "the scout's own is another";
}

TEST(RefreshViews, OneThatAFollowerAddedGoesAfterThreeVisitsInARowAndTheScoutsNever) {
  std::vector<Segment> route = SampleRoute(1);
  const std::vector<route::KeyView> own = route[0].key_views;
  route = Refresh(route, VisitByViews(route), WithRoom())->segments;
  Visit visit = VisitByViews(route);
  visit.segments[0].offered_views.clear();
  visit.segments[0].views[0] = visit.segments[0].views[1] = Sought::kMissed;
  for (int missed = 1; missed <= 2; ++missed) {
    route = Refresh(route, visit, WithRoom())->segments;
    ASSERT_EQ(route[0].key_views.size(), 6U);
    EXPECT_EQ(route[0].key_views[1].missed, missed);
  }
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->views.dropped, 1);
  EXPECT_EQ(refreshed->segments[0].key_views.size(), 5U);
  EXPECT_EQ(Own(refreshed->segments[0]), own);
}

TEST(RefreshViews, ARouteWithOdometryKeepsItsBudget) {
  const std::vector<Segment> route = SampleRoute(1);
  const double is = static_cast<double>(BytesOf(route));
  const auto with_all = Refresh(route, VisitByViews(route), WithRoom());
  ASSERT_TRUE(with_all);
  ASSERT_GT(with_all->views.added, 1);
  const double view =
      (static_cast<double>(BytesOf(with_all->segments)) - is) / with_all->views.added;
  RefreshOptions options;
  options.most_bytes_per_m = (is + 1.5 * view) / route[0].length_m;
  const auto refreshed = Refresh(route, VisitByViews(route), options);
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->views.added, 1);
  EXPECT_LE(static_cast<double>(BytesOf(refreshed->segments)), is + 1.5 * view);
}

TEST(RefreshViews, AVisitThatRecognisedLittleIsNotBelievedAndWhatItSaysOfFeaturesIs) {
  const std::vector<Segment> route = SampleRoute(1);
  Visit visit = VisitByViews(route);
  visit.segments[0].views.assign(4, Sought::kMissed);
  visit.segments[0].views[0] = Sought::kFound;
  const auto alone = Refresh(route, visit, WithRoom());
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(alone.error().message, HasSubstr("of the key views that should have been seen 25 %"));
  visit.segments[0].features.assign(kFeatures, Sought::kFound);
  visit.segments[0].offered = {NewFeature(0)};
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->counts.added, 1);
  EXPECT_EQ(refreshed->segments[0].key_views, route[0].key_views);
  visit.segments[0].views.pop_back();
  EXPECT_EQ(Refresh(route, visit).error().code, ErrorCode::kInvalidArgument);
}

TEST(RefreshViews, WhatIsNoViewIsNotTaken) {
  const std::vector<Segment> route = SampleRoute(1);
  Visit visit = VisitByViews(route);
  visit.segments[0].offered_views[0].features[3].v_px = std::nanf("");
  visit.segments[0].offered_views[1].features.clear();
  const auto refreshed = Refresh(route, visit, WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_EQ(refreshed->segments, route);
}

TEST(Successor, IsTheSameRouteWithAFewFeaturesGoneAndAFewNew) {
  const std::vector<Segment> route = SampleRoute();
  const auto refreshed = Refresh(route, VisitOf(route, 30), WithRoom());
  ASSERT_TRUE(refreshed);
  EXPECT_TRUE(IsRefreshed(refreshed->segments[0], route[0]));
  EXPECT_TRUE(IsRefreshed(route[0], route[0]));
  Segment missed = route[0];
  missed.features[3].missed = 2;
  EXPECT_TRUE(IsRefreshed(missed, route[0])) << "no longer found, and there yet";
  Segment fewer = route[0];
  fewer.features.erase(fewer.features.begin() + 4, fewer.features.begin() + 9);
  EXPECT_TRUE(IsRefreshed(fewer, route[0])) << "a quarter of 20";
  fewer.features.pop_back();
  EXPECT_FALSE(IsRefreshed(fewer, route[0]));
}

TEST(Successor, IsNotOneWhosePathIsAnotherOrWhoseFeaturesWereMoved) {
  const Segment before = SampleRoute().front();
  Segment longer = before;
  longer.length_m += 0.001;
  EXPECT_FALSE(IsRefreshed(longer, before));
  Segment turned = before;
  turned.heading.c[0] += 0.001;
  EXPECT_FALSE(IsRefreshed(turned, before));
  Segment seen_elsewhere = before;
  seen_elsewhere.key_views.front().features.front().u_px += 1.0F;
  EXPECT_FALSE(IsRefreshed(seen_elsewhere, before));
  Segment moved = before;
  for (Feature& feature : moved.features) feature.track.back().u_px += 1.0F;
  EXPECT_FALSE(IsRefreshed(moved, before));
}

TEST(Successor, SaysWhichRevisionItRefreshes) {
  EXPECT_EQ(
      DescribeRefreshed(RevisionNumber(12), AgentId("robot2"), Refreshed{{}, {8, 2, 0, 1, 3}, {}}),
      "revision 12 refreshed by robot2: 3 features new, 1 gone; 8 of 10 were found");
  EXPECT_EQ(Describe(Refreshed{{}, {8, 2, 0, 1, 3}, {7, 1, 0, 0, 2}}),
            "3 features new, 1 gone; 8 of 10 were found; 2 views new, 0 gone; 7 of 8 were found");
  EXPECT_EQ(Describe(Refreshed{{}, {}, {7, 1, 0, 0, 2}}), "2 views new, 0 gone; 7 of 8 were found");
}

}  // namespace
}  // namespace trailcast::refresh
