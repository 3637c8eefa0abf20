#include "services/teach/segment_recorder.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "services/route/heading.h"
#include "tests/support/taught_segment.h"

namespace trailcast::teach {
namespace {

using Event = SegmentRecorder::Event;

std::vector<route::TrackedFeature> Features(int count, double u_px = 0.0) {
  std::vector<route::TrackedFeature> features;
  features.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) features.push_back({i, u_px + i, -2.0 * i});
  return features;
}

TEST(SegmentRecorder, EndsWhenFewerThanHalfSurvive) {
  SegmentRecorder recorder(320);
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_EQ(recorder.Add(FromSeconds(0.1), Features(8, 1.0), std::nullopt), Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(0.2), Features(5, 2.0), std::nullopt), Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(0.3), Features(4, 3.0), std::nullopt), Event::kEnds);
}

TEST(SegmentRecorder, KeepsWhatWasTrackedThroughoutWithFirstAndLastPlace) {
  SegmentRecorder recorder(320);
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_EQ(recorder.Add(FromSeconds(0.5), Features(7, 5.0), std::nullopt), Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(1.0), Features(6, 20.0), std::nullopt), Event::kGoesOn);
  const auto segment = recorder.Finish();
  ASSERT_TRUE(segment);
  ASSERT_EQ(segment->features.size(), 6U);
  EXPECT_FLOAT_EQ(segment->features[3].first().u_px, 3.0F);
  EXPECT_FLOAT_EQ(segment->features[3].milestone().u_px, 23.0F);
  EXPECT_FLOAT_EQ(segment->features[3].first().s, 0.0F);
  EXPECT_FLOAT_EQ(segment->features[3].milestone().s, 1.0F);
  EXPECT_FALSE(segment->has_odometry);
  EXPECT_DOUBLE_EQ(segment->duration_s, 1.0);
}

TEST(SegmentRecorder, KnotsRiseStrictlyAndLieOnTheTrack) {
  const auto scene = test::LandmarkScene::Corridor(5.0, 14.0, 60, 3);
  const auto run = test::TeachArcs(scene, {}, {{1.5, 0.2}});
  ASSERT_GE(run.segment.features.size(), 10U);
  for (const route::Feature& feature : run.segment.features) {
    EXPECT_EQ(feature.track.size(), 4U);
    for (std::size_t i = 1; i < feature.track.size(); ++i) {
      EXPECT_GT(feature.track[i].s, feature.track[i - 1].s);
    }
  }
}

TEST(SegmentRecorder, ShortSegmentsHaveFewerKnots) {
  const auto scene = test::LandmarkScene::Corridor(5.0, 14.0, 60, 3);
  for (const auto& [length_m, knots] : {std::pair{0.1, 3U}, {0.25, 3U}, {0.4, 4U}}) {
    const auto run = test::TeachArcs(scene, {}, {{length_m, 0.2}});
    ASSERT_FALSE(run.segment.features.empty());
    for (const route::Feature& feature : run.segment.features) {
      EXPECT_EQ(feature.track.size(), knots) << length_m << " m";
    }
  }
}

TEST(SegmentRecorder, MeasuresLengthHeadingAndSpeed) {
  const auto scene = test::LandmarkScene::Corridor(5.0, 14.0, 60, 3);
  const auto run = test::TeachArcs(scene, {1.0, 0.2, 0.1}, {{1.0, 0.0}, {0.5, -0.3}});
  EXPECT_TRUE(run.segment.has_odometry);
  EXPECT_NEAR(run.segment.length_m, 1.5, 1e-6);
  EXPECT_NEAR(run.segment.heading_change_rad, -0.3, 1e-6);
  EXPECT_NEAR(run.segment.heading_variation_rad, 0.3, 1e-6);
  EXPECT_NEAR(run.segment.speed_mps(), 0.3, 1e-3);
  EXPECT_NEAR(route::HeadingAt(run.segment.heading, 1.5), -0.3, 0.05);
}

TEST(SegmentRecorder, WaitingDoesNotLowerTheTaughtSpeed) {
  SegmentRecorder recorder(320);
  motion::Pose2 pose;
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), pose);
  int frame = 0;
  for (int i = 0; i < 100; ++i) {
    if (i < 20 || i >= 80) pose.x_m += 0.01;
    EXPECT_EQ(recorder.Add(FromSeconds(++frame * 0.1), Features(10), pose), Event::kGoesOn);
  }
  const auto segment = recorder.Finish();
  ASSERT_TRUE(segment);
  EXPECT_NEAR(segment->length_m, 0.4, 1e-9);
  EXPECT_NEAR(segment->speed_mps(), 0.1, 1e-3);
}

