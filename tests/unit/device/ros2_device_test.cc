// A ROS 2 robot on the loopback interface, of which the test says what it senses, and when.
#include "agent/device/ros2_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "tests/support/await.h"
#include "tests/support/unique_tag.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

constexpr milliseconds kCameraFrame{33};
const motion::VelocityCommand kRos2Ahead{0.4, 0.1};
const motion::VelocityCommand kStand{};

class Ros2DeviceTest : public testing::Test {
 protected:
  Ros2DeviceTest() {
    run_.topics.robot = "/robot1";
    run_.topics.discovery_tag = test::UniqueTag();
    run_.topics.network_interface = "lo";
    run_.patience = test::kLongEnough;
    run_.limits.acceleration_mps2 = 1000.0;
  }

  void Open() {
    device_ = Ros2Device::Open(run_).value();
    dds::Ros2Options topics = run_.topics;
    if (topics.odometry.empty()) topics.odometry = "odom";  // which the device does not hear
    robot_ = dds::Ros2Robot::Open(topics).value();
    device_->OnTrouble([this](const RobotDevice::Halt& halt) { told_.push_back(halt); });
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (!robot_->watched() && steady_clock::now() < deadline)
      (void)robot_->Take(milliseconds(5));
    ASSERT_TRUE(robot_->watched());
  }

  void SayOdometry() {
    ASSERT_TRUE(robot_->Publish(dds::Ros2Odometry{stamp_ - odometry_lag_, pose_}));
  }
  void Say(bool with_odometry = true) {
    if (with_odometry) SayOdometry();
    const image::GrayImage picture = test::WalkFrame(frame_);
    const dds::Ros2Image image{.stamp = stamp_,
                               .width_px = static_cast<std::uint32_t>(picture.width),
                               .height_px = static_cast<std::uint32_t>(picture.height),
                               .encoding = "mono8",
                               .step = static_cast<std::uint32_t>(picture.width),
                               .data = picture.pixels};
    ASSERT_TRUE(robot_->Publish(image));
  }
  // A scanner's look, with something so far ahead of it, and nothing else.
  void SayScan(std::optional<float> range_m) {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(robot_->Publish(dds::Ros2Scan{
        stamp_,
        {-0.03,
         0.02,
         0.1,
         10.0,
         {kNothing, range_m.value_or(kNothing), range_m.value_or(kNothing), kNothing}}}));
  }
  void SayRange(std::optional<float> range_m) {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(
        robot_->Publish(dds::Ros2Range{stamp_, 0, {0.1, 0.02, 4.0, range_m.value_or(kNothing)}}));
  }
  // Says something again and again until that is there.
  template <typename Value>
  static void Until(std::future<Value>& next, const std::function<void()>& say,
                    milliseconds every = milliseconds(20)) {
    test::Await(
        [&] {
          if (next.wait_for(every) == std::future_status::ready) return true;
          say();
          return false;
        },
        "what the device makes of it");
  }
  // All of it, until `next` has a frame.
  Result<std::optional<Observation>> SayAllUntil(
      std::future<Result<std::optional<Observation>>>& next, std::optional<float> range_m) {
    Until(next, [&] {
      GoOn();
      if (!run_.topics.scan.empty()) SayScan(range_m);
      if (!run_.topics.ranges.empty()) SayRange(range_m);
      Say();
    });
    return next.get();
  }
  // Lying so far uphill.
  void SayImu(double climb_rad) {
    dds::Ros2Imu imu{stamp_, {}};
    imu.felt.attitude =
        motion::Attitude{0.0, -std::sin(climb_rad / 2.0), 0.0, std::cos(climb_rad / 2.0)};
    ASSERT_TRUE(robot_->Publish(imu));
  }
  void OpenWithAScanner() {
    run_.topics.scan = "scan";
    Open();
    auto next = std::async(std::launch::async, [this] { return device_->Next(); });
    ASSERT_TRUE(SayAllUntil(next, std::nullopt));
  }
  // A frame later and further.
  void GoOn(double metres = 0.01) {
    stamp_ += kCameraFrame;
    pose_.x_m += metres;
    ++frame_;
  }
  // Says it again until the device has it: samples to a reader that is just being matched get lost.
  Result<std::optional<Observation>> SayUntilSeen(bool with_odometry = true) {
    auto next = std::async(std::launch::async, [this] { return device_->Next(); });
    Until(next, [&] { Say(with_odometry); });
    return next.get();
  }
  // At thirty frames a second.
  void ExpectFramesAtFullRate() {
    auto next = std::async(std::launch::async, [this] {
      Result<std::optional<Observation>> seen = device_->Next();
      for (int i = 0; seen && i < 5; ++i) seen = device_->Next();
      return seen;
    });
    Until(
        next,
        [&] {
          GoOn();
          Say();
        },
        kCameraFrame);
    const auto seen = next.get();
    ASSERT_TRUE(seen) << seen.error().message;
    EXPECT_TRUE((*seen)->odometry);
  }
  // Until the robot is told that; false if it is not.
  bool Told(const motion::VelocityCommand& command, milliseconds bound = test::kLongEnough) {
    const auto deadline = steady_clock::now() + bound;
    while (steady_clock::now() < deadline) {
      const auto heard = robot_->Take(milliseconds(5));
      if (heard) latest_ = *heard;
      if (heard && heard->velocity == command) return true;
    }
    return false;
  }
  // The robot is told to. Where a busy machine let the frame grow old before, with another one.
  bool DrivesAhead() {
    for (int time = 0; time < 10; ++time) {
      if (!device_->Drive(kRos2Ahead)) return false;
      if (Told(kRos2Ahead, milliseconds(1000))) return true;
      auto next = std::async(std::launch::async, [this] { return device_->Next(); });
      if (!SayAllUntil(next, std::nullopt)) return false;
    }
    return false;
  }

