// Routes that were taught driving forwards, backed along from their ends.
#include <gtest/gtest.h>

#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

// By a robot with another camera than the scout's.
TEST(BackingTest, FromItsEndARouteIsBackedAlongToItsBeginning) {
  constexpr double kLength_m = 2.0;
  const sim::Place place = test::Open("indoor");
  const Taught taught = test::TeachIn(place, kLength_m, *sim::FindCamera("webcam"), 11);
  test::Outset backwards;
  backwards.start = sim::PoseAlong(place.path.points, kLength_m, 0.1);
  backwards.backwards = true;
  double beside_m = 0.0;
  const test::Ending ending = test::FollowIn(
      place, *sim::FindCamera("firewire"), taught, 31,
      [&](const sim::Judge& truth, const agent::ReplayStep& step) {
        EXPECT_LE(step.command.linear_mps, 0.0);
        const auto at = motion::Position(truth.true_pose());
        beside_m = std::max(beside_m, sim::Nearest(place.path.points, at).distance_m);
      },
      {}, backwards);
  EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
  EXPECT_LT((motion::Position(ending.pose) - place.path.points.front()).norm(), 0.25);
  EXPECT_LT(beside_m, 0.15);
}

}  // namespace
}  // namespace trailcast::trial