TEST(SegmentRecorder, IndicesCountUp) {
  SegmentRecorder recorder(320);
  for (std::uint32_t expected = 0; expected < 3; ++expected) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
    EXPECT_EQ(recorder.Add(FromSeconds(0.1), Features(10, 1.0), std::nullopt), Event::kGoesOn);
    EXPECT_EQ(recorder.Finish()->index, SegmentIndex(expected));
  }
}

TEST(SegmentRecorder, ShortSegmentsKeepTheStrongestOnly) {
  const std::size_t fewest = SegmentRecorderOptions{}.fewest_kept;
  SegmentRecorder recorder(320);
  for (const double length_m : {0.1, 0.6, 1.9}) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(60)), motion::Pose2{});
    EXPECT_EQ(recorder.Add(FromSeconds(1.0), Features(50), motion::Pose2{length_m, 0.0, 0.0}),
              Event::kGoesOn);
    const auto segment = recorder.Finish();
    ASSERT_TRUE(segment);
    EXPECT_EQ(segment->features.size(), length_m < 0.5 ? fewest : length_m < 1.0 ? 24U : 50U);
    EXPECT_FLOAT_EQ(segment->features.back().first().u_px,
                    static_cast<float>(segment->features.size() - 1));
  }
}

TEST(SegmentRecorder, EndsAtItsLongestHoweverManySurvive) {
  SegmentRecorderOptions options;
  options.longest_m = 1.5;
  SegmentRecorder recorder(320, options);
  recorder.Begin(SensorTime{0}, test::Describe(Features(60)), motion::Pose2{});
  EXPECT_EQ(recorder.Add(FromSeconds(1.0), Features(60), motion::Pose2{1.4, 0.0, 0.0}),
            Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(1.1), Features(60), motion::Pose2{1.5, 0.0, 0.0}),
            Event::kEnds);
  EXPECT_NEAR(recorder.Finish()->length_m, 1.5, 1e-9);
}

TEST(SegmentRecorder, NothingAddedIsNoSegment) {
  SegmentRecorder recorder(320);
  EXPECT_FALSE(recorder.Finish());
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_FALSE(recorder.Finish());
}

TEST(SegmentRecorder, AStretchWithoutFeaturesIsASegmentByOdometryAlone) {
  SegmentRecorder recorder(320);
  recorder.Begin(SensorTime{0}, {}, motion::Pose2{});
  EXPECT_EQ(recorder.Add(FromSeconds(1.0), {}, motion::Pose2{0.5, 0.0, 0.0}), Event::kGoesOn);
  const auto segment = recorder.Finish();
  ASSERT_TRUE(segment);
  EXPECT_TRUE(segment->features.empty());
  EXPECT_NEAR(segment->length_m, 0.5, 1e-9);
}

TEST(SegmentRecorder, ARobotThatSetsOffTeachesNoSegmentOfNoLength) {
  SegmentRecorder recorder(320);
  recorder.Begin(SensorTime{0}, test::Describe(Features(20)), motion::Pose2{});
  EXPECT_EQ(recorder.Add(FromSeconds(0.1), Features(20), motion::Pose2{0.01, 0.0, 0.0}),
            Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(0.2), Features(3), motion::Pose2{0.03, 0.0, 0.0}),
            Event::kGoesOn);
  EXPECT_EQ(recorder.Add(FromSeconds(0.3), Features(3), motion::Pose2{0.06, 0.0, 0.0}),
            Event::kEnds);
  EXPECT_NEAR(recorder.Finish()->length_m, 0.06, 1e-9);
}

TEST(SegmentRecorder, WhatWasLostBeforeTheRobotMovedIsDetectedAnew) {
  SegmentRecorder recorder(320);
  for (const std::optional<motion::Pose2> pose : {std::optional(motion::Pose2{}), {}}) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(20)), pose);
    EXPECT_EQ(recorder.Add(FromSeconds(1.0), Features(15), pose), Event::kGoesOn);
    EXPECT_EQ(recorder.Add(FromSeconds(2.0), Features(6), pose), Event::kEnds);
    EXPECT_FALSE(recorder.Finish());
  }
}