  // The odometry goes on, so that the camera alone is what is missed.
  bool ToldToStandWithoutPictures() {
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < deadline) {
      GoOn();
      SayOdometry();
      if (Told(kStand, milliseconds(20))) return true;
    }
    return false;
  }

  // And that this is over.
  void ExpectToldThatItWaited() {
    const auto waits = std::find_if(told_.begin(), told_.end(), [](const RobotDevice::Halt& halt) {
      return halt.what == "something stands 0.3 m ahead, in the way: the robot waits";
    });
    ASSERT_NE(waits, told_.end());
    EXPECT_FALSE(waits->fault);
    EXPECT_EQ(told_.back().what, "");
  }

  // For tests of what happens then.
  static constexpr milliseconds kSoonTired{1500};
  Ros2Run run_;
  std::unique_ptr<Ros2Device> device_;
  std::unique_ptr<dds::Ros2Robot> robot_;
  std::vector<RobotDevice::Halt> told_;
  dds::Ros2Command latest_;
  SensorTime stamp_ = std::chrono::seconds(1'700'000'000) + milliseconds(250);
  std::chrono::nanoseconds odometry_lag_{0};
  motion::Pose2 pose_{3.0, -2.0, 2.5};
  int frame_ = 0;
};

TEST_F(Ros2DeviceTest, AFrameComesWithWhatTheImuSaidSinceTheOneBefore) {
  run_.topics.imu = "imu";
  Open();
  std::size_t felt = 0;
  const auto deadline = steady_clock::now() + test::kLongEnough;
  while (felt == 0 && steady_clock::now() < deadline) {
    auto next = std::async(std::launch::async, [this] { return device_->Next(); });
    Until(next, [&] {
      GoOn();
      for (int i = 0; i < 4; ++i) SayImu(0.1);
      Say();
    });
    const auto seen = next.get();
    ASSERT_TRUE(seen) << seen.error().message;
    felt = (*seen)->imu.size();
    if (felt > 0) {
      EXPECT_NEAR(motion::Climb((*seen)->imu.front().attitude.value()).value(), 0.1, 1e-9);
    }
  }
  EXPECT_GT(felt, 0U);
}

