#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/odometry_gate.h"
#include "agent/device/pose_history.h"
#include "agent/device/stamp_clock.h"

namespace trailcast::agent {

// Where a robot was when a frame was taken: by its odometry, which may jump, and by the stamps of
// both, which may be of different clocks. Reads no clock itself.
class SensedPoses {
 public:
  using Time = StampClock::Time;

  enum class Clocks { kMayDiffer, kOne };  // of pictures and odometry

  explicit SensedPoses(const GateOptions& options, Clocks clocks = Clocks::kMayDiffer)
      : clocks_(clocks), gate_(options) {}

  // `told`: what the base was told meanwhile. False for a sample that says nothing new.
  bool AddOdometry(SensorTime stamp, const motion::Pose2& pose, Time came_at,
                   const motion::VelocityCommand& told);
  // When a frame was taken, later than the one before; nothing for one that comes out of turn.
  [[nodiscard]] std::optional<SensorTime> AddFrame(SensorTime stamp, Time came_at);

  [[nodiscard]] bool has_odometry() const { return !poses_.empty(); }
  // Odometry goes on past the moment of a frame (of AddFrame).
  [[nodiscard]] bool Reaches(SensorTime frame) const {
    return poses_.newest() >= frame + clocks_apart_;
  }
  // There is odometry.
  [[nodiscard]] motion::Pose2 At(SensorTime frame) const {
    return poses_.At(frame + clocks_apart_);
  }
  // There is odometry: the newest, when it was taken, and as the base has that.
  [[nodiscard]] motion::Pose2 newest_pose() const { return poses_.At(poses_.newest()); }
  [[nodiscard]] SensorTime newest() const { return poses_.newest(); }
  [[nodiscard]] SensorTime newest_stamp() const { return newest_stamp_; }
  // What may have been driven over jumps since the last call.
  [[nodiscard]] motion::OdometryIncrement TakeUnknown();
  // What befell clocks and odometry since the last call, a line each for people.
  [[nodiscard]] std::vector<std::string> TakeNews();

 private:
  void CompareClocks(Time now);

  Clocks clocks_;
  StampClock odometry_clock_;
  StampClock frame_clock_;
  OdometryGate gate_;
  PoseHistory poses_;
  SensorTime newest_stamp_{};
  std::optional<motion::Pose2> newest_raw_;
  std::chrono::nanoseconds clocks_apart_{0};  // of odometry's against the frames'
  // The same as each of the last periods has it, in which samples of both came.
  std::deque<std::chrono::nanoseconds> apart_;
  Time period_from_;
  motion::OdometryIncrement unknown_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
