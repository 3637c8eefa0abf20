#include "agent/device/recorded_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

TEST(RecordedDeviceTest, StampsFramesByTheRateAndEndsWithTheRecording) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 3);
  const auto device = RecordedDevice::Open({folder / "run", "", 10.0});
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ((*device)->camera(), "recorded 160x120");
  EXPECT_FALSE((*device)->has_odometry());
  for (int i = 0; i < 3; ++i) {
    const auto next = (*device)->Next();
    ASSERT_TRUE(next && *next);
    EXPECT_EQ((*next)->stamp, std::chrono::milliseconds(100 * i));
    EXPECT_EQ((*next)->image.pixels, test::WalkFrame(i).pixels);
    EXPECT_FALSE((*next)->odometry);
  }
  EXPECT_DOUBLE_EQ(*(*device)->drive_progress(), 1.0);
  const auto end = (*device)->Next();
  ASSERT_TRUE(end);
  EXPECT_FALSE(*end);
}

TEST(RecordedDeviceTest, GivesEachFrameItsOdometry) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 2);
  std::ofstream(folder / "odo.csv") << "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,3,0,0\n";
  const auto device = RecordedDevice::Open({folder / "run", folder / "odo.csv", 2.0});
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_DOUBLE_EQ((*(*device)->Next())->odometry->x_m, 0.0);
  EXPECT_DOUBLE_EQ((*(*device)->Next())->odometry->x_m, 1.5);
}

TEST(RecordedDeviceTest, FailsAtOpeningWhenFramesOrOdometryCannotBeRead) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 1);
  const auto no_frames = RecordedDevice::Open({folder / "none", "", std::nullopt});
  ASSERT_FALSE(no_frames);
  EXPECT_THAT(no_frames.error().message, HasSubstr("none"));
  const auto no_odometry =
      RecordedDevice::Open({folder / "run", folder / "none.csv", std::nullopt});
  ASSERT_FALSE(no_odometry);
  EXPECT_THAT(no_odometry.error().message, HasSubstr("none.csv"));
}

}  // namespace
}  // namespace trailcast::agent
