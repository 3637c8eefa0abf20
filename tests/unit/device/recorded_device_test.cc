#include "agent/device/recorded_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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

TEST(RecordedDeviceTest, FramesOfTheirOwnTimesHaveTheOdometryOfThen) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 3);
  std::ofstream(folder / "odo.csv")
      << "t_s,x_m,y_m,heading_rad\n1700000000,0,0,0\n1700000010,5,0,0\n";
  std::ofstream(folder / "times.csv") << "name,t_s\n1,1700000001\n2,1700000001.5\n3,1700000004\n";
  const RecordedRun run{folder / "run", folder / "odo.csv", std::nullopt, folder / "times.csv"};
  const auto device = RecordedDevice::Open(run);
  ASSERT_TRUE(device) << device.error().message;
  for (const double metres : {0.5, 0.75, 2.0}) {
    const auto next = (*device)->Next();
    ASSERT_TRUE(next && *next);
    EXPECT_NEAR((*next)->odometry->x_m, metres, 1e-6);
  }
  const auto end = (*device)->Next();
  EXPECT_TRUE(end && !*end);
}

TEST(RecordedDeviceTest, FramesAfterOneThatCannotBeReadKeepTheirTimes) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 4);
  std::vector<std::filesystem::path> pictures(std::filesystem::directory_iterator(folder / "run"),
                                              {});
  std::sort(pictures.begin(), pictures.end());
  for (const int damaged : {0, 2}) {
    std::filesystem::resize_file(pictures.at(static_cast<std::size_t>(damaged)), 9);
  }
  const auto device = RecordedDevice::Open({folder / "run", "", 10.0});
  ASSERT_TRUE(device) << device.error().message;
  for (const int i : {1, 3}) {
    const auto next = (*device)->Next();
    ASSERT_TRUE(next && *next) << i;
    EXPECT_EQ((*next)->stamp, std::chrono::milliseconds(100 * i));
    EXPECT_EQ((*next)->image.pixels, test::WalkFrame(i).pixels);
    EXPECT_EQ((*device)->frame(), i);
  }
  const auto end = (*device)->Next();
  EXPECT_TRUE(end && !*end);
}

TEST(RecordedDeviceTest, ARunOfWhichNothingCanBeReadIsRefusedAndSaysWhy) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 2);
  for (const auto& picture : std::filesystem::directory_iterator(folder / "run")) {
    std::filesystem::resize_file(picture, 0);
  }
  const auto device = RecordedDevice::Open({folder / "run", "", 10.0});
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message, HasSubstr("2 of 2 pictures cannot be read"));
}

TEST(RecordedDeviceTest, TimesThatDoNotFitTheFramesAreRefused) {
  const test::TempDir folder;
  test::WriteWalk(folder / "run", 3);
  const auto error_of = [&](const std::string& times) {
    std::ofstream(folder / "times.csv") << times;
    const auto device = RecordedDevice::Open({folder / "run", "", {}, folder / "times.csv"});
    return device ? "no error" : device.error().message;
  };
  EXPECT_THAT(error_of("t_s\n1\n2\n"), HasSubstr("2 times for 3 frames"));
  EXPECT_THAT(error_of("t_s\n1\n2\n2\n"), HasSubstr("line 4"));
  EXPECT_THAT(error_of("t_s\n1\n2\n1e30\n"), HasSubstr("no time of any clock"));
  EXPECT_THAT(error_of("seconds\n1\n"), HasSubstr("t_s"));
}

TEST(RecordedDeviceTest, ARecordingOfTopicsIsNoFolderOfFrames) {
  const auto device = RecordedDevice::Open({"drive.mcap", "", std::nullopt});
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message, HasSubstr("--bag"));
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
