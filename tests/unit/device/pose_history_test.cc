#include "agent/device/pose_history.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;

TEST(PoseHistory, GivesThePoseBetweenTwoSamples) {
  PoseHistory history;
  history.Add(milliseconds(0), {0.0, 0.0, 3.1});
  history.Add(milliseconds(100), {1.0, 2.0, -3.1});
  const motion::Pose2 pose = history.At(milliseconds(25));
  EXPECT_DOUBLE_EQ(pose.x_m, 0.25);
  EXPECT_DOUBLE_EQ(pose.y_m, 0.5);
  EXPECT_NEAR(pose.heading_rad, 3.1208, 1e-4) << "turns the shorter way";
}

TEST(PoseHistory, OutsideOfItsSamplesTheNearestHolds) {
  PoseHistory history;
  history.Add(milliseconds(50), {1.0, 0.0, 0.0});
  history.Add(milliseconds(100), {2.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(history.At(milliseconds(0)).x_m, 1.0);
  EXPECT_DOUBLE_EQ(history.At(milliseconds(500)).x_m, 2.0);
}

TEST(PoseHistory, LeavesOutWhatIsNotNewer) {
  PoseHistory history;
  history.Add(milliseconds(100), {1.0, 0.0, 0.0});
  history.Add(milliseconds(100), {5.0, 0.0, 0.0});
  history.Add(milliseconds(50), {6.0, 0.0, 0.0});
  EXPECT_EQ(history.newest(), milliseconds(100));
  EXPECT_DOUBLE_EQ(history.At(milliseconds(100)).x_m, 1.0);
}

TEST(PoseHistory, ForgetsWhatIsLongAgo) {
  PoseHistory history;
  history.Add(milliseconds(0), {1.0, 0.0, 0.0});
  history.Add(milliseconds(3000), {2.0, 0.0, 0.0});
  history.Add(milliseconds(3100), {3.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(history.At(milliseconds(0)).x_m, 2.0);
}

}  // namespace
}  // namespace trailcast::agent
