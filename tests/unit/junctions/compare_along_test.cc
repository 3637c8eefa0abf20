#include "services/junctions/compare_along.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace trailcast::junctions {
namespace {

using route::Segment;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth_px = 320;
constexpr std::size_t kSegments = 24;  // of a metre each
using Route = std::vector<Segment>;

// Along a corridor; where they are is that of the first metre that shows them.
struct Landmark {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  route::Descriptor descriptor{};
};

std::vector<Landmark> Corridor(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Landmark> landmarks(500);
  for (Landmark& each : landmarks) {
    each = {uniform(2.0, 34.0), uniform(-3.0, 3.0), uniform(-1.5, 1.5), {}};
    for (std::uint8_t& byte : each.descriptor) byte = static_cast<std::uint8_t>(random());
  }
  return landmarks;
}

route::View See(const std::vector<Landmark>& landmarks, double x, std::mt19937& noise) {
  constexpr double kFocal_px = 277.0;
  constexpr int kFlippedBits = 20;
  route::View view;
  for (const Landmark& each : landmarks) {
    const double ahead = each.x - x;
    const auto u = static_cast<float>(-kFocal_px * each.y / ahead);
    const auto v = static_cast<float>(-kFocal_px * each.z / ahead);
    const bool seen = ahead > 2.0 && ahead < 6.0 && std::abs(u) < 150.0F && std::abs(v) < 110.0F;
    if (!seen) continue;
    route::ViewFeature feature{each.descriptor, u, v, 0.0F};
    for (int flip = 0; flip < kFlippedBits; ++flip) {
      feature.descriptor[noise() % 32U] ^= static_cast<std::uint8_t>(1U << (noise() % 8U));
    }
    view.push_back(feature);
  }
  return view;
}

Route Teach(const std::vector<Landmark>& landmarks, unsigned seed) {
  std::mt19937 noise(seed);
  Route route(kSegments);
  for (std::size_t i = 0; i < kSegments; ++i) {
    Segment& segment = route[i];
    segment.index = SegmentIndex(static_cast<std::uint32_t>(i));
    segment.has_odometry = true;
    segment.length_m = 1.0;
    segment.duration_s = 2.0 + 0.01 * seed;
    for (const double s : {0.0, 0.5}) {
      segment.key_views.push_back({s, See(landmarks, static_cast<double>(i) + s, noise)});
    }
  }
  return route;
}

route::Feature FeatureNumber(int number) {
  route::Feature feature;
  feature.patch[0] = static_cast<std::uint8_t>(number % 16);
  feature.track = {{0.0F, static_cast<float>(number), 1.0F}, {1.0F, 2.0F, 3.0F}};
  return feature;
}

Comparison Compare(const Route& a, const Route& b, bool whole = true) {
  return CompareAlong({a, kWidth_px}, {b, kWidth_px}, true, whole);
}

TEST(CompareAlongTest, OfARefreshedRouteEachFeatureIsComparedWithItself) {
  Route a = Teach(Corridor(1), 1);
  int number = 0;
  for (Segment& segment : a) {
    for (int i = 0; i < 10; ++i) segment.features.push_back(FeatureNumber(++number));
  }
  Route b = a;
  b[3].features[0].missed = 2;
  for (const std::size_t changed : {8, 9, 10}) {
    b[changed].features.erase(b[changed].features.begin(), b[changed].features.begin() + 7);
    b[changed].features.push_back(FeatureNumber(++number));
  }
  b[5].key_views.push_back({1.0, b[7].key_views[0].features, std::uint8_t{1}});
  const Comparison found = Compare(a, b);
  EXPECT_TRUE(found.refreshed);
  ASSERT_THAT(found.parts, SizeIs(kSegments));
  EXPECT_EQ(found.parts[3].stayed, 10);
  EXPECT_EQ(found.parts[8], (Part{8.0, 9.0, 8.0, 9.0, 10, 3, 1, 10, {}}));
  const Part all = Together(found.parts);
  EXPECT_EQ(all.features, 240);
  EXPECT_EQ(all.went(), 21);
  EXPECT_EQ(all.came, 3);
  const auto differing = Differing(found.parts);
  ASSERT_THAT(differing, SizeIs(1));
  EXPECT_EQ(differing[0].begin, 8.0);
  EXPECT_EQ(differing[0].end, 11.0);
  EXPECT_THAT(Differing(Compare(a, a).parts), IsEmpty());
}

TEST(CompareAlongTest, AnotherTeachingIsFoundToDifferWhereThePlaceHasChanged) {
  const std::vector<Landmark> before = Corridor(1);
  std::vector<Landmark> after = before;
  const std::vector<Landmark> others = Corridor(2);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i].x > 13.0 && after[i].x < 19.0) after[i].descriptor = others[i].descriptor;
  }
  const Comparison found = Compare(Teach(before, 1), Teach(after, 2));
  EXPECT_FALSE(found.refreshed);
  ASSERT_THAT(found.parts, SizeIs(kSegments));
  const auto differing = Differing(found.parts);
  ASSERT_THAT(differing, SizeIs(1));
  // These differ by what is seen two to six metres ahead.
  EXPECT_NEAR(differing[0].begin, 9.0, 2.0);
  EXPECT_NEAR(differing[0].end, 16.0, 2.0);
  EXPECT_LT(differing[0].share(), 0.4);
  EXPECT_GT(differing[0].came, 0);
  EXPECT_NEAR(differing[0].begin_b, differing[0].begin, 0.5);
  EXPECT_GT(found.parts[3].share(), 0.8) << "and elsewhere it is as it was";
  EXPECT_THAT(Differing(Compare(Teach(before, 1), Teach(before, 2)).parts), IsEmpty());
}