TEST_F(Ros2DeviceTest, GivesWhatTheRobotSees) {
  Open();
  const auto seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ((*seen)->stamp, stamp_);
  EXPECT_EQ((*seen)->image.pixels, test::WalkFrame(0).pixels);
  ASSERT_TRUE((*seen)->odometry);
  EXPECT_NEAR((*seen)->odometry->x_m, 3.0, 1e-9);
  EXPECT_NEAR((*seen)->odometry->y_m, -2.0, 1e-9);
  EXPECT_NEAR((*seen)->odometry->heading_rad, 2.5, 1e-9);
  EXPECT_EQ(device_->camera(), "camera 160x120");
}

TEST_F(Ros2DeviceTest, GivesEachFrameOnceHoweverOftenItIsSaid) {
  Open();
  ASSERT_TRUE(SayUntilSeen());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  for (int i = 0; i < 5; ++i) {
    Say();
    EXPECT_EQ(next.wait_for(milliseconds(10)), std::future_status::timeout);
  }
  GoOn();
  Until(next, [&] { Say(); });
  EXPECT_EQ(next.get().value()->stamp, stamp_);
}

TEST_F(Ros2DeviceTest, InLockstepAnswersWithTheFramesStamp) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(latest_.stamp, stamp_);
}

// Which brakes at what is old by its own clock.
TEST_F(Ros2DeviceTest, StampsCommandsByTheBasesClock) {
  odometry_lag_ = std::chrono::hours(1);
  Open();
  ASSERT_TRUE(SayUntilSeen());
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(latest_.stamp, stamp_ - odometry_lag_);
}

TEST_F(Ros2DeviceTest, TakesTheNewestOdometryWhereItLagsBehindAFastCamera) {
  odometry_lag_ = milliseconds(100);
  Open();
  ExpectFramesAtFullRate();
}

TEST_F(Ros2DeviceTest, TakesTheNewestOdometryOfAnotherClock) {
  odometry_lag_ = std::chrono::hours(1);
  Open();
  ExpectFramesAtFullRate();
}

TEST_F(Ros2DeviceTest, OdometryThatIsOnlyRepeatedIsNone) {
  run_.patience = kSoonTired;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  auto next = std::async(std::launch::async, [this] {
    // The first ones come before it is noticed.
    Result<std::optional<Observation>> seen = device_->Next();
    while (seen) seen = device_->Next();
    return seen.error().message;
  });
  const SensorTime stands = stamp_;
  Until(next, [&] {
    GoOn(0.0);
    odometry_lag_ = stamp_ - stands;
    Say();
  });
  EXPECT_THAT(next.get(), HasSubstr("no odometry for 0.3 s: it comes, but its stamps do not"));
}

TEST_F(Ros2DeviceTest, ARobotWithoutOdometryIsDrivenByVisionAlone) {
  run_.topics.odometry = "";
  run_.still_at_end = milliseconds(100);
  const auto refused = Ros2Device::Open(run_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("of which there is none"));
  run_.still_at_end = milliseconds(0);
  Open();
  const auto seen = SayUntilSeen(false);
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_FALSE((*seen)->odometry);
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, ADamagedPictureIsLeftOut) {
  run_.topics.odometry = "";
  run_.patience = kSoonTired;
  Open();
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  Until(next, [&] {
    GoOn();
    ASSERT_TRUE(robot_->Publish(dds::Ros2Image{.stamp = stamp_,
                                               .width_px = 160,
                                               .height_px = 120,
                                               .encoding = "mono8",
                                               .step = 160,
                                               .data = {1, 2, 3}}));
  });
  const auto seen = next.get();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no picture could be read for 1.5 s"));
}

