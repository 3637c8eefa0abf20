// A field whose rows look alike: a robot in another row than the one that was taught does not take
// it for that one.
#include <gtest/gtest.h>

#include "services/lab/sim/places/src/rows.h"
#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

class RowsTest : public testing::Test {
 protected:
  static constexpr double kTaught_m = 14.0;

  // Sets a robot with the other camera down in the aisle so many rows further to the left, where it
  // is told no place.
  [[nodiscard]] test::Ending SetDown(int rows, double along_m, std::uint64_t seed,
                                     const test::Bystander& bystander) const {
    const auto& beginning = place_.path.points.front();
    test::Outset outset;
    outset.start =
        motion::Pose2{beginning.x() + along_m, beginning.y() + rows * sim::kRowSpacing_m, 0.0};
    return test::FollowIn(place_, *sim::FindCamera("firewire"), taught_, seed, bystander,
                          {.anywhere = true}, outset);
  }

  const sim::Place place_ = test::Open("rows");
  const Taught taught_ = test::TeachIn(place_, kTaught_m, *sim::FindCamera("webcam"), 5);
};

TEST_F(RowsTest, ARobotInTheTaughtRowFindsItself) {
  const test::Ending ending =
      SetDown(0, 4.0, 31, [](const sim::Judge&, const agent::ReplayStep&) {});
  EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
  const auto end_m = sim::PointAlong(place_.path.points, kTaught_m);
  EXPECT_LT((motion::Position(ending.pose) - end_m).norm(), 0.3);
}

TEST_F(RowsTest, ARobotInAnotherRowDoesNotFollow) {
  for (const int rows : {1, -2, 6}) {
    int followed = 0;
    const test::Ending ending =
        SetDown(rows, 4.0, 32, [&](const sim::Judge&, const agent::ReplayStep& step) {
          followed += step.state == agent::ReplayState::kFollowing ? 1 : 0;
        });
    EXPECT_EQ(followed, 0) << rows << " rows away";
    EXPECT_NE(ending.last.state, agent::ReplayState::kArrived) << rows << " rows away";
  }
}

}  // namespace
}  // namespace trailcast::trial
