#include "services/lab/sim/core/actor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

TEST(Timetable, NobodyIsThereBeforeAndAfter) {
  Timetable table(2.0, {0.0, 0.0, 0.0});
  table.GoTo({3.0, 0.0}, 1.5);
  EXPECT_FALSE(table.At(1.99));
  EXPECT_TRUE(table.At(2.0));
  EXPECT_TRUE(table.At(4.0));
  EXPECT_FALSE(table.At(4.01));
}

TEST(Timetable, WalksAtItsPaceAndLooksWhereItGoes) {
  Timetable table(0.0, {1.0, 1.0, Radians(90.0)});
  table.GoTo({1.0, 5.0}, 2.0);
  const auto half_way = table.At(1.0);
  ASSERT_TRUE(half_way);
  EXPECT_NEAR(half_way->pose.y_m, 3.0, 1e-9);
  EXPECT_NEAR(half_way->pose.heading_rad, Radians(90.0), 1e-9);
  EXPECT_NEAR(half_way->velocity_mps.y(), 2.0, 1e-9);
  EXPECT_NEAR(half_way->walked_m, 2.0, 1e-9);
}

TEST(Timetable, TurnsOnTheSpotBeforeASharpCornerAndBendsOnTheWayRoundASlightOne) {
  Timetable sharp(0.0, {0.0, 0.0, 0.0});
  sharp.GoTo({1.0, 0.0}, 1.0).GoTo({1.0, 1.0}, 1.0);
  EXPECT_GT(sharp.until_s(), 2.1);
  EXPECT_EQ(sharp.At(1.1)->velocity_mps.norm(), 0.0);
  Timetable slight(0.0, {0.0, 0.0, 0.0});
  slight.GoTo({1.0, 0.0}, 1.0).GoTo({1.98, 0.199}, 1.0);
  EXPECT_NEAR(slight.until_s(), 2.0, 1e-3);
}

TEST(Timetable, OneThatIsNowhereElseStandsStill) {
  Timetable table(1.0, {4.0, 2.0, 0.3});
  table.Stand(10.0);
  EXPECT_EQ(table.At(8.0)->pose.x_m, 4.0);
  EXPECT_EQ(table.At(8.0)->walked_m, 0.0);
}

class MeetingARobotOnTheXAxis : public ::testing::Test {
 protected:
  static Timetable Meet(double left_m, double right_m) {
    Encounter encounter;
    encounter.place = {5.0, 0.0};
    return TimetableOf(encounter, {0.0, left_m, right_m}, 20.0);
  }
};

TEST_F(MeetingARobotOnTheXAxis, StandsThereFacingItForTenSeconds) {
  const Timetable table = Meet(3.0, 3.0);
  const double there_s = 20.0 + StepInDuration({0.0, 3.0, 3.0});
  for (const double after_s : {0.5, 5.0, 9.9}) {
    const auto state = table.At(there_s + after_s);
    ASSERT_TRUE(state);
    EXPECT_NEAR(state->pose.x_m, 5.0, 1e-6);
    EXPECT_NEAR(state->pose.y_m, 0.0, 1e-6);
    EXPECT_NEAR(std::cos(state->pose.heading_rad), -1.0, 1e-6) << after_s;
  }
  EXPECT_GT(std::abs(table.At(there_s + 12.0)->pose.y_m), 0.5);
}

TEST_F(MeetingARobotOnTheXAxis, ComesAndGoesOnTheSideWithRoom) {
  EXPECT_GT(Meet(2.0, 0.3).At(20.0)->pose.y_m, 0.5);
  EXPECT_LT(Meet(0.3, 2.0).At(20.0)->pose.y_m, -0.5);
  const Timetable table = Meet(2.0, 0.3);
  EXPECT_LT(table.At(table.until_s())->pose.x_m, 2.0);  // past the robot
}

}  // namespace
}  // namespace trailcast::sim