TEST_F(Ros2DeviceTest, WhatAnOldPictureLedToIsNotDone) {
  Open();
  ASSERT_TRUE(SayUntilSeen());
  ASSERT_TRUE(DrivesAhead());
  ASSERT_TRUE(Told(kStand));  // the loop that drives hangs
  ASSERT_TRUE(device_->Drive(kRos2Ahead));
  EXPECT_FALSE(Told(kRos2Ahead, milliseconds(200)));
}

TEST_F(Ros2DeviceTest, DrivesABaseThatListensToTwist) {
  run_.topics.command_type = dds::Ros2CommandType::kTwist;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenNobodyDrivesOnWithIt) {
  Open();
  ASSERT_TRUE(SayUntilSeen());
  const auto began = steady_clock::now();
  ASSERT_TRUE(DrivesAhead());
  // The camera goes on: what ends is that Next and Drive are called.
  bool stopped = false;
  while (!stopped && steady_clock::now() - began < test::kLongEnough) {
    GoOn();
    Say();
    stopped = Told(kStand, milliseconds(20));
  }
  EXPECT_TRUE(stopped);
  EXPECT_GE(steady_clock::now() - began, run_.sensor_timeout);
  EXPECT_TRUE(told_.empty()) << told_.front().what;
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenTheCameraIsSilentAndGoesOnWhenItIsBack) {
  Open();
  ASSERT_TRUE(SayUntilSeen());
  ASSERT_TRUE(DrivesAhead());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  ASSERT_TRUE(ToldToStandWithoutPictures());
  const SensorTime silent = stamp_;
  // Stamps go on: on a busy machine odometry that is only repeated would count as standing still.
  Until(next, [&] {
    GoOn();
    Say();
  });
  const auto seen = next.get();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_GT((*seen)->stamp, silent);
  ASSERT_FALSE(told_.empty());
  EXPECT_THAT(told_, Contains(AllOf(Field(&RobotDevice::Halt::what,
                                          HasSubstr("camera /robot1/image_raw: no picture")),
                                    Field(&RobotDevice::Halt::fault, true))));
  EXPECT_EQ(told_.back().what, "");
}

TEST_F(Ros2DeviceTest, GivesUpWhenTheCameraStaysSilent) {
  run_.patience = kSoonTired;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  Until(next, [&] {
    GoOn();
    SayOdometry();
  });
  const auto seen = next.get();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message,
              AllOf(HasSubstr("camera /robot1/image_raw: no picture for 0.3 s"),
                    HasSubstr("not within 1.5 s")));
}

