#include "services/vision/feature_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/painted_wall.h"

namespace trailcast::vision {
namespace {

const test::PaintedWall kTrackedWall(3);

std::map<int, route::TrackedFeature> ById(const std::vector<route::TrackedFeature>& features) {
  std::map<int, route::TrackedFeature> by_id;
  for (const auto& feature : features) by_id[feature.id] = feature;
  return by_id;
}

std::ptrdiff_t InTheMiddle(const std::vector<route::TrackedFeature>& features) {
  return std::count_if(features.begin(), features.end(), [](const auto& feature) {
    return std::abs(feature.u_px) <= 40.0 && std::abs(feature.v_px) <= 30.0;  // of 320 x 240
  });
}

TEST(FeatureTracker, DetectsSomeMoreInTheMiddleForNarrowerCameras) {
  FeatureTracker spread;
  spread.Track(kTrackedWall.Photograph({}));
  const auto few = spread.Detect();
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({}));
  const auto features = tracker.Detect(20);
  EXPECT_LT(InTheMiddle(few), 8);
  EXPECT_GE(InTheMiddle(features), 14);
  EXPECT_LE(InTheMiddle(features), 20);
  EXPECT_EQ(features.size() - few.size(),
            static_cast<std::size_t>(InTheMiddle(features) - InTheMiddle(few)));
}

TEST(FeatureTracker, DetectsAtMostSixtyFeaturesSpreadOverTheImage) {
  FeatureTracker tracker;
  EXPECT_TRUE(tracker.Track(kTrackedWall.Photograph({})).empty());
  const auto features = tracker.Detect();
  EXPECT_LE(features.size(), 60U);
  EXPECT_GE(features.size(), 40U);
  EXPECT_GT(std::count_if(features.begin(), features.end(), [](auto& f) { return f.u_px < -40; }),
            5);
  EXPECT_GT(std::count_if(features.begin(), features.end(), [](auto& f) { return f.u_px > 40; }),
            5);
}

TEST(FeatureTracker, FollowsAKnownShiftToATenthOfAPixel) {
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({}));
  const auto before = ById(tracker.Detect());
  const auto after = tracker.Track(kTrackedWall.Photograph({.du_px = 7.3, .dv_px = -2.6}));
  EXPECT_GE(after.size(), before.size() * 8 / 10);
  for (const auto& feature : after) {
    EXPECT_NEAR(feature.u_px - before.at(feature.id).u_px, 7.3, 0.15);
    EXPECT_NEAR(feature.v_px - before.at(feature.id).v_px, -2.6, 0.15);
  }
}

TEST(FeatureTracker, FollowsMagnificationNoiseAndGainOverManyFrames) {
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({.noise_grey = 2.5}));
  const auto before = ById(tracker.Detect());
  std::vector<route::TrackedFeature> now;
  double scale = 1.0;
  for (unsigned frame = 1; frame <= 20; ++frame) {
    scale *= 1.01;
    now = tracker.Track(kTrackedWall.Photograph(
        {.scale = scale, .gain = 1.0 - 0.005 * frame, .noise_grey = 2.5, .noise_seed = frame + 1}));
  }
  EXPECT_GE(now.size(), before.size() / 2);
  std::size_t close = 0;
  for (const auto& feature : now) {
    const auto& start = before.at(feature.id);
    close += std::hypot(feature.u_px - scale * start.u_px, feature.v_px - scale * start.v_px) < 1.5;
  }
  EXPECT_GE(close, now.size() * 9 / 10);
}

// Followed in pictures three times as large as those in which they were detected.
std::size_t LeftOfLargePatterns(double told) {
  FeatureTracker near;
  near.Track(kTrackedWall.Photograph({.noise_grey = 2.5}));
  std::vector<route::TrackedFeature> features = near.Detect(20);
  for (auto& feature : features) {
    feature.u_px *= 3.0;
    feature.v_px *= 3.0;
  }
  std::erase_if(features, [](const auto& feature) {
    return std::abs(feature.u_px) > 140.0 || std::abs(feature.v_px) > 100.0;
  });
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({.scale = 3.0, .noise_grey = 2.5, .noise_seed = 1}));
  tracker.SetMagnification(told);
  tracker.Follow(features);
  for (unsigned frame = 2; frame < 20; ++frame) {
    tracker.Track(kTrackedWall.Photograph(
        {.scale = 3.0, .du_px = 0.5 * frame, .noise_grey = 2.5, .noise_seed = frame}));
  }
  return static_cast<std::size_t>(tracker.count());
}

TEST(FeatureTracker, FollowsLargerPatternsByALargerWindow) {
  EXPECT_GT(LeftOfLargePatterns(3.0), LeftOfLargePatterns(1.0));
  EXPECT_GE(LeftOfLargePatterns(3.0), 8U);
}

TEST(FeatureTracker, LosesEverythingWhenTheViewChangesAltogether) {
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({}));
  const auto before = tracker.Detect();
  const auto after = tracker.Track(test::PaintedWall(99).Photograph({}));
  EXPECT_LE(after.size(), before.size() / 4);
}

