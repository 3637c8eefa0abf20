#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Notices that a robot's camera, odometry or base does no longer do its part: no picture, or the
// same one again and again while the robot moves; no odometry; a base that stands although it was
// told to drive. Told of all that comes and goes; reads no clock itself.
class RobotWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // What stays away for longer than `timeout` has failed.
  RobotWatch(std::chrono::milliseconds timeout, bool has_odometry)
      : timeout_(timeout), has_odometry_(has_odometry) {}

  // `changed`: not the very same pixels as the frame before.
  void SawFrame(Time now, bool changed);
  void SawOdometry(Time now, SensorTime stamp, const motion::Pose2& pose);
  // What the base was told, until the next time.
  void Told(const motion::VelocityCommand& command);

  struct Trouble {
    enum class Part { kCamera, kOdometry, kBase };
    Part part = Part::kCamera;
    std::string what;  // one line for people
    // Nobody should drive on by himself: a base that did not obey may be blocked, or be held by an
    // emergency stop.
    bool final = false;
  };
  // What is wrong now, if anything. Before the first frame nothing is.
  [[nodiscard]] std::optional<Trouble> Check(Time now);

 private:
  struct Sample {
    SensorTime stamp{};
    motion::Pose2 pose;
    motion::VelocityCommand told;
  };
  [[nodiscard]] std::optional<Trouble> CheckCamera(Time now);
  [[nodiscard]] std::optional<Trouble> CheckOdometry(Time now) const;
  [[nodiscard]] std::optional<Trouble> CheckBase() const;
  void JudgeBase();
  [[nodiscard]] bool StandsYet() const;

  std::chrono::milliseconds timeout_;
  bool has_odometry_;
  motion::VelocityCommand told_;
  std::optional<Time> frame_at_;
  Time anew_at_{};           // since when pictures should change
  motion::Pose2 anew_from_;  // where the robot was then
  bool frozen_ = false;
  std::optional<Time> odometry_at_;
  motion::Pose2 pose_;
  std::deque<Sample> driven_;  // since the base was told to drive
  bool obeyed_ = false;        // it has driven since
  bool disobeyed_ = false;
};

}  // namespace trailcast::agent
