#include "services/replay/src/track_progress.h"

#include <gtest/gtest.h>

#include "services/route/track.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

const test::LandmarkScene kProgressScene = test::LandmarkScene::Corridor(5.0, 14.0, 60, 3);

TEST(TaughtPlace, RunsThroughTheKnotsAndBeyondTheLast) {
  const route::Feature feature{
      {}, {}, {{0.0F, 10.0F, 0.0F}, {0.5F, 20.0F, 4.0F}, {1.0F, 40.0F, 8.0F}}};
  EXPECT_FLOAT_EQ(route::TaughtPlace(feature, 0.0).u_px, 10.0F);
  EXPECT_FLOAT_EQ(route::TaughtPlace(feature, 0.25).u_px, 15.0F);
  EXPECT_FLOAT_EQ(route::TaughtPlace(feature, 0.75).v_px, 6.0F);
  EXPECT_FLOAT_EQ(route::TaughtPlace(feature, 1.0).u_px, 40.0F);
  EXPECT_FLOAT_EQ(route::TaughtPlace(feature, 1.25).u_px, 50.0F);
}

TEST(TrackProgress, FollowsAStraightDrive) {
  const test::TaughtRun run = test::TeachArcs(kProgressScene, {}, {{2.0, 0.0}});
  for (const double x : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const auto features = test::Matched(kProgressScene, run, {x, 0.0, 0.0});
    const TrackProgress progress = EstimateProgress(run.segment, features);
    EXPECT_NEAR(progress.fraction, x / 2.0, 0.06) << "at " << x << " m";
  }
}

TEST(TrackProgress, SeesThatTheMilestoneHasBeenPassed) {
  const test::TaughtRun run = test::TeachArcs(kProgressScene, {}, {{2.0, 0.0}});
  const auto features = test::Matched(kProgressScene, run, {2.2, 0.0, 0.0});
  EXPECT_GT(EstimateProgress(run.segment, features).fraction, 1.05);
}

TEST(TrackProgress, AFewMismatchesDoNoHarm) {
  const test::TaughtRun run = test::TeachArcs(kProgressScene, {}, {{2.0, 0.0}});
  auto features = test::Matched(kProgressScene, run, {1.0, 0.0, 0.0});
  ASSERT_GE(features.size(), 12U);
  for (std::size_t i = 0; i < 3; ++i) features[i].u_px += 80.0;
  EXPECT_NEAR(EstimateProgress(run.segment, features).fraction, 0.5, 0.1);
}

}  // namespace
}  // namespace trailcast::replay
