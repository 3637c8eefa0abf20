#include "services/junctions/find_junctions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace trailcast::junctions {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth_px = 320;
constexpr double kHalfWidthsARadian = 1.73;  // of a camera of 60 degrees

struct Landmark {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;  // above the camera
  route::Descriptor descriptor{};
};

struct Pose {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
};

// Landmarks about a place, none like another.
std::vector<Landmark> Building(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Landmark> landmarks(1200);
  for (Landmark& each : landmarks) {
    each.x = uniform(-15.0, 30.0);
    each.y = uniform(-15.0, 15.0);
    each.z = uniform(-1.0, 2.0);
    for (std::uint8_t& byte : each.descriptor) byte = static_cast<std::uint8_t>(random());
  }
  return landmarks;
}

struct Scout {
  double magnification = 1.0;  // of its camera
  double looks_left = 0.0;     // radians
  double pace = 0.5;           // m/s
  bool odometry = true;
  bool reverse = false;
  unsigned noise = 1;
};

// Where a landmark is in the picture, and how far ahead; nothing outside of it.
struct Seen {
  double ahead = 0.0;
  float u_px = 0.0F;
  float v_px = 0.0F;
};
std::optional<Seen> Project(const Landmark& landmark, const Pose& pose, const Scout& scout) {
  const double heading = pose.heading + scout.looks_left;
  const double east = landmark.x - pose.x;
  const double north = landmark.y - pose.y;
  const double ahead = east * std::cos(heading) + north * std::sin(heading);
  const double left = north * std::cos(heading) - east * std::sin(heading);
  if (ahead < 2.0 || ahead > 10.0) return std::nullopt;
  const double focal_px = 0.5 * kWidth_px * kHalfWidthsARadian * scout.magnification;
  const Seen seen{ahead, static_cast<float>(-focal_px * left / ahead),
                  static_cast<float>(-focal_px * landmark.z / ahead)};
  if (std::abs(seen.u_px) > 140.0F || std::abs(seen.v_px) > 100.0F) return std::nullopt;
  return seen;
}

route::View See(const std::vector<Landmark>& building, const Pose& pose, const Scout& scout,
                std::mt19937& noise) {
  constexpr std::size_t kMost = 26;
  constexpr int kFlippedBits = 24;
  std::vector<std::pair<double, route::ViewFeature>> near;
  for (const Landmark& each : building) {
    const auto seen = Project(each, pose, scout);
    if (!seen) continue;
    route::ViewFeature feature{each.descriptor, seen->u_px, seen->v_px, 0.0F};
    for (int flip = 0; flip < kFlippedBits; ++flip) {
      feature.descriptor[noise() % feature.descriptor.size()] ^=
          static_cast<std::uint8_t>(1U << (noise() % 8U));
    }
    near.emplace_back(seen->ahead, feature);
  }
  std::sort(near.begin(), near.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  route::View view;
  for (std::size_t i = 0; i < std::min(kMost, near.size()); ++i) view.push_back(near[i].second);
  return view;
}

// Returns what was tracked from one place to the next.
std::vector<route::Feature> Track(const std::vector<Landmark>& building, const Pose& from,
                                  const Pose& to, const Scout& scout) {
  std::vector<route::Feature> features;
  for (const Landmark& each : building) {
    const auto first = Project(each, from, scout);
    const auto last = Project(each, to, scout);
    if (!first || !last) continue;
    route::Feature& feature = features.emplace_back();
    feature.track = {{0.0F, first->u_px, first->v_px}, {1.0F, last->u_px, last->v_px}};
  }
  return features;
}

// A route along these places, a segment from each to the next, with a key view at each.
RouteViews Teach(const std::vector<Landmark>& building, const std::vector<Pose>& poses,
                 const Scout& scout = {}) {
  std::mt19937 noise(scout.noise);
  RouteViews views(kWidth_px);
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    route::Segment segment;
    segment.index = SegmentIndex(static_cast<std::uint32_t>(i));
    const double length_m = std::hypot(poses[i + 1].x - poses[i].x, poses[i + 1].y - poses[i].y);
    segment.duration_s = length_m / scout.pace;
    segment.has_odometry = scout.odometry;
    segment.reverse = scout.reverse;
    if (scout.odometry) {
      segment.length_m = length_m;
      segment.heading_change_rad = poses[i + 1].heading - poses[i].heading;
      segment.heading.c[0] = segment.heading_change_rad / length_m;
    }
    segment.features = Track(building, poses[i], poses[i + 1], scout);
    segment.key_views.push_back({0.0, See(building, poses[i], scout, noise)});
    views.Add(segment);
  }
  return views;
}