TEST_F(Ros2DeviceTest, StandsBeforeWhatItScansAndGoesOnWhenThatIsGone) {
  run_.patience = milliseconds(2500);
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  const auto until = steady_clock::now() + 2 * run_.patience;
  bool stood = false;
  while (steady_clock::now() < until) {
    GoOn(0.0);
    SayScan(0.55F);
    Say();
    const auto heard = robot_->Take(milliseconds(20));
    stood = stood || (heard && heard->velocity == kStand);
    ASSERT_FALSE(stood && heard && heard->velocity != kStand);
  }
  EXPECT_TRUE(stood);
  ASSERT_NE(next.wait_for(milliseconds(0)), std::future_status::ready) << "it waits, and no less";
  const auto seen = SayAllUntil(next, std::nullopt);
  ASSERT_TRUE(seen) << seen.error().message;
  ExpectToldThatItWaited();
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, DrivenByHandItStandsBeforeWhatItScansAndIsDrivenAwayFromThere) {
  run_.patience = milliseconds(2500);
  OpenWithAScanner();
  device_->ByHand(true);
  // Frames come all the while, each with what its driver says.
  const auto drive = [this](const motion::VelocityCommand& word, std::optional<float> range_m) {
    auto next = std::async(std::launch::async, [this] { return device_->Next(); });
    const auto seen = SayAllUntil(next, range_m);
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(device_->Drive(word));
  };
  const auto drive_until = [&](const motion::VelocityCommand& word, std::optional<float> range_m,
                               const auto& wanted) {
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < deadline) {
      drive(word, range_m);
      const auto heard = robot_->Take(milliseconds(5));
      if (heard && wanted(heard->velocity)) return true;
    }
    return false;
  };
  const motion::VelocityCommand straight{0.4, 0.0};
  const auto ahead = [&](const motion::VelocityCommand& told) { return told == straight; };
  const auto stands = [](const motion::VelocityCommand& told) { return told == kStand; };
  ASSERT_TRUE(drive_until(straight, std::nullopt, ahead));
  ASSERT_TRUE(drive_until(straight, 0.55F, stands));
  for (int frame = 0; frame < 20; ++frame) {
    drive(straight, 0.55F);
    const auto heard = robot_->Take(milliseconds(0));
    EXPECT_TRUE(!heard || stands(heard->velocity));
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
  const auto deadline = steady_clock::now() + test::kLongEnough;
  double told_mps = 0.0;
  while (told_mps == 0.0 && steady_clock::now() < deadline) {  // 0: the picture was too old by then
    ASSERT_TRUE(DrivesAhead());
    SayScan(0.75F);
    std::optional<dds::Ros2Command> heard;
    while (!heard && steady_clock::now() < deadline) heard = robot_->Take(milliseconds(5));
    ASSERT_TRUE(heard);
    told_mps = heard->velocity.linear_mps;
  }
  EXPECT_GT(told_mps, 0.05);
  EXPECT_LT(told_mps, 0.35);
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenTheScannerIsSilent) {
  run_.patience = kSoonTired;
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  auto next = std::async(std::launch::async, [this] {
    // The first ones come before it is noticed.
    Result<std::optional<Observation>> seen = device_->Next();
    while (seen) seen = device_->Next();
    return seen.error().message;
  });
  Until(next, [&] {
    GoOn();
    Say();
  });
  EXPECT_THAT(next.get(), AllOf(HasSubstr("scan /robot1/scan: no scan for 0.3 s"),
                                HasSubstr("not within 1.5 s")));
  EXPECT_THAT(
      told_, Contains(AllOf(Field(&RobotDevice::Halt::what, "scan /robot1/scan: no scan for 0.3 s"),
                            Field(&RobotDevice::Halt::fault, true))));
}

TEST_F(Ros2DeviceTest, StandsBeforeWhatARangeSensorSeesAndGoesOnWhenThatIsGone) {
  run_.topics.ranges = {"sonar"};
  Open();
  auto first = std::async(std::launch::async, [this] { return device_->Next(); });
  ASSERT_TRUE(SayAllUntil(first, std::nullopt));
  ASSERT_TRUE(DrivesAhead());
  SayRange(0.28F);
  EXPECT_TRUE(Told(kStand));
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  ASSERT_TRUE(SayAllUntil(next, std::nullopt));
  ExpectToldThatItWaited();
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenARangeSensorIsSilent) {
  run_.patience = kSoonTired;
  run_.topics.ranges = {"sonar"};
  Open();
  auto first = std::async(std::launch::async, [this] { return device_->Next(); });
  ASSERT_TRUE(SayAllUntil(first, std::nullopt));
  auto next = std::async(std::launch::async, [this] {
    Result<std::optional<Observation>> seen = device_->Next();
    while (seen) seen = device_->Next();
    return seen.error().message;
  });
  Until(next, [&] {
    GoOn();
    Say();
  });
  EXPECT_THAT(next.get(), HasSubstr("range /robot1/sonar: no range for 0.3 s"));
}

TEST_F(Ros2DeviceTest, ARangeSensorThatIsNotThereIsNamed) {
  run_.topics.ranges = {"sonar"};
  run_.patience = milliseconds(500);
  Open();
  robot_.reset();
  dds::Ros2Options topics = run_.topics;
  topics.ranges.clear();
  robot_ = dds::Ros2Robot::Open(topics).value();
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  Until(next, [&] {
    GoOn();
    Say();
  });
  const auto seen = next.get();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("nobody publishes /robot1/sonar"));
}