TEST(SegmentRecorder, WithoutOdometryStandingIsSeenByTheFeatures) {
  SegmentRecorder recorder(320);
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  int frame = 0;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(recorder.Add(FromSeconds(++frame * 0.1), Features(10, 0.5 * i), std::nullopt),
              Event::kGoesOn);
    for (int standing = 0; standing < 5; ++standing) {
      EXPECT_EQ(recorder.Add(FromSeconds(++frame * 0.1), Features(10, 0.5 * i), std::nullopt),
                Event::kGoesOn);
    }
  }
  EXPECT_NEAR(recorder.Finish()->duration_s, 1.9, 0.11);
}

// Drives, turns on the spot, drives: 30 frames a second.
struct Drive {
  SegmentRecorder recorder{320};
  motion::Pose2 pose;
  int frame = 0;
  std::vector<route::Segment> segments;

  explicit Drive(const route::View& view = {}) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(20)), pose);
    if (!view.empty()) recorder.Keep(view);
  }
  void Go(int steps, double step_m, double step_rad, const route::View& view = {}) {
    for (int i = 0; i < steps; ++i) {
      pose = motion::Advance(pose, {step_m, step_rad});
      ++frame;
      const Event event = recorder.Add(FromSeconds(frame / 30.0), Features(20, frame), pose);
      if (event != Event::kGoesOn) Finish();
      if (event == Event::kEnds) {
        recorder.Begin(FromSeconds(frame / 30.0), test::Describe(Features(20)), pose);
      }
      if (!view.empty()) recorder.Keep(view);
    }
  }
  void Finish() {
    if (auto segment = recorder.Finish()) segments.push_back(std::move(*segment));
  }
};

TEST(SegmentRecorder, ATurnOnTheSpotIsWhatTheNextSegmentBeginsWith) {
  Drive drive;
  drive.Go(50, 0.01, 0.0);
  drive.Go(60, 0.0005, 0.026);
  drive.Go(50, 0.01, 0.0);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 2U);
  EXPECT_NEAR(drive.segments[0].length_m, 0.5, 0.011);
  EXPECT_NEAR(drive.segments[0].heading_change_rad, 0.0, 1e-9);
  EXPECT_NEAR(drive.segments[0].turn_before_rad, 0.0, 1e-9);
  EXPECT_NEAR(drive.segments[1].turn_before_rad, 60 * 0.026, 0.03);
  EXPECT_NEAR(drive.segments[1].length_m, 0.5, 0.03);
  EXPECT_EQ(drive.segments[1].index, SegmentIndex(1));
}

TEST(SegmentRecorder, ATurnAtTheStartBelongsToTheFirstSegment) {
  Drive drive;
  drive.Go(40, 0.0, -0.03);
  drive.Go(50, 0.01, 0.0);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 1U);
  EXPECT_NEAR(drive.segments[0].turn_before_rad, -1.2, 0.04);
}

TEST(SegmentRecorder, ATurnThatNothingIsDrivenAfterIsTold) {
  Drive drive;
  drive.Go(50, 0.01, 0.0);
  drive.Go(40, 0.0, -0.03);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 1U);
  EXPECT_NEAR(drive.recorder.turned_rad(), -1.2, 0.04);
}

// Where a robot ends that drives the segments as they say.
motion::Pose2 EndOf(const std::vector<route::Segment>& segments) {
  motion::Pose2 pose;
  for (const route::Segment& segment : segments) {
    pose.heading_rad += segment.turn_before_rad;
    constexpr int kSteps = 200;
    const double step_m = segment.length_m / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      pose = motion::Advance(pose, {segment.reverse ? -step_m : step_m,
                                    route::HeadingAt(segment.heading, (i + 1) * step_m) -
                                        route::HeadingAt(segment.heading, i * step_m)});
    }
  }
  return pose;
}