// Along x, the camera to the front or, of who comes back, to where it came from.
std::vector<Pose> Straight(double from, double to, double step = 0.6) {
  std::vector<Pose> poses;
  const double sign = to > from ? 1.0 : -1.0;
  for (double way = 0.0; way < std::abs(to - from); way += step) {
    poses.push_back({from + sign * way, 0.0, sign > 0.0 ? 0.0 : std::numbers::pi});
  }
  return poses;
}

std::vector<Pose> Round(double turns) {
  constexpr double kRadius_m = 4.0;
  std::vector<Pose> poses;
  for (double angle = 0.0; angle < turns * 2.0 * std::numbers::pi; angle += 0.12) {
    poses.push_back({kRadius_m * std::sin(angle), kRadius_m - kRadius_m * std::cos(angle), angle});
  }
  return poses;
}

TEST(FindJunctions, TellsWhereTwoRoutesRunTogether) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  const RouteViews b = Teach(building, Straight(5.2, 12.0, 0.7), {.noise = 2});
  const auto junctions = FindJunctions(a, b, true);
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_NEAR(junctions[0].at_a - junctions[0].at_b, 5.2, 0.3);
  EXPECT_NEAR(junctions[0].at_b, 0.0, 1.0);
  EXPECT_NEAR(junctions[0].end_a - junctions[0].end_b, 5.2, 0.3);
  EXPECT_GT(junctions[0].length(), 5.0);
  EXPECT_LT(junctions[0].length(), 8.0);
  EXPECT_GT(junctions[0].features, 60);
  EXPECT_GT(junctions[0].confidence, 0.9);
  EXPECT_NEAR(junctions[0].heading_rad, 0.0, 0.02);
}

TEST(FindJunctions, TellsWhichWayTheSecondLooks) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  const RouteViews b = Teach(building, Straight(5.2, 12.0), {.looks_left = 0.1, .noise = 2});
  const auto junctions = FindJunctions(a, b, true);
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_NEAR(junctions[0].heading_rad, 0.1, 0.03);
  EXPECT_FALSE(junctions[0].heading_scaled);
}

TEST(FindJunctions, LearnsFromTurnsHowFarARadianShifts) {
  const auto building = Building(1);
  const Scout far_sighted{.magnification = 1.5};
  const Scout other{.magnification = 1.5, .looks_left = 0.1, .noise = 2};
  auto poses = Straight(-6.0, 0.0);
  for (const Pose& pose : Round(0.25)) poses.push_back(pose);
  const auto junctions =
      FindJunctions(Teach(building, poses, far_sighted), Teach(building, poses, other), true);
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_TRUE(junctions[0].heading_scaled);
  EXPECT_NEAR(junctions[0].heading_rad, 0.1, 0.04);
}

TEST(FindJunctions, KnowsAPlaceThroughACameraThatMagnifies) {
  const auto building = Building(1);
  auto poses = Straight(-6.0, 0.0);
  for (const Pose& pose : Round(0.25)) poses.push_back(pose);
  const std::vector<Pose> later(poses.begin() + 4, poses.end());
  const auto junctions = FindJunctions(
      Teach(building, poses), Teach(building, later, {.magnification = 1.3, .noise = 2}), false);
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_NEAR(junctions[0].log_scale, std::log(1.3), 0.05);
  EXPECT_NEAR(junctions[0].at_a - junctions[0].at_b, 4 * 0.6, 0.4);
  EXPECT_NEAR(junctions[0].end_a - junctions[0].end_b, 4 * 0.6, 0.4);
}

TEST(FindJunctions, MeasuresInSecondsWhereThereWasNoOdometry) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0), {.odometry = false});
  const RouteViews b =
      Teach(building, Straight(5.2, 12.0), {.pace = 1.0, .odometry = false, .noise = 2});
  const auto junctions = FindJunctions(a, b, true);
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_FALSE(a.metric());
  EXPECT_NEAR(0.5 * junctions[0].at_a, 5.2 + 1.0 * junctions[0].at_b, 0.6);
  EXPECT_NEAR(0.5 * junctions[0].end_a, 5.2 + 1.0 * junctions[0].end_b, 0.6);
}

