// Somebody takes a follower up and sets it down elsewhere, which its odometry does not feel.
#include <gtest/gtest.h>

#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

// It looks round for the path, and finds it; the end is not where it would have been.
TEST(CarriedTest, BackAndTurnedAwayItArrivesAtTheEndAllTheSame) {
  const sim::Place place = test::Open("indoor");
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(place, 4.0, camera, 11);
  agent::ReplayMethodOptions how;
  how.look_around_rad = 3.2;
  bool carried = false;
  const test::Ending ending = test::FollowIn(
      place, camera, taught, 31,
      [&](sim::Judge& truth, const agent::ReplayStep& step) {
        if (carried || step.along_m.value_or(0.0) < 3.5) return;
        truth.Shove({-1.2, 0.0, -1.6});
        carried = true;
      },
      how);
  EXPECT_TRUE(carried);
  EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
  const Eigen::Vector2d end = sim::PointAlong(place.path.points, 4.0);
  EXPECT_LT((motion::Position(ending.pose) - end).norm(), 0.25);
}

}  // namespace
}  // namespace trailcast::trial
