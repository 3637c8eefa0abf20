#include "services/lab/simulated/robot_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = RobotFault::Kind;

TEST(RobotFault, IsAWordATimeAndMaybeHowLong) {
  const auto for_good = ParseRobotFault("camera-freezes@12.5");
  ASSERT_TRUE(for_good);
  EXPECT_EQ(for_good->kind, Kind::kCameraFreezes);
  EXPECT_EQ(for_good->spell.after_s, 12.5);
  EXPECT_GT(for_good->spell.for_s, 1e9);
  const auto short_stop = ParseRobotFault("base-stops@4+0.3");
  ASSERT_TRUE(short_stop);
  EXPECT_EQ(short_stop->kind, Kind::kBaseStops);
  EXPECT_EQ(short_stop->spell.for_s, 0.3);
}

TEST(RobotFault, OneThatIsNotUnderstoodNamesAllThereAre) {
  for (const char* text : {"camera-burns@3", "base-stops", "base-stops@", "base-stops@-1",
                           "base-stops@1+", "base-stops@1+x", "base-stops@nan", "@1", ""}) {
    const auto fault = ParseRobotFault(text);
    ASSERT_FALSE(fault) << text;
    EXPECT_THAT(fault.error().message, HasSubstr("expected one of camera-freezes"));
    EXPECT_THAT(fault.error().message, HasSubstr("wheel-slips"));
  }
}

TEST(RobotFaults, BeginOnceTheRobotDrivesAndAreOver) {
  RobotFaults faults({{Kind::kBaseStops, {2.0, 1.0}}, {Kind::kOdometryJumps, {2.5}}});
  const RobotFaults::Time start{std::chrono::seconds(100)};
  EXPECT_THAT(faults.Advance(start + std::chrono::seconds(50)), IsEmpty()) << "it has not driven";
  faults.DroveAt(start);
  faults.DroveAt(start + std::chrono::seconds(10));  // the first time counts
  EXPECT_THAT(faults.Advance(start + milliseconds(1990)), IsEmpty());
  EXPECT_FALSE(faults.active(Kind::kBaseStops));
  EXPECT_THAT(faults.Advance(start + milliseconds(2010)), ElementsAre("base-stops"));
  EXPECT_TRUE(faults.active(Kind::kBaseStops));
  EXPECT_EQ(faults.first_began_at(), start + milliseconds(2010));
  EXPECT_THAT(faults.Advance(start + milliseconds(2600)), ElementsAre("odometry-jumps"));
  EXPECT_THAT(faults.Advance(start + milliseconds(3010)), IsEmpty());
  EXPECT_FALSE(faults.active(Kind::kBaseStops));
  EXPECT_TRUE(faults.active(Kind::kOdometryJumps));
}

}  // namespace
}  // namespace trailcast::agent