TEST(CompareAlongTest, APathThatWasMovedIsToldAndByHowMuch) {
  const std::vector<Landmark> corridor = Corridor(1);
  Route moved = Teach(corridor, 2);
  moved[9].turn_before_rad = 0.5;  // half a metre to the left, for three
  moved[10].turn_before_rad = -0.5;
  moved[13].turn_before_rad = -0.5;
  moved[14].turn_before_rad = 0.5;
  const auto differing = Differing(Compare(Teach(corridor, 1), moved).parts);
  ASSERT_THAT(differing, SizeIs(1));
  EXPECT_NEAR(differing[0].begin, 10.0, 1.0);
  EXPECT_NEAR(differing[0].end, 13.0, 1.0);
  EXPECT_NEAR(differing[0].aside_m.value_or(0.0), 0.4, 0.15);
  for (Segment& segment : moved) segment.turn_before_rad = -segment.turn_before_rad;
  const auto right = Differing(Compare(Teach(corridor, 1), moved).parts);
  ASSERT_THAT(right, SizeIs(1));
  EXPECT_NEAR(right[0].aside_m.value_or(0.0), -0.4, 0.15);
}

TEST(CompareAlongTest, OfAnotherRouteThePartThatGoesTheSameWayIsCompared) {
  const Route hall = Teach(Corridor(1), 1);
  Route office = Teach(Corridor(1), 2);
  const Route elsewhere = Teach(Corridor(3), 3);
  std::copy(elsewhere.begin() + 12, elsewhere.end(), office.begin() + 12);
  const Comparison found = Compare(hall, office, false);
  ASSERT_THAT(found.parts, testing::Not(IsEmpty()));
  EXPECT_LT(found.parts.front().begin, 2.0);
  EXPECT_NEAR(found.parts.back().end, 12.0, 3.0);
  EXPECT_NEAR(found.length, 24.0, 1e-9);
  EXPECT_THAT(Compare(hall, elsewhere).parts, IsEmpty());
}

TEST(CompareAlongTest, WithoutOdometryNoPathIsSaidToHaveBeenMoved) {
  Route a = Teach(Corridor(1), 1);
  Route b = Teach(Corridor(1), 2);
  for (Route* route : {&a, &b}) {
    for (Segment& segment : *route) {
      segment.has_odometry = false;
      segment.length_m = 0.0;
    }
  }
  const Comparison found = Compare(a, b);
  EXPECT_FALSE(found.metric);
  ASSERT_THAT(found.parts, testing::Not(IsEmpty()));
  for (const Part& part : found.parts) EXPECT_EQ(part.aside_m, std::nullopt);
}

}  // namespace
}  // namespace trailcast::junctions
