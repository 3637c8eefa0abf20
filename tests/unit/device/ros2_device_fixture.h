#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/device/ros2_device.h"
#include "tests/support/await.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {

constexpr std::chrono::milliseconds kCameraFrame{33};
const motion::VelocityCommand kRos2Ahead{0.4, 0.1};
const motion::VelocityCommand kRos2Stand{};

inline dds::Ros2Image WalkPicture(SensorTime stamp, int frame) {
  const image::GrayImage picture = test::WalkFrame(frame);
  return {.stamp = stamp,
          .width_px = static_cast<std::uint32_t>(picture.width),
          .height_px = static_cast<std::uint32_t>(picture.height),
          .encoding = "mono8",
          .step = static_cast<std::uint32_t>(picture.width),
          .data = picture.pixels};
}

// This is a robot, and the clock by which it is driven, which stands unless the test lets time
// pass. The device has handled both when a call returns, however busy the machine is.
class SteppedRobot {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void Say(std::vector<dds::Ros2Sensed> sensed) {
    Step([&] { said_ = std::move(sensed); });
  }
  void Pass(std::chrono::milliseconds time) {
    Step([&] { now_ += time; });
  }
  // Hearing it throws this.
  void Fail(const std::string& why) {
    const std::lock_guard guard(lock_);
    fails_ = why;
  }
  void Meet(const dds::Ros2Driver::Peers& peers) {
    const std::lock_guard guard(lock_);
    peers_ = peers;
  }
  // Several nodes publish this topic of the robot; empty for none.
  void Crowd(const std::string& topic) {
    const std::lock_guard guard(lock_);
    crowded_ = topic;
  }
  [[nodiscard]] Time now() const {
    const std::lock_guard guard(lock_);
    return now_;
  }
  // Returns the last command.
  [[nodiscard]] dds::Ros2Command latest() const {
    const std::lock_guard guard(lock_);
    return latest_;
  }
  [[nodiscard]] motion::VelocityCommand told() const { return latest().velocity; }
  // Returns the number of commands.
  [[nodiscard]] int commands() const {
    const std::lock_guard guard(lock_);
    return commands_;
  }

  // This is the device's end of the bus.
  class Driver final : public dds::Ros2Driver {
   public:
    explicit Driver(SteppedRobot& robot) : robot_(robot) {}
    std::vector<dds::Ros2Sensed> Take(std::chrono::milliseconds /*max_wait*/) override {
      return robot_.Hand();
    }
    Result<void> Publish(const dds::Ros2Command& command) override {
      const std::lock_guard guard(robot_.lock_);
      robot_.latest_ = command;
      ++robot_.commands_;
      return {};
    }
    [[nodiscard]] Peers peers() const override {
      const std::lock_guard guard(robot_.lock_);
      return robot_.peers_;
    }
    [[nodiscard]] std::string crowded() const override {
      const std::lock_guard guard(robot_.lock_);
      return robot_.crowded_;
    }

   private:
    SteppedRobot& robot_;
  };

 private:
  // A device that comes for the next step has handled the one before.
  std::vector<dds::Ros2Sensed> Hand() {
    std::unique_lock guard(lock_);
    if (!fails_.empty()) throw std::runtime_error(fails_);
    done_ = taken_;
    changed_.notify_all();
    changed_.wait_for(guard, std::chrono::milliseconds(1), [this] { return taken_ != steps_; });
    taken_ = steps_;
    return std::exchange(said_, {});
  }
  template <typename Change>
  void Step(const Change& change) {
    std::unique_lock guard(lock_);
    change();
    ++steps_;
    changed_.notify_all();
    ASSERT_TRUE(changed_.wait_for(guard, test::kLongEnough, [this] { return done_ == steps_; }));
  }

  mutable std::mutex lock_;
  std::condition_variable changed_;
  Time now_ = Time(std::chrono::hours(100));
  std::vector<dds::Ros2Sensed> said_;
  int steps_ = 0;
  int taken_ = 0;
  int done_ = 0;
  std::string fails_;
  dds::Ros2Driver::Peers peers_;
  std::string crowded_;
  dds::Ros2Command latest_;
  int commands_ = 0;
};

// This is a ROS 2 robot's device, for which the test decides what the robot senses, and when.
class Ros2DeviceTest : public testing::Test {
 protected:
  using Seen = Result<std::optional<Observation>>;
  using milliseconds = std::chrono::milliseconds;

  Ros2DeviceTest() {
    run_.topics.robot = "/robot1";
    run_.limits.acceleration_mps2 = 1000.0;
    run_.clock = [this] { return robot_.now(); };
    // This ends a wait that nothing else ends.
    run_.stop = [this, until = std::chrono::steady_clock::now() + test::kLongEnough] {
      ++looks_;
      return end_ || std::chrono::steady_clock::now() > until;
    };
  }

  void Open() {
    dds::Ros2Driver::Peers peers;
    peers.cameras = peers.odometers = peers.bases = peers.scanners = peers.imus = 1;
    peers.rangers.assign(run_.topics.ranges.size(), rangers_);
    robot_.Meet(peers);
    device_ = std::make_unique<Ros2Device>(run_, std::make_unique<SteppedRobot::Driver>(robot_));
    device_->OnTrouble([this](const RobotDevice::Halt& halt) { told_.push_back(halt); });
  }
  void OpenWithAScanner() {
    run_.topics.scan = "scan";
    Open();
    ASSERT_TRUE(SeeAll(std::nullopt));
  }

