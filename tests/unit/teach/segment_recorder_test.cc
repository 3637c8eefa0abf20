#include "services/teach/segment_recorder.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "services/route/heading.h"
#include "tests/support/taught_segment.h"

namespace trailcast::teach {
namespace {

std::vector<route::TrackedFeature> Features(int count, double u_px = 0.0) {
  std::vector<route::TrackedFeature> features;
  features.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) features.push_back({i, u_px + i, -2.0 * i});
  return features;
}

TEST(SegmentRecorder, EndsWhenFewerThanHalfSurvive) {
  SegmentRecorder recorder;
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_FALSE(recorder.Add(FromSeconds(0.1), Features(8), std::nullopt));
  EXPECT_FALSE(recorder.Add(FromSeconds(0.2), Features(5), std::nullopt));
  EXPECT_TRUE(recorder.Add(FromSeconds(0.3), Features(4), std::nullopt));
}

TEST(SegmentRecorder, KeepsWhatWasTrackedThroughoutWithFirstAndLastPlace) {
  SegmentRecorder recorder;
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_FALSE(recorder.Add(FromSeconds(0.5), Features(7, 5.0), std::nullopt));
  EXPECT_FALSE(recorder.Add(FromSeconds(1.0), Features(6, 20.0), std::nullopt));
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
  SegmentRecorder recorder;
  motion::Pose2 pose;
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), pose);
  int frame = 0;
  for (int i = 0; i < 100; ++i) {
    if (i < 20 || i >= 80) pose.x_m += 0.01;
    EXPECT_FALSE(recorder.Add(FromSeconds(++frame * 0.1), Features(10), pose));
  }
  const auto segment = recorder.Finish();
  ASSERT_TRUE(segment);
  EXPECT_NEAR(segment->length_m, 0.4, 1e-9);
  EXPECT_NEAR(segment->speed_mps(), 0.1, 1e-3);
}

TEST(SegmentRecorder, IndicesCountUp) {
  SegmentRecorder recorder;
  for (std::uint32_t expected = 0; expected < 3; ++expected) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
    EXPECT_FALSE(recorder.Add(FromSeconds(0.1), Features(10), std::nullopt));
    EXPECT_EQ(recorder.Finish()->index, SegmentIndex(expected));
  }
}

TEST(SegmentRecorder, ShortSegmentsKeepTheStrongestOnly) {
  const std::size_t fewest = SegmentRecorderOptions{}.fewest_kept;
  SegmentRecorder recorder;
  for (const double length_m : {0.1, 0.6, 1.9}) {
    recorder.Begin(SensorTime{0}, test::Describe(Features(60)), motion::Pose2{});
    EXPECT_FALSE(recorder.Add(FromSeconds(1.0), Features(50), motion::Pose2{length_m, 0.0, 0.0}));
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
  SegmentRecorder recorder(options);
  recorder.Begin(SensorTime{0}, test::Describe(Features(60)), motion::Pose2{});
  EXPECT_FALSE(recorder.Add(FromSeconds(1.0), Features(60), motion::Pose2{1.4, 0.0, 0.0}));
  EXPECT_TRUE(recorder.Add(FromSeconds(1.1), Features(60), motion::Pose2{1.5, 0.0, 0.0}));
  EXPECT_NEAR(recorder.Finish()->length_m, 1.5, 1e-9);
}

TEST(SegmentRecorder, NothingAddedIsNoSegment) {
  SegmentRecorder recorder;
  EXPECT_FALSE(recorder.Finish());
  recorder.Begin(SensorTime{0}, test::Describe(Features(10)), std::nullopt);
  EXPECT_FALSE(recorder.Finish());
}

TEST(SegmentRecorder, AStretchWithoutFeaturesIsASegmentByOdometryAlone) {
  SegmentRecorder recorder;
  recorder.Begin(SensorTime{0}, {}, motion::Pose2{});
  EXPECT_FALSE(recorder.Add(FromSeconds(1.0), {}, motion::Pose2{0.5, 0.0, 0.0}));
  const auto segment = recorder.Finish();
  ASSERT_TRUE(segment);
  EXPECT_TRUE(segment->features.empty());
  EXPECT_NEAR(segment->length_m, 0.5, 1e-9);
}

}  // namespace
}  // namespace trailcast::teach
