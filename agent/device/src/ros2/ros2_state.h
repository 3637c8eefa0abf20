#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "agent/device/obstacle_watch.h"
#include "agent/device/ros2_device.h"
#include "agent/device/sensed_poses.h"
#include "agent/device/src/robot_watch.h"
#include "agent/device/src/ros2/ros2_picture.h"
#include "agent/device/src/still_picture_watch.h"
#include "agent/device/src/still_watch.h"
#include "services/motion/battery.h"
#include "services/vision/picture_intake.h"

// This is the state that the two threads of a ROS 2 robot's device share: the one that hears the
// robot and stops it (ros2_hearing.cc), and the one that drives it (ros2_device.cc).
namespace trailcast::agent {

// How long either thread listens at a time.
constexpr std::chrono::milliseconds kListen{20};

// Converts the robot's own time, where that is the one that counts.
[[nodiscard]] inline std::chrono::steady_clock::time_point AsTime(SensorTime stamp) {
  return std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(stamp));
}

// A picture until Next takes it.
struct Ros2Frame {
  [[nodiscard]] SensorTime stamp() const { return StampOf(picture); }

  std::chrono::steady_clock::time_point came_at;
  SensorTime taken{};
  Ros2Picture picture;
};

struct Ros2Device::State {
  State(const Ros2Run& device, std::unique_ptr<dds::Ros2Driver> link);

  [[nodiscard]] bool has_odometry() const { return !run.topics.odometry.empty(); }
  [[nodiscard]] bool has_scan() const { return !run.topics.scan.empty(); }
  [[nodiscard]] bool has_imu() const { return !run.topics.imu.empty(); }

  // For the hearing thread.
  void Hear();
  void Keep(dds::Ros2Sensed sensed, std::chrono::steady_clock::time_point now);
  void KeepFrame(Ros2Picture picture, std::chrono::steady_clock::time_point now);
  void KeepImu(const motion::ImuSample& felt);
  void KeepBattery(const dds::Ros2Battery& battery, std::chrono::steady_clock::time_point now);
  void KeepScan(const dds::Ros2Scan& scan, std::chrono::steady_clock::time_point now);
  void KeepRange(const dds::Ros2Range& range, std::chrono::steady_clock::time_point now);
  void SlowDown();
  void NoteRoom();
  void AnswerByStanding();
  void StopIfInDoubt(std::chrono::steady_clock::time_point now);

  // For any thread, with the lock.
  Result<void> Tell(const motion::VelocityCommand& command);
  Result<void> Say(const motion::VelocityCommand& command);
  [[nodiscard]] SensorTime CommandStamp() const;
  [[nodiscard]] motion::VelocityCommand Shaped(const motion::VelocityCommand& wanted) const;
  [[nodiscard]] motion::VelocityCommand Within(const motion::VelocityCommand& wanted);

  // For the driving thread, with the lock.
  [[nodiscard]] bool ready(std::chrono::steady_clock::time_point now) const;
  [[nodiscard]] Halt Halted() const;
  [[nodiscard]] std::optional<Error> GiveUp(std::chrono::steady_clock::time_point now);
  [[nodiscard]] Error Failure(const RobotWatch::Trouble& trouble) const;
  [[nodiscard]] std::string Missing() const;
  [[nodiscard]] std::string Ailment() const;
  Result<std::optional<Ros2Frame>> Await(std::unique_lock<std::mutex>& guard);
  void Leave(const Error& damage);
  void ShareTrouble();
  void ShareNews();
  [[nodiscard]] std::vector<motion::ImuSample> TakeImu();

  Ros2Run run;
  std::unique_ptr<dds::Ros2Driver> driver;
  Trouble tell = [](const Halt&) {};

  std::mutex lock;  // guards everything below
  std::condition_variable news;
  bool ending = false;
  std::optional<Error> deaf;  // why the robot can no longer be heard
  RobotWatch watch;
  std::optional<ObstacleWatch> obstacles;  // if there are a scanner or range sensors
  bool by_hand = false;                    // Next does not wait for the way to be free
  bool backs_unseen = false;               // its command leads there
  SensedPoses poses;
  bool odometry_stands = false;                  // it comes with stamps that do not advance
  std::optional<motion::VelocityCommand> heard;  // the last command from somebody else
  std::chrono::steady_clock::time_point heard_at;
  std::vector<motion::ImuSample> imu;  // since the last frame that Next returned
  motion::BatteryGauge gauge;
  std::optional<std::uint8_t> battery_percent;
  std::chrono::steady_clock::time_point battery_heard_at;
  int frames_without_imu = 0;  // until the first sample comes
  std::optional<Ros2Frame> newest;
  std::chrono::steady_clock::time_point unserved_since;  // since when the newest frame waits
  std::optional<SensorTime> last_stamp;                  // of the frame before, returned or not
  std::vector<std::uint8_t> last_bytes;                  // of the frame before
  std::optional<SensorTime> given;  // the last frame that Next took, by its stamp
  std::optional<SensorTime> given_before;
  std::chrono::steady_clock::time_point given_came_at;
  bool answered = true;                           // with a command
  image::PictureRun pictures{vision::kEnoughPx};  // for the driving thread alone
  int unreadable = 0;                             // pictures that were left out
  std::string why_unreadable;
  motion::VelocityCommand told;  // the base's present command
  bool drove = false;            // an earlier command moved it
  std::chrono::steady_clock::time_point told_at;
  std::chrono::steady_clock::time_point stop_said_until;
  std::optional<RobotWatch::Trouble> trouble;
  std::string no_room;  // for the camera's packets, since it is silent
  std::chrono::steady_clock::time_point waiting_since;  // for a frame
  Halt shared;
  std::vector<std::string> told_news;  // until TakeNews, at most the first few
  StillWatch still;
  StillPictureWatch still_by_sight;  // without odometry; for the driving thread, without the lock
  int width_px = 0;
  int height_px = 0;

  std::thread hearing;
};

}  // namespace trailcast::agent