TEST(SegmentRecorder, DrivingBackwardsIsASegmentOfItsOwn) {
  Drive drive;
  drive.Go(80, 0.01, 0.004);
  EXPECT_FALSE(drive.recorder.reverse());
  drive.Go(90, -0.01, 0.006);
  EXPECT_TRUE(drive.recorder.reverse());
  drive.Go(100, 0.01, -0.003);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 3U);
  EXPECT_FALSE(drive.segments[0].reverse);
  EXPECT_NEAR(drive.segments[0].length_m, 0.8 - 0.05, 0.02);
  EXPECT_TRUE(drive.segments[1].reverse);
  EXPECT_NEAR(drive.segments[1].length_m, 0.9 - 0.10, 0.03);
  EXPECT_NEAR(drive.segments[1].heading_change_rad, 0.006 * 80, 0.02);
  EXPECT_NEAR(drive.segments[1].speed_mps(), 0.3, 0.02);
  EXPECT_FALSE(drive.segments[2].reverse);
  const motion::Pose2 end = EndOf(drive.segments);
  EXPECT_NEAR(end.x_m, drive.pose.x_m, 0.02);
  EXPECT_NEAR(end.y_m, drive.pose.y_m, 0.01);
  EXPECT_NEAR(end.heading_rad, drive.pose.heading_rad, 1e-3);
}

TEST(SegmentRecorder, ARouteMayBeginBackwards) {
  Drive drive;
  drive.Go(90, -0.01, 0.004);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 1U);
  EXPECT_EQ(drive.segments[0].index, SegmentIndex(0));
  EXPECT_TRUE(drive.segments[0].reverse);
  EXPECT_NEAR(drive.segments[0].length_m, 0.9 - 0.05, 0.02);
  EXPECT_NEAR(EndOf(drive.segments).heading_rad, drive.pose.heading_rad, 1e-3);
}

TEST(SegmentRecorder, ATurnOnTheSpotMayBeFollowedByAWayBack) {
  Drive drive;
  drive.Go(80, 0.01, 0.0);
  drive.Go(40, 0.0, 0.02);
  drive.Go(80, -0.01, 0.0);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 2U);
  EXPECT_TRUE(drive.segments[1].reverse);
  EXPECT_NEAR(drive.segments[1].turn_before_rad, 0.8, 0.03);
  const motion::Pose2 end = EndOf(drive.segments);
  EXPECT_NEAR(end.x_m, drive.pose.x_m, 0.08);
  EXPECT_NEAR(end.y_m, drive.pose.y_m, 0.08);
}

TEST(SegmentRecorder, AnUneasyStandIsNotDrivingBackwards) {
  Drive drive;
  drive.Go(50, 0.01, 0.0);
  for (int i = 0; i < 20; ++i) {
    drive.Go(1, -0.003, 0.0);
    drive.Go(1, 0.003, 0.0);
    EXPECT_FALSE(drive.recorder.reverse());
  }
  drive.Go(50, 0.01, 0.0);
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 1U);
  EXPECT_NEAR(drive.segments[0].length_m, 1.0, 1e-6);
}

TEST(SegmentRecorder, ATightBendIsNoTurnOnTheSpot) {
  Drive drive;
  drive.Go(100, 0.005, 0.02);  // radius 0.25 m
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 1U);
  EXPECT_NEAR(drive.segments[0].heading_change_rad, 2.0, 1e-6);
  EXPECT_EQ(drive.segments[0].turn_before_rad, 0.0);
}

TEST(SegmentRecorder, KeyViewsStandWhereTheyWereSeen) {
  const auto view = [](float u_px) { return route::View{{{1}, u_px, 0.0F, 1.0F}}; };
  Drive drive(view(0.0F));
  drive.Go(50, 0.01, 0.0);
  drive.recorder.Keep(view(1.0F));
  drive.Go(50, 0.01, 0.0);
  drive.Go(30, 0.0, 0.03);
  drive.recorder.Keep(view(2.0F));
  drive.Go(30, 0.0, 0.03);
  drive.Go(20, 0.01, 0.0);
  drive.recorder.Keep(view(3.0F));
  drive.Finish();
  ASSERT_EQ(drive.segments.size(), 2U);
  const auto& first = drive.segments[0].key_views;
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].s, 0.0);
  EXPECT_NEAR(first[1].s, 0.5, 0.02);
  const auto& second = drive.segments[1].key_views;
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(second[0].features[0].u_px, 2.0F);
  EXPECT_EQ(second[0].s, 0.0);
  EXPECT_EQ(second[1].s, 1.0);
}

}  // namespace
}  // namespace trailcast::teach