TEST(FindJunctions, FindsNoneWhereTheRoutesHaveNothingInCommon) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  EXPECT_THAT(FindJunctions(a, Teach(Building(2), Straight(0.0, 14.0)), true), IsEmpty());
  EXPECT_THAT(FindJunctions(a, Teach(building, Straight(14.0, 0.0)), true), IsEmpty())
      << "backwards";
  EXPECT_THAT(FindJunctions(a, RouteViews(kWidth_px), true), IsEmpty());
  EXPECT_THAT(FindJunctions(RouteViews(kWidth_px), a, true), IsEmpty());
}

TEST(FindJunctions, BelievesNoPictureWhoseFeaturesAreInOtherPlaces) {
  auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  // The same things, put elsewhere.
  std::mt19937 random(3);
  std::vector<double> heights;
  for (Landmark& each : building) heights.push_back(each.y);
  std::shuffle(heights.begin(), heights.end(), random);
  for (std::size_t i = 0; i < building.size(); ++i) building[i].y = heights[i];
  EXPECT_THAT(FindJunctions(a, Teach(building, Straight(0.0, 14.0), {.noise = 2}), true),
              IsEmpty());
}

TEST(FindJunctions, TakesOneViewForNoJunction) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  const RouteViews b = Teach(building, {{6.0, 0.0, 0.0}, {6.0, 0.1, 0.0}}, {.noise = 2});
  EXPECT_THAT(FindJunctions(a, b, true), IsEmpty());
}

TEST(FindJunctions, LeavesOutWhatWasDrivenBackwards) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  EXPECT_THAT(
      FindJunctions(a, Teach(building, Straight(0.0, 14.0), {.reverse = true, .noise = 2}), true),
      IsEmpty());
}

TEST(FindJunctions, FindsEachOfTwoSections) {
  const auto building = Building(1);
  auto poses = Straight(0.0, 4.8);
  for (const Pose& pose : Round(0.9)) poses.push_back({4.8 + pose.x, pose.y, pose.heading});
  const RouteViews a = Teach(building, poses);
  // The same way but for some metres in other rooms.
  auto elsewhere = poses;
  for (std::size_t i = 12; i < 30; ++i) elsewhere[i].y += 100.0;
  const auto junctions =
      FindJunctions(a, Teach(building, elsewhere, {.odometry = false, .noise = 2}), true);
  ASSERT_THAT(junctions, SizeIs(2));
}

TEST(FindJunctions, IsOverSoonWhereItIsGivenUp) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, Straight(0.0, 14.0));
  int asked = 0;
  JunctionOptions options;
  options.give_up = [&] { return ++asked > 0; };
  EXPECT_THAT(FindJunctions(a, a, true, options), IsEmpty());
  EXPECT_THAT(FindLoops(a, options), IsEmpty());
  EXPECT_LE(asked, 4);
}

TEST(FindJunctions, IsBoundedWhereAllLooksAlike) {
  const auto building = Building(1);
  const RouteViews a = Teach(building, std::vector<Pose>(60, Pose{5.0, 0.0, 0.0}));
  const RouteViews b = Teach(building, Straight(0.0, 14.0));
  JunctionOptions options;
  options.most_alike = 100;
  EXPECT_LE(FindJunctions(a, b, true, options).size(), 1U);
  EXPECT_LE(FindJunctions(a, a, true, options).size(), options.most_junctions);
}

TEST(FindLoops, TellsWhereARouteComesBack) {
  const auto junctions = FindLoops(Teach(Building(1), Round(1.3)));
  ASSERT_THAT(junctions, SizeIs(1));
  EXPECT_NEAR(junctions[0].at_b - junctions[0].at_a, 2.0 * std::numbers::pi * 4.0, 0.5);
  EXPECT_GT(junctions[0].length(), 4.0);
}

TEST(FindLoops, FindsNoneOnTheWayStraightOnOrStanding) {
  const auto building = Building(1);
  EXPECT_THAT(FindLoops(Teach(building, Straight(0.0, 14.0))), IsEmpty());
  EXPECT_THAT(FindLoops(Teach(building, Straight(0.0, 2.0, 0.04))), IsEmpty());
  EXPECT_THAT(FindLoops(Teach(building, Round(0.9))), IsEmpty());
}

}  // namespace
}  // namespace trailcast::junctions