// A robot in lockstep goes no further before each of its frames is answered.
TEST_F(Ros2DeviceTest, InLockstepItAnswersEachFrameWhileItWaits) {
  run_.lockstep = true;
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(latest_.stamp, stamp_);
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  for (int frame = 0; frame < 5; ++frame) {
    GoOn(0.0);
    const auto deadline = steady_clock::now() + test::kLongEnough;
    do {
      SayScan(0.55F);
      Say();
      (void)Told(kStand, milliseconds(50));
    } while (latest_.stamp != stamp_ && steady_clock::now() < deadline);
    ASSERT_EQ(latest_.stamp, stamp_);
    ASSERT_EQ(latest_.velocity, kStand);
  }
  ASSERT_NE(next.wait_for(milliseconds(0)), std::future_status::ready);
  // Its half a second is that of the robot's stamps.
  const SensorTime free_from = stamp_ + kCameraFrame;
  int answered = 0;
  const auto deadline = steady_clock::now() + test::kLongEnough;
  while (next.wait_for(milliseconds(0)) != std::future_status::ready &&
         steady_clock::now() < deadline) {
    GoOn(0.0);
    while (latest_.stamp != stamp_ && next.wait_for(milliseconds(0)) != std::future_status::ready &&
           steady_clock::now() < deadline) {
      SayScan(std::nullopt);
      Say();
      (void)Told(kStand, milliseconds(50));
    }
    ++answered;
  }
  const auto seen = next.get();
  ASSERT_TRUE(seen);
  EXPECT_GE((*seen)->stamp - free_from, milliseconds(500));
  EXPECT_LE((*seen)->stamp - free_from, milliseconds(600));
  EXPECT_GE(answered, 15);
}

TEST_F(Ros2DeviceTest, WithAScanTopicItDoesNotDriveBeforeTheFirstScan) {
  run_.topics.scan = "scan";
  run_.patience = milliseconds(500);
  Open();
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  Until(next, [&] {
    GoOn();
    Say();
  });
  const auto seen = next.get();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no scan that can be one came on /robot1/scan"));
}

TEST_F(Ros2DeviceTest, WaitsForASilentRobotOnlyUntilItIsToldToEnd) {
  std::atomic<bool> stop = false;
  run_.patience = std::chrono::seconds(60);
  run_.stop = [&] { return stop.load(); };
  Open();
  ASSERT_TRUE(SayUntilSeen());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  ASSERT_EQ(next.wait_for(milliseconds(100)), std::future_status::timeout);
  stop = true;
  ASSERT_EQ(next.wait_for(test::kLongEnough), std::future_status::ready);
  const auto end = next.get();
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_FALSE(*end);
}

TEST_F(Ros2DeviceTest, SaysWhoIsMissingWhenThereIsNoRobot) {
  run_.patience = milliseconds(300);
  device_ = Ros2Device::Open(run_).value();
  const auto seen = device_->Next();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message,
              AllOf(HasSubstr("nobody publishes /robot1/image_raw"), HasSubstr("ROS domain 0")));
}

TEST_F(Ros2DeviceTest, NeedsOdometryUnlessToldThatThereIsNone) {
  run_.patience = milliseconds(500);
  Open();
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  Until(next, [&] {
    Say(false);
    GoOn();
  });
  const auto seen = next.get();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no odometry came on /robot1/odom"));
}

TEST_F(Ros2DeviceTest, InLockstepAnswersEachFrameOnceMoreWhenItIsSaidAgain) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  ASSERT_TRUE(DrivesAhead());
  Say();
  EXPECT_TRUE(Told(kRos2Ahead));
  EXPECT_EQ(latest_.stamp, stamp_);
}

// As a follower's robot does while its route is still to come.
TEST_F(Ros2DeviceTest, InLockstepAFrameSaidAgainBeforeItIsTakenKeepsItsTime) {
  run_.lockstep = true;
  Open();
  for (int i = 0; i < 30; ++i) {
    Say();
    std::this_thread::sleep_for(milliseconds(10));
  }
  const auto seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ((*seen)->stamp, stamp_);
}