TEST(FeatureTracker, SaysHowManyLeftThePictureAndHowManyDidNotReturn) {
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({}));
  const auto before = tracker.Detect();
  const auto after = tracker.Track(kTrackedWall.Photograph({.du_px = 25.0}));
  const TrackLosses aside = tracker.losses();
  EXPECT_EQ(static_cast<std::size_t>(aside.left_picture + aside.not_returned),
            before.size() - after.size());
  EXPECT_GT(aside.left_picture, 0);
  const auto elsewhere = tracker.Track(test::PaintedWall(99).Photograph({}));
  EXPECT_GT(tracker.losses().not_returned, static_cast<int>(after.size()) / 2);
  tracker.Follow({});
  tracker.Track(kTrackedWall.Photograph({}));
  EXPECT_EQ(tracker.losses().not_returned, 0) << "of the last frame only";
}

TEST(FeatureTracker, DescribesWhatACameraThatMagnifiesLessWouldSee) {
  constexpr double kMagnification = 1.3;
  FeatureTracker larger;
  larger.Track(kTrackedWall.Photograph({.scale = kMagnification}));
  std::vector<route::TrackedFeature> features = larger.Detect();
  const std::vector<route::DescribedFeature> described = larger.Describe(kMagnification);
  EXPECT_GE(described.size(), 40U);
  FeatureTracker smaller;
  smaller.Track(kTrackedWall.Photograph({}));
  for (route::TrackedFeature& feature : features) {
    feature.u_px /= kMagnification;
    feature.v_px /= kMagnification;
  }
  smaller.Follow(features);
  const std::vector<route::DescribedFeature> there = smaller.Describe();
  double apart = 0.0;
  int samples = 0;
  for (const route::DescribedFeature& a : described) {
    const auto b = std::find_if(there.begin(), there.end(),
                                [&](const auto& each) { return each.at.id == a.at.id; });
    if (b == there.end()) continue;
    for (std::size_t i = 0; i < a.patch.size(); ++i, ++samples) {
      apart += std::abs(static_cast<double>(a.patch[i]) - b->patch[i]);
    }
  }
  ASSERT_GT(samples, 0);
  EXPECT_LT(apart / samples, 1.0) << "of sixteen levels";
}

TEST(FeatureTracker, FindsNothingInANoisyBlankOrDarkImage) {
  for (const double gain : {0.0, 1.0}) {
    FeatureTracker tracker;
    tracker.Track(test::PaintedWall(1, 0).Photograph({.gain = gain, .noise_grey = 3.0}));
    EXPECT_TRUE(tracker.Detect().empty());
    EXPECT_TRUE(tracker.Describe().empty());
  }
}

TEST(FeatureTracker, KeepsOffTheBlackSurroundOfAFisheye) {
  image::GrayImage frame = kTrackedWall.Photograph({});
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (std::hypot(x - 159.5, y - 119.5) > 115.0) {
        frame.pixels[image::PixelIndex(x, y, frame.width)] = 5;
      }
    }
  }
  FeatureTracker tracker;
  tracker.Track(frame);
  const auto features = tracker.Detect();
  ASSERT_GE(features.size(), 15U);
  for (const auto& feature : features) EXPECT_LT(std::hypot(feature.u_px, feature.v_px), 110.0);
}

// A wall whose corners are in shadow, as seen by a robot that drives past it.
image::GrayImage DarkCorners(double driven_px) {
  image::GrayImage frame = kTrackedWall.Photograph({.du_px = driven_px, .gain = 0.5});
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (std::hypot(x - 159.5 - driven_px, y - 119.5) > 125.0) {
        std::uint8_t& pixel = frame.pixels[image::PixelIndex(x, y, frame.width)];
        pixel = static_cast<std::uint8_t>(pixel / 3);
      }
    }
  }
  return frame;
}

TEST(FeatureTracker, TakesForALensesSurroundOnlyWhatStaysBlack) {
  const FeatureTrackerOptions all{.max_features = 400};  // also those that are weak
  FeatureTracker standing(all);
  standing.Track(DarkCorners(0.0));
  FeatureTracker driving(all);
  for (int i = 0; i <= 32; ++i) driving.Track(DarkCorners(-160.0 + 10.0 * i));
  driving.Track(DarkCorners(0.0));
  const auto outside = [](const std::vector<route::TrackedFeature>& features) {
    return std::count_if(features.begin(), features.end(), [](const auto& feature) {
      return std::hypot(feature.u_px, feature.v_px) > 128.0;
    });
  };
  const auto by_one_frame = outside(standing.Detect());
  EXPECT_LT(by_one_frame, 4);  // where the shadow is not deep
  EXPECT_GT(outside(driving.Detect()), by_one_frame + 8);
}

TEST(FeatureTracker, GoesOnWithTheFeaturesItIsGiven) {
  FeatureTracker tracker;
  tracker.Track(kTrackedWall.Photograph({}));
  auto detected = tracker.Detect();
  detected.resize(5);
  for (auto& feature : detected) feature.id += 100;
  tracker.Follow(detected);
  const auto after = tracker.Track(kTrackedWall.Photograph({.du_px = 2.0}));
  ASSERT_EQ(after.size(), 5U);
  EXPECT_EQ(after.front().id, detected.front().id);
}

TEST(FeatureTracker, EqualFramesGiveEqualResults) {
  const auto run = [] {
    FeatureTracker tracker;
    tracker.Track(kTrackedWall.Photograph({.noise_grey = 2.0}));
    tracker.Detect();
    return tracker.Track(
        kTrackedWall.Photograph({.du_px = 3.0, .noise_grey = 2.0, .noise_seed = 9}));
  };
  const auto first = run();
  const auto second = run();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].u_px, second[i].u_px);
    EXPECT_EQ(first[i].v_px, second[i].v_px);
  }
}

}  // namespace
}  // namespace trailcast::vision
