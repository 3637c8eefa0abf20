#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "agent/device/obstacle_watch.h"
#include "services/base/time.h"
#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/trial/trial_report.h"

namespace trailcast::trial {

// Returns the body of a simulated robot as its agent knows it.
[[nodiscard]] agent::ObstacleOptions SimulatedBody();

// A follower's scanner above its axle, without noise, which stops the robot before obstacles as an
// agent's device does, with ten scans a second.
class ScannedWay {
 public:
  explicit ScannedWay(std::shared_ptr<const sim::World> world)
      : world_(std::move(world)), watch_(SimulatedBody(), true) {}

  // Must be called once a frame, wherever the robot is.
  void Look(SensorTime now, const sim::Judge& robot);

  // Returns the part of the command that is allowed.
  [[nodiscard]] motion::VelocityCommand Allow(const motion::VelocityCommand& wanted) {
    return watch_.Want(wanted);
  }
  // Returns what the robot waits for; meanwhile its session gets no frames.
  [[nodiscard]] const std::optional<std::string>& waits() const { return watch_.waits(); }
  [[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> scanned() const {
    return watch_.scanned();
  }
  [[nodiscard]] const ScanFigures& figures() const { return figures_; }

 private:
  std::shared_ptr<const sim::World> world_;
  agent::ObstacleWatch watch_;
  SensorTime last_{-1};
  SensorTime scan_at_{0};
  Eigen::Vector2d position_m_ = Eigen::Vector2d::Zero();  // the true one in the last frame
  bool something_ahead_ = false;                          // by the last scan
  ScanFigures figures_;
};

}  // namespace trailcast::trial
