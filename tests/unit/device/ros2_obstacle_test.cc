// How a ROS 2 robot's device lets the robot stand before what its scanner and range sensors see.
#include "agent/device/ros2_device.h"
#include "tests/unit/device/ros2_device_fixture.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;

TEST_F(Ros2DeviceTest, StandsBeforeWhatItScansAndGoesOnWhenThatIsGone) {
  run_.patience = milliseconds(2500);
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  auto next = Next();
  for (milliseconds passed{0}; passed < 2 * run_.patience; passed += kCameraFrame) {
    GoOn(0.0);
    SayScan(0.55F);
    Say();
    ASSERT_EQ(robot_.told(), kRos2Stand) << passed.count();
  }
  ASSERT_FALSE(IsThere(next)) << "it waits, and no less";
  const auto seen = Until(next, [this] { SayAll(std::nullopt); });
  ASSERT_TRUE(seen) << seen.error().message;
  ExpectToldThatItWaited();
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, DrivenByHandItStandsBeforeWhatItScansAndIsDrivenAwayFromThere) {
  OpenWithAScanner();
  device_->ByHand(true);
  // Frames come all the while, each with what its driver says.
  const auto drive = [this](const motion::VelocityCommand& word, std::optional<float> range_m) {
    const auto seen = SeeAll(range_m);
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(device_->Drive(word));
  };
  const auto drive_until = [&](const motion::VelocityCommand& word, std::optional<float> range_m,
                               const auto& wanted) {
    constexpr int kFrames = 60;
    for (int frame = 0; frame < kFrames; ++frame) {
      drive(word, range_m);
      if (wanted(robot_.told())) return true;
    }
    return false;
  };
  const motion::VelocityCommand straight{0.4, 0.0};
  const auto ahead = [&](const motion::VelocityCommand& told) { return told == straight; };
  const auto stands = [](const motion::VelocityCommand& told) { return told == kRos2Stand; };
  ASSERT_TRUE(drive_until(straight, std::nullopt, ahead));
  ASSERT_TRUE(drive_until(straight, 0.55F, stands));
  for (int frame = 0; frame < 20; ++frame) {
    drive(straight, 0.55F);
    EXPECT_TRUE(stands(robot_.told()));
  }
  ASSERT_FALSE(told_.empty());
  EXPECT_EQ(told_.back().what, "something stands 0.3 m ahead, in the way: the robot waits");
  EXPECT_FALSE(told_.back().fault);
  ASSERT_TRUE(
      drive_until({-0.1, 0.0}, 0.55F, [](const auto& told) { return told.linear_mps < 0; }));
  ASSERT_TRUE(drive_until(straight, 0.55F, stands)) << "and ahead once more";
  ASSERT_TRUE(
      drive_until({0.0, 0.5}, 0.55F, [](const auto& told) { return told.angular_radps > 0; }));
  ASSERT_TRUE(drive_until(straight, 0.55F, stands));
  ASSERT_TRUE(drive_until(straight, std::nullopt, ahead)) << "it is gone";
  EXPECT_EQ(told_.back().what, "");
}

TEST_F(Ros2DeviceTest, SlowsDownByAScanThatComesBetweenTwoPictures) {
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  SayScan(0.75F);
  EXPECT_GT(robot_.told().linear_mps, 0.05);
  EXPECT_LT(robot_.told().linear_mps, 0.35);
}

TEST_F(Ros2DeviceTest, StandsBeforeWhatARangeSensorSeesAndGoesOnWhenThatIsGone) {
  run_.topics.ranges = {"sonar"};
  Open();
  ASSERT_TRUE(SeeAll(std::nullopt));
  ASSERT_TRUE(DrivesAhead());
  SayRange(0.28F);
  EXPECT_EQ(robot_.told(), kRos2Stand);
  auto next = Next();
  ASSERT_TRUE(Until(next, [this] { SayAll(std::nullopt); }));
  ExpectToldThatItWaited();
}

// A robot in lockstep goes no further before each of its frames is answered.
TEST_F(Ros2DeviceTest, InLockstepItAnswersEachFrameWhileItWaits) {
  run_.lockstep = true;
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(robot_.latest().stamp, stamp_);
  auto next = Next();
  for (int frame = 0; frame < 5; ++frame) {
    GoOn(0.0);
    SayScan(0.55F);
    Say();
    ASSERT_EQ(robot_.latest().stamp, stamp_);
    ASSERT_EQ(robot_.told(), kRos2Stand);
  }
  // Its half a second is that of the robot's stamps.
  const SensorTime free_from = stamp_ + kCameraFrame;
  int answered = 0;
  const auto seen = Until(next, [&] {
    GoOn(0.0);
    SayScan(std::nullopt);
    Say();
    answered += robot_.latest().stamp == stamp_ && robot_.told() == kRos2Stand ? 1 : 0;
  });
  ASSERT_TRUE(seen);
  EXPECT_GE((*seen)->stamp - free_from, milliseconds(500));
  EXPECT_LE((*seen)->stamp - free_from, milliseconds(600));
  EXPECT_GE(answered, 15);
}

}  // namespace
}  // namespace trailcast::agent
