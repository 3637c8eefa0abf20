#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "services/base/angles.h"
#include "services/replay/path_follower.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

const test::LandmarkScene kScene = test::LandmarkScene::Corridor(4.0, 16.0, 90, 5);

TEST(PathFollower, TurnsOnTheSpotBeforeASegmentThatAsksForIt) {
  for (const double turn_rad : {1.2, -0.7}) {
    auto run = test::TeachArcs(kScene, {}, {{2.0, 0.0}});
    run.segment.turn_before_rad = turn_rad;
    PathFollower follower(320, 1.0);
    follower.Begin(run.segment);
    ASSERT_TRUE(follower.turning());
    double heading_rad = 0.0;
    double turned_rad = 0.0;
    for (int frame = 0; frame < 300 && follower.turning(); ++frame) {
      const FollowStep step = follower.Step({{}, motion::OdometryIncrement{0.0, turned_rad}});
      EXPECT_EQ(step.command.linear_mps, 0.0);
      EXPECT_FALSE(step.ended);
      turned_rad = step.command.angular_radps / 30.0;
      heading_rad += turned_rad;
    }
    EXPECT_FALSE(follower.turning());
    EXPECT_NEAR(heading_rad, turn_rad, 0.06);
    EXPECT_GT(follower.Step({{}, motion::OdometryIncrement{}}).command.linear_mps, 0.0);
  }
}

// A robot that stands beyond the end of what it drove, or beside it, is behind or on the other side
// of what it drives back.
TEST(PathEstimator, ATurnOnTheSpotTurnsWhereTheRobotIs) {
  auto run = test::TeachArcs(kScene, {}, {{2.0, 0.0}});
  PathEstimator estimator(320, 1.0);
  estimator.Begin(run.segment);
  estimator.Predict({2.0, 0.1});  // ends 0.1 m to the left of the path
  estimator.Predict({0.2, -0.1});
  const PathOffset before = estimator.offset();
  estimator.Begin(run.segment);
  estimator.TurnPath(Radians(180.0));
  EXPECT_NEAR(estimator.offset().along_m, 2.0 - before.along_m, 1e-6);
  EXPECT_NEAR(estimator.offset().left_m, -before.left_m, 1e-6);
  EXPECT_NEAR(estimator.offset().heading_rad, before.heading_rad - Radians(180.0), 1e-6);
  estimator.TurnPath(Radians(-90.0));
  EXPECT_NEAR(estimator.offset().along_m, before.left_m, 1e-6);
  EXPECT_NEAR(estimator.offset().left_m, 2.0 - before.along_m, 1e-6);
}

TEST(PathFollower, DoesNotTurnWhereItIsPutIntoTheMiddleOfASegment) {
  auto run = test::TeachArcs(kScene, {}, {{2.0, 0.0}});
  run.segment.turn_before_rad = 1.2;
  PathFollower follower(320, 1.0);
  follower.BeginAt(run.segment, 0.5);
  EXPECT_FALSE(follower.turning());
}

}  // namespace
}  // namespace trailcast::replay