  // Moves the robot on by one frame.
  void GoOn(double metres = 0.01) {
    robot_.Pass(kCameraFrame);
    stamp_ += kCameraFrame;
    pose_.x_m += metres;
    ++frame_;
  }
  void SayOdometry() { robot_.Say({dds::Ros2Odometry{stamp_ - odometry_lag_, pose_}}); }
  void Say(bool with_odometry = true) {
    if (with_odometry) SayOdometry();
    robot_.Say({WalkPicture(stamp_, frame_)});
  }
  // Publishes a scan that has one thing this far ahead, and nothing else.
  void SayScan(std::optional<float> range_m) {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    const float met = range_m.value_or(kNothing);
    robot_.Say({dds::Ros2Scan{stamp_, {-0.03, 0.02, 0.1, 10.0, {kNothing, met, met, kNothing}}}});
  }
  void SayRange(std::optional<float> range_m) {
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    robot_.Say({dds::Ros2Range{stamp_, 0, {0.1, 0.02, 4.0, range_m.value_or(kNothing)}}});
  }
  // Publishes an attitude that is uphill by this much.
  void SayImu(double climb_rad) {
    const motion::Attitude attitude{0.0, -std::sin(climb_rad / 2.0), 0.0,
                                    std::cos(climb_rad / 2.0)};
    robot_.Say({dds::Ros2Imu{stamp_, {.attitude = attitude}}});
  }
  // Publishes all of it, a frame further.
  void SayAll(std::optional<float> range_m) {
    GoOn();
    if (!run_.topics.scan.empty()) SayScan(range_m);
    if (!run_.topics.ranges.empty()) SayRange(range_m);
    Say();
  }

  std::future<Seen> Next() {
    return std::async(std::launch::async, [this] { return device_->Next(); });
  }
  // Returns the message with which the device ends, after the frames that come before.
  std::future<std::string> Failure() {
    return std::async(std::launch::async, [this] {
      Seen seen = device_->Next();
      while (seen && *seen) seen = device_->Next();
      return seen ? std::string() : seen.error().message;
    });
  }
  // Returns whether it is there, once the loop that waits for it has looked at all that there is by
  // now.
  template <typename Value>
  bool IsThere(std::future<Value>& next) {
    const auto is_there = [&] {
      return next.wait_for(milliseconds(0)) == std::future_status::ready;
    };
    const int looked = looks_ + 3;  // the first of them may have begun before
    test::Await([&] { return is_there() || looks_ >= looked; }, "another look of the device");
    return is_there();
  }
  // Publishes something repeatedly until that is there, or far too often.
  template <typename Value>
  Value Until(std::future<Value>& next, const std::function<void()>& say) {
    constexpr int kMost = 2000;
    for (int time = 0; time < kMost && !IsThere(next); ++time) say();
    end_ = !IsThere(next);
    EXPECT_FALSE(end_) << "the device makes nothing of it";
    return next.get();
  }
  // Returns what the device makes of it, while time passes.
  Seen See() {
    auto next = Next();
    return Until(next, [this] { robot_.Pass(milliseconds(10)); });
  }
  Seen SeeAll(std::optional<float> range_m) {
    SayAll(range_m);
    return See();
  }
  Seen SaySeen(bool with_odometry = true) {
    Say(with_odometry);
    return See();
  }

  // This drives at thirty frames a second.
  void ExpectFramesAtFullRate() {
    for (int frame = 0; frame < 6; ++frame) {
      auto next = Next();
      const auto seen = Until(next, [this] {
        GoOn();
        Say();
      });
      ASSERT_TRUE(seen) << seen.error().message;
      EXPECT_TRUE((*seen)->odometry);
    }
  }

  // Commands the robot to drive, and returns whether it does. A robot that was just stopped
  // accelerates from standing, with the next frames.
  bool DrivesAhead() {
    for (int time = 0; time < 3; ++time) {
      if (!device_->Drive(kRos2Ahead)) return false;
      if (robot_.told() == kRos2Ahead) return true;
      if (!SeeAll(std::nullopt)) return false;
    }
    return false;
  }
  // Expects a report that the robot waited, and another that this is over.
  void ExpectToldThatItWaited() {
    const auto waits = std::find_if(told_.begin(), told_.end(), [](const RobotDevice::Halt& halt) {
      return halt.what == "something stands 0.3 m ahead, in the way: the robot waits";
    });
    ASSERT_NE(waits, told_.end());
    EXPECT_FALSE(waits->fault);
    EXPECT_EQ(told_.back().what, "");
  }

  // This is a short patience, for tests of what happens when it ends.
  static constexpr milliseconds kSoonTired{1500};
  std::atomic<int> looks_ = 0;     // looks of the loop that waits for a frame
  std::atomic<bool> end_ = false;  // it is told to end
  SteppedRobot robot_;
  int rangers_ = 1;  // publishers of each of its range topics
  Ros2Run run_;
  std::vector<RobotDevice::Halt> told_;
  std::unique_ptr<Ros2Device> device_;
  SensorTime stamp_ = std::chrono::seconds(1'700'000'000) + milliseconds(250);
  std::chrono::nanoseconds odometry_lag_{0};
  motion::Pose2 pose_{3.0, -2.0, 2.5};
  int frame_ = 0;
};

}  // namespace trailcast::agent
