#include "services/replay/feature_view.h"

#include <gtest/gtest.h>

#include "services/replay/funnel_follower.h"
#include "services/replay/path_follower.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

// A segment of one feature, from 20 px to 60 px right of the middle.
route::Segment OneFeature() {
  route::Segment segment;
  route::Feature feature;
  feature.track = {{0.0F, 20.0F, 10.0F}, {1.0F, 60.0F, 30.0F}};
  segment.features = {feature};
  return segment;
}

FeatureVerdict VerdictAt(double u_px, double magnification = 1.0) {
  FunnelFollower follower(320, magnification);
  follower.Begin(OneFeature());
  return ViewFeatures(follower, {{0, u_px, 10.0}}, 0.0).at(0).verdict;
}

TEST(ViewFeatures, SaysWhatTheFunnelSaysOfEachFeature) {
  EXPECT_EQ(VerdictAt(30.0), FeatureVerdict::kInside);
  EXPECT_EQ(VerdictAt(80.0), FeatureVerdict::kAsksRight);
  EXPECT_EQ(VerdictAt(-10.0), FeatureVerdict::kAsksLeft);
}

TEST(ViewFeatures, ComparesInTheFollowersPixels) {
  EXPECT_EQ(VerdictAt(80.0, 2.0), FeatureVerdict::kInside);
  EXPECT_EQ(VerdictAt(130.0, 2.0), FeatureVerdict::kAsksRight);
}

TEST(ViewFeatures, RejectsWhatTheMethodDoesNotBelieve) {
  const auto scene = test::LandmarkScene::Corridor(5.0, 16.0, 80, 5);
  const auto run = test::TeachArcs(scene, {}, {{2.0, 0.0}});
  PathFollower follower(320, 1.0);
  follower.Begin(run.segment);
  auto seen = test::Matched(scene, run, {});
  ASSERT_GE(seen.size(), 10U);
  seen[3].u_px += 40.0;
  const FollowStep step = follower.Step({seen, motion::OdometryIncrement{}});
  EXPECT_EQ(step.rejected, 1);
  EXPECT_NEAR(step.rejected_by_px, 40.0, 5.0);
  const auto views = ViewFeatures(follower, seen, step.roll_rad);
  ASSERT_EQ(views.size(), seen.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].verdict == FeatureVerdict::kRejected, i == 3) << i;
  }
}

TEST(ViewFeatures, KnowsWhereTheMilestoneWillBeForACameraMountedAskew) {
  const auto scene = test::LandmarkScene::Corridor(5.0, 16.0, 80, 5);
  const auto run = test::TeachArcs(scene, {}, {{2.0, 0.0}});
  constexpr double kYaw_rad = 0.05;
  PathFollower follower(320, 1.0);
  follower.Begin(run.segment);
  motion::Pose2 robot;
  std::vector<route::TrackedFeature> seen;
  for (int i = 0; i < 150; ++i) {
    const double moved_m = i == 0 ? 0.0 : 0.01;
    robot = motion::Advance(robot, {moved_m, 0.0});
    seen = test::Matched(scene, run, motion::Compose(robot, {0.0, 0.0, kYaw_rad}));
    static_cast<void>(follower.Step({seen, motion::OdometryIncrement{moved_m, 0.0}}));
  }
  const auto at_end = test::Matched(scene, run, {2.0, 0.0, kYaw_rad});
  double apart_px = 0.0;
  int common = 0;
  for (const FeatureView& view : ViewFeatures(follower, seen, 0.0)) {
    for (const auto& there : at_end) {
      if (there.id != view.at.id) continue;
      apart_px += std::abs(there.u_px - view.milestone.u_px);
      ++common;
    }
  }
  ASSERT_GT(common, 5);
  EXPECT_LT(apart_px / common, 5.0) << "a yaw of 14 px is in it";
}

}  // namespace
}  // namespace trailcast::replay
