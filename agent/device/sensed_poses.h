#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/odometry_gate.h"
#include "agent/device/pose_history.h"
#include "agent/device/stamp_clock.h"

namespace trailcast::agent {

// Tells where a robot was when a frame was taken, by its odometry, which may jump, and by the
// stamps of both, which may be of different clocks. It reads no clock itself.
class SensedPoses {
 public:
  using Time = StampClock::Time;

  enum class Clocks { kMayDiffer, kOne };  // of pictures and odometry

  explicit SensedPoses(const GateOptions& options, Clocks clocks = Clocks::kMayDiffer)
      : clocks_(clocks), gate_(options) {}

  // `told` is the base's command meanwhile. Returns false for a sample without news.
  bool AddOdometry(SensorTime stamp, const motion::Pose2& pose, Time came_at,
                   const motion::VelocityCommand& told);
  // Returns when a frame was taken, later than the one before, or nothing for a frame out of order.
  [[nodiscard]] std::optional<SensorTime> AddFrame(SensorTime stamp, Time came_at);

  [[nodiscard]] bool has_odometry() const { return !poses_.empty(); }
  // Says whether odometry continues past a frame's moment (from AddFrame).
  [[nodiscard]] bool Reaches(SensorTime frame) const {
    return poses_.newest() >= frame + clocks_apart_;
  }
  // Needs odometry.
  [[nodiscard]] motion::Pose2 At(SensorTime frame) const {
    return poses_.At(frame + clocks_apart_);
  }
  // These need odometry, and return the newest pose, when it was taken, and its stamp on the base.
  [[nodiscard]] motion::Pose2 newest_pose() const { return poses_.At(poses_.newest()); }
  [[nodiscard]] SensorTime newest() const { return poses_.newest(); }
  [[nodiscard]] SensorTime newest_stamp() const { return newest_stamp_; }
  // Returns the unknown motion over jumps since the last call.
  [[nodiscard]] motion::OdometryIncrement TakeUnknown();
  // Returns lines for people about clocks and odometry since the last call.
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
  std::chrono::nanoseconds clocks_apart_{0};  // odometry's clock against the frames'
  // The same difference in each of the last periods in which samples of both came.
  std::deque<std::chrono::nanoseconds> apart_;
  Time period_from_;
  motion::OdometryIncrement unknown_;
  std::vector<std::string> news_;
};

}  // namespace trailcast::agent
