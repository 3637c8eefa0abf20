#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Notices when a robot's camera, odometry, scanner, range sensors or base fails: there is no
// picture, or the same one again and again while the robot moves; there is no odometry, no scan or
// no range; the base stands although it has a command. Its caller passes on everything; it reads no
// clock itself. A standing base is in trouble for a second or a few, and is then to be tried; it
// has moved, or stands again.
class RobotWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // A part that is silent for longer than `timeout` has failed.
  RobotWatch(std::chrono::milliseconds timeout, bool has_odometry, bool has_scan,
             std::size_t range_sensors)
      : timeout_(timeout),
        has_odometry_(has_odometry),
        has_scan_(has_scan),
        range_at_(range_sensors) {}

  // `changed` means that not all pixels equal the frame before.
  void SawFrame(Time now, bool changed);
  void SawOdometry(Time now, SensorTime stamp, const motion::Pose2& pose);
  void SawScan(Time now) { scan_at_ = now; }
  void SawRange(Time now, std::size_t sensor) { range_at_[sensor] = now; }
  // Notes the base's command, which holds until the next one.
  void Told(const motion::VelocityCommand& command);

  struct Trouble {
    // An obstacle is no failure; ObstacleWatch finds it. The reader of a topic finds that several
    // publish it.
    enum class Part { kCamera, kOdometry, kScan, kRange, kBase, kObstacle, kCrowd };
    Part part = Part::kCamera;
    std::string what;        // one line for people
    std::size_t sensor = 0;  // for a range sensor
  };
  // Returns what is wrong now, if anything. Nothing is before the first frame.
  [[nodiscard]] std::optional<Trouble> Check(Time now);
  // Returns since when the base has stood in spite of its commands, including tries, or nothing if
  // it obeys.
  [[nodiscard]] std::optional<Time> base_stands_since() const {
    return stand_ ? std::optional(stand_->since) : std::nullopt;
  }

 private:
  struct Stand {
    Time since;
    Time try_at;
    std::chrono::milliseconds rest;  // how long it is left alone
  };
  struct Sample {
    SensorTime stamp{};
    motion::Pose2 pose;
    motion::VelocityCommand told;
  };
  [[nodiscard]] std::optional<Trouble> CheckCamera(Time now);
  [[nodiscard]] std::optional<Trouble> CheckOdometry(Time now) const;
  [[nodiscard]] std::optional<Trouble> CheckScan(Time now) const;
  [[nodiscard]] std::optional<Trouble> CheckRanges(Time now) const;
  [[nodiscard]] std::optional<Trouble> CheckBase(Time now) const;
  void JudgeBase(Time now);
  void NoteStand(Time now);
  [[nodiscard]] bool StandsYet() const;

  std::chrono::milliseconds timeout_;
  bool has_odometry_;
  bool has_scan_;
  motion::VelocityCommand told_;
  std::optional<Time> frame_at_;
  Time anew_at_{};           // since when pictures should have changed
  motion::Pose2 anew_from_;  // where the robot was then
  bool frozen_ = false;
  std::optional<Time> odometry_at_;
  std::optional<Time> scan_at_;
  std::vector<std::optional<Time>> range_at_;
  motion::Pose2 pose_;
  std::deque<Sample> driven_;  // since the base was told to drive
  bool obeyed_ = false;        // it has driven since
  std::optional<Stand> stand_;
};

}  // namespace trailcast::agent