TEST_F(Ros2DeviceTest, InLockstepAnswersAlsoWhileTeaching) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  auto next = std::async(std::launch::async, [this] { return device_->Next(); });
  EXPECT_TRUE(Told(kStand));
  EXPECT_EQ(latest_.stamp, stamp_);
  GoOn();
  Until(next, [&] { Say(); });
  EXPECT_TRUE(next.get());
}

TEST_F(Ros2DeviceTest, ADriveIsOverWhenTheRobotStandsAfterItHasMoved) {
  run_.still_at_end = milliseconds(150);
  Open();
  for (int i = 0; i < 10; ++i) {
    const auto seen = SayUntilSeen();
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(seen->has_value()) << "it has not moved yet";
    GoOn(0.0);
  }
  for (int i = 0; i < 10; ++i) {
    GoOn(0.05);
    ASSERT_TRUE(SayUntilSeen());
  }
  GoOn(0.05);
  int standing = 0;
  for (; standing < 20; ++standing) {
    const auto seen = SayUntilSeen();
    ASSERT_TRUE(seen) << seen.error().message;
    if (!seen->has_value()) break;
    GoOn(0.0);
  }
  EXPECT_EQ(standing, 5);
}

TEST_F(Ros2DeviceTest, GoesOnWhereACamerasClockGoesBackOrStandsStill) {
  Open();
  auto seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  SensorTime before = (*seen)->stamp;
  const auto expect_later = [&] {
    seen = SayUntilSeen();
    ASSERT_TRUE(seen) << seen.error().message;
    EXPECT_GT((*seen)->stamp, before);
    EXPECT_LT((*seen)->stamp, before + std::chrono::seconds(20));
    before = (*seen)->stamp;
  };
  stamp_ -= std::chrono::seconds(100);
  odometry_lag_ = std::chrono::seconds(-100);  // which keeps its clock
  GoOn();
  expect_later();
  GoOn();
  expect_later();
  for (int i = 0; i < 3; ++i) {
    GoOn();
    stamp_ -= kCameraFrame;
    odometry_lag_ -= kCameraFrame;
    expect_later();
  }
}

TEST_F(Ros2DeviceTest, OdometryWhoseStampsStandStillCountsAsItComes) {
  Open();
  ASSERT_TRUE(SayUntilSeen());
  const SensorTime stands = stamp_;
  for (int i = 0; i < 20; ++i) {
    GoOn();
    odometry_lag_ = stamp_ - stands;
    const auto seen = SayUntilSeen();
    ASSERT_TRUE(seen) << seen.error().message;
  }
}

TEST_F(Ros2DeviceTest, OdometryThatIsSetToZeroIsNoMotion) {
  Open();
  auto seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  const motion::Pose2 before = *(*seen)->odometry;
  pose_ = {0.0, 0.0, 0.0};
  GoOn(0.0);
  seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_NEAR(motion::IncrementBetween(before, *(*seen)->odometry).distance_m, 0.0, 1e-9);
  GoOn(0.01);
  const motion::Pose2 there = *(*seen)->odometry;
  seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_NEAR(motion::IncrementBetween(there, *(*seen)->odometry).distance_m, 0.01, 1e-9);
}

TEST_F(Ros2DeviceTest, SpeedsUpFromStandingAlsoAfterItHadToStop) {
  run_.limits.acceleration_mps2 = 0.5;
  Open();
  const auto most_told = [&] {
    for (int time = 0; time < 10; ++time) {  // the picture may be too old by then
      GoOn();
      EXPECT_TRUE(SayUntilSeen());
      (void)robot_->Take(milliseconds(0));
      EXPECT_TRUE(device_->Drive(kRos2Ahead));
      const auto deadline = steady_clock::now() + std::chrono::seconds(1);
      while (steady_clock::now() < deadline) {
        const auto heard = robot_->Take(milliseconds(5));
        if (heard && heard->velocity != kStand) return heard->velocity.linear_mps;
      }
    }
    return 0.0;
  };
  const double first_mps = most_told();
  EXPECT_GT(first_mps, 0.0);
  EXPECT_LE(first_mps, 0.05 + 1e-9);
  ASSERT_TRUE(Told(kStand)) << "nobody drives on with it";
  const double again_mps = most_told();
  EXPECT_GT(again_mps, 0.0);
  EXPECT_LE(again_mps, 0.05 + 1e-9);
}

