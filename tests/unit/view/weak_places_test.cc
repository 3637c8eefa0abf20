#include "services/view/weak_places.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace trailcast::view {
namespace {

constexpr int kScoutWidth_px = 320;

// So many features as no other view has; from `shared` on those of another.
route::View ViewOf(unsigned seed, int features, const route::View& shared = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-0.4F * kScoutWidth_px, 0.4F * kScoutWidth_px);
  route::View view = shared;
  while (static_cast<int>(view.size()) < features) {
    route::ViewFeature feature{{}, place(random), 0.5F * place(random), 31.0F};
    for (auto& byte : feature.descriptor) byte = static_cast<std::uint8_t>(random());
    view.push_back(feature);
  }
  return view;
}

// A segment of ten metres, or seconds, with a view at its beginning and one in its middle.
route::Segment SegmentOf(route::View first, route::View second, bool odometry = false) {
  route::Segment segment;
  segment.has_odometry = odometry;
  segment.length_m = odometry ? 10.0 : 0.0;
  segment.duration_s = 10.0;
  segment.features.resize(20);
  segment.key_views = {{0.0, std::move(first)}, {0.5, std::move(second)}};
  return segment;
}

std::vector<WeakPlace> WeakPlacesOf(const std::vector<route::Segment>& segments) {
  WeakPlaceFinder finder(kScoutWidth_px);
  for (const route::Segment& segment : segments) finder.Add(segment);
  return finder.Places();
}

TEST(WeakPlaces, ARouteWhoseViewsHaveMuchInCommonHasNone) {
  const route::View view = ViewOf(1, 40);
  EXPECT_TRUE(WeakPlacesOf({SegmentOf(view, view), SegmentOf(view, view)}).empty());
}

TEST(WeakPlaces, ViewsThatHaveNothingInCommonAreToldWithTheWayBetweenThem) {
  const route::View view = ViewOf(1, 40);
  const route::View other = ViewOf(2, 40);
  const auto places = WeakPlacesOf({SegmentOf(view, view), SegmentOf(other, other)});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].why, Weakness::kUnrelated);
  EXPECT_EQ(places[0].begin, 5.0);
  EXPECT_EQ(places[0].end, 10.0);
  EXPECT_LT(places[0].features, 6);
}

TEST(WeakPlaces, OdometryBridgesViewsWithLittleInCommon) {
  const route::View view = ViewOf(1, 40);
  const route::View next = ViewOf(2, 40, {view.begin(), view.begin() + 4});
  EXPECT_EQ(WeakPlacesOf({SegmentOf(view, next)}).size(), 1U);
  EXPECT_TRUE(WeakPlacesOf({SegmentOf(view, next, true)}).empty());
}

TEST(WeakPlaces, ABlandSectionReachesHalfwayToWhatCanBeRecognised) {
  const route::View view = ViewOf(1, 40);
  const route::View bland(view.begin(), view.begin() + 9);
  const auto places =
      WeakPlacesOf({SegmentOf(view, view), SegmentOf(bland, bland), SegmentOf(view, view)});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0], (WeakPlace{7.5, 17.5, Weakness::kBland, 9}));
}

TEST(WeakPlaces, ARouteWithoutAnyViewIsBlandAllTheWay) {
  route::Segment segment = SegmentOf({}, {});
  segment.key_views.clear();
  segment.features.clear();
  EXPECT_EQ(WeakPlacesOf({segment, segment}),
            (std::vector{WeakPlace{0.0, 20.0, Weakness::kBland, 0}}));
}

TEST(WeakPlaces, TooFewFeaturesToSteerByAreToldWhereOdometryIsSteeredBy) {
  const route::View view = ViewOf(1, 40);
  route::Segment bare = SegmentOf(view, view, true);
  bare.features.resize(5);
  EXPECT_EQ(WeakPlacesOf({SegmentOf(view, view, true), bare}),
            (std::vector{WeakPlace{10.0, 20.0, Weakness::kBare, 5}}));
  bare.has_odometry = false;
  EXPECT_TRUE(WeakPlacesOf({bare}).empty());
}

}  // namespace
}  // namespace trailcast::view
