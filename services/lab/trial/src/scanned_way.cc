#include "services/lab/trial/src/scanned_way.h"

#include <cmath>

#include "services/lab/simulated/scanner.h"

namespace trailcast::trial {
namespace {

constexpr std::chrono::milliseconds kScan{100};
constexpr double kScanner_m = 0.2;  // above the ground
constexpr double kWidth_m = 0.4;    // see sim::RobotBody
constexpr double kBefore_m = 1.0;   // an obstacle before which a robot stops is this near
constexpr double kStands_m = 1e-4;  // in a frame

bool IsAhead(const Eigen::Vector2d& point) {
  return point.x() > 0.0 && point.x() < kBefore_m && std::abs(point.y()) < 0.5 * kWidth_m;
}

}  // namespace

agent::ObstacleOptions SimulatedBody() {
  agent::ObstacleOptions body;
  body.robot_width_m = kWidth_m;
  return body;
}

void ScannedWay::Look(SensorTime now, const sim::Judge& robot) {
  const Eigen::Vector2d position_m = motion::Position(robot.true_pose());
  const bool stands = (position_m - position_m_).norm() < kStands_m;
  position_m_ = position_m;
  if (last_ >= SensorTime(0) && (waits() || (stands && something_ahead_))) {
    figures_.waited_s += Seconds(now - last_);
  }
  figures_.touched = figures_.touched || robot.blocked();
  last_ = now;
  if (now < scan_at_) return;
  scan_at_ = now + kScan;
  const Eigen::Isometry3d scanner =
      robot.WorldFromBody() * Eigen::Translation3d(0.0, 0.0, kScanner_m);
  watch_.See(agent::ObstacleWatch::Time(
                 std::chrono::duration_cast<agent::ObstacleWatch::Time::duration>(now)),
             agent::LookAround(*world_, robot.stage(), scanner, {}));
  const auto points = watch_.scanned();
  something_ahead_ = std::any_of(points->begin(), points->end(), IsAhead);
  for (const Eigen::Vector2d& at : *points) {
    figures_.nearest_m = std::min(figures_.nearest_m, at.norm() - 0.5 * kWidth_m);
  }
}

}  // namespace trailcast::trial