TEST_F(Ros2DeviceTest, RefusesNamesThatAreNoTopics) {
  for (const char* robot : {"robot1", "/robot 1", "/1robot", "/robot1/", "//robot1"}) {
    run_.topics.robot = robot;
    EXPECT_FALSE(Ros2Device::Open(run_)) << robot;
  }
  run_.topics.robot = "/";
  EXPECT_TRUE(Ros2Device::Open(run_));
}

// Hears a robot that goes ahead and takes a picture whenever it is asked, until its hearing fails.
class FailingDriver final : public dds::Ros2Driver {
 public:
  struct Base {
    std::atomic<bool> fails{false};
    std::mutex lock;
    motion::VelocityCommand told{};
    [[nodiscard]] motion::VelocityCommand Told() {
      const std::lock_guard guard(lock);
      return told;
    }
  };
  explicit FailingDriver(Base& base) : base_(base) {}

  std::vector<dds::Ros2Sensed> Take(milliseconds /*max_wait*/) override {
    if (base_.fails) throw std::runtime_error("a message of no known kind");
    std::this_thread::sleep_for(milliseconds(5));
    const SensorTime stamp = steady_clock::now() - began_;
    const image::GrayImage picture = test::WalkFrame(++frame_);
    return {dds::Ros2Odometry{stamp, {.x_m = kRos2Ahead.linear_mps * Seconds(stamp)}},
            dds::Ros2Image{.stamp = stamp,
                           .width_px = static_cast<std::uint32_t>(picture.width),
                           .height_px = static_cast<std::uint32_t>(picture.height),
                           .encoding = "mono8",
                           .step = static_cast<std::uint32_t>(picture.width),
                           .data = picture.pixels}};
  }
  Result<void> Publish(const dds::Ros2Command& command) override {
    const std::lock_guard guard(base_.lock);
    base_.told = command.velocity;
    return {};
  }
  [[nodiscard]] Peers peers() const override { return {.cameras = 1, .odometers = 1, .bases = 1}; }

 private:
  Base& base_;
  const steady_clock::time_point began_ = steady_clock::now();
  int frame_ = 0;
};

TEST(Ros2Device, ThatHearsTheRobotNoMoreForAFaultStopsItAtOnceAndSaysWhy) {
  FailingDriver::Base base;
  Ros2Run run;
  run.limits.acceleration_mps2 = 1000.0;
  // The loop that drives is not what stops it, nor is silence.
  run.sensor_timeout = run.patience = test::kLongEnough;
  Ros2Device device(run, std::make_unique<FailingDriver>(base));
  ASSERT_TRUE(device.Next());
  ASSERT_TRUE(device.Drive(kRos2Ahead));
  EXPECT_EQ(base.Told(), kRos2Ahead);
  base.fails = true;
  ASSERT_TRUE(test::Await([&] { return base.Told() == kStand; }, "a stop"));
  ASSERT_TRUE(device.Drive(kRos2Ahead));
  EXPECT_EQ(base.Told(), kStand) << "for good";
  const auto next = device.Next();
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().code, ErrorCode::kInternal);
  EXPECT_THAT(next.error().message, AllOf(HasSubstr("the thread that hears the robot has failed"),
                                          HasSubstr("a message of no known kind")));
  EXPECT_EQ(device.Ailment(), next.error().message);
}

}  // namespace
}  // namespace trailcast::agent
