#pragma once

#include <optional>
#include <vector>

#include "services/lab/sim/core/path.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

struct DriverOptions {
  double speed_mps = 0.4;       // on the straight
  double slowest_share = 0.4;   // of it, in the sharpest turn
  double turning_radps = 0.43;  // about 25 degrees a second, never more
  double acceleration_mps2 = 0.4;
  double look_ahead_m = 0.30;    // for pure pursuit; a shorter one cuts corners less but weaves
  double corner_radius_m = 0.6;  // way-points' corners are driven as arcs of this
  double spot_turn_rad = 2.4;    // sharper ones are turned on the spot, or by changing gear
  double arrived_within_m = 0.015;
  std::optional<Gear> shunts_from = std::nullopt;  // see DrivenPath
};

// The human operator who drives the scout along way-points. The operator sees where the robot truly
// is, steers by pure pursuit, slows down in turns, and stops at the end. Where the path doubles
// back, the robot stops and turns on the spot, or changes gear.
class PathFollowDriver {
 public:
  explicit PathFollowDriver(const Polyline& way_points, const DriverOptions& options = {});

  // Returns the operator's command for the robot at `true_pose` (world frame), which is {0, 0}
  // after it has arrived.
  [[nodiscard]] motion::VelocityCommand Command(const motion::Pose2& true_pose);
  [[nodiscard]] bool arrived() const { return arrived_; }
  // Returns the share of the path that is driven, 0..1.
  [[nodiscard]] double progress() const;
  // Returns the path with rounded corners, as it is driven.
  [[nodiscard]] const Polyline& path() const { return path_; }

 private:
  // A part of the path between turns on the spot, or changes of gear.
  struct Leg {
    Polyline path;
    double length_m = 0.0;
    std::vector<double> speeds_mps;  // one a point of the path
  };
  void AddLeg(const Polyline& way_points);
  void PlanSpeeds(Leg& leg) const;
  [[nodiscard]] bool backwards() const;
  [[nodiscard]] bool EndsLeg(const Eigen::Vector2d& place);
  [[nodiscard]] motion::VelocityCommand Drive(const motion::Pose2& pose);

  DriverOptions options_;
  Polyline path_;
  std::vector<Leg> legs_;
  std::size_t leg_ = 0;
  double along_m_ = 0.0;  // of the leg
  bool aligned_ = false;  // has turned on the spot to face the path
  bool arrived_ = false;
};

}  // namespace trailcast::sim
