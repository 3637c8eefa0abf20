#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "services/motion/free_way.h"
#include "services/replay/follower.h"

namespace trailcast::replay {

struct PassingOptions {
  double most_m = 0.0;        // largest distance from the taught path; 0 passes nothing
  motion::Outline robot;      // includes a margin on either side
  double clearance_m = 0.1;   // further distance from an obstacle
  double look_ahead_m = 3.5;  // along the path
  // This is the distance to the obstacle. Further ahead a small error of the heading moves it onto
  // the path, or off it, and its width is not visible.
  double begin_m = 2.5;
  double sure_sigma_m = 0.15;  // of the place beside the path; with a larger one it passes nothing
  double come_back_m = 1.5;    // along the path, until it has returned to it
};

// This is the taught path in the frame of its point beside the robot: points kApart_m apart, x
// along the path there, y to its left. A path that is shorter than look_ahead_m ends there, or
// turns on the spot.
using PathAhead = std::vector<Eigen::Vector2d>;

// This goes round obstacles on the path: it decides how far beside the taught path to drive, on the
// side with room, and when to return. Other code has to notice collisions all the same.
class Passing {
 public:
  static constexpr double kApart_m = 0.1;

  explicit Passing(const PassingOptions& options) : options_(options) {}

  // Takes one look: where the robot is beside the path and along the route, whether it is sure of
  // that, and where obstacles stand in its axle's frame: x ahead, y left.
  void Look(const PathOffset& offset, double route_m, bool sure, const PathAhead& path,
            const std::vector<Eigen::Vector2d>& stands);

  // Returns where to drive: distance to the left of the taught path, or 0 to drive on it.
  [[nodiscard]] double left_m() const { return left_m_; }
  // Returns what it does about an obstacle on the path, or why it does nothing, in one line for
  // people that stays the same as long as that holds. It is empty without an obstacle.
  [[nodiscard]] const std::string& says() const { return says_; }

 private:
  // This is where an obstacle stands by the path: along it from the robot, and to its left.
  struct Beside {
    double along_m = 0.0;
    double left_m = 0.0;
  };
  // This is an obstacle on the path itself.
  struct Blocked {
    double from_m = 0.0;
    double to_m = 0.0;
  };
  [[nodiscard]] std::vector<Beside> Locate(const PathOffset& offset, const PathAhead& path,
                                           const std::vector<Eigen::Vector2d>& stands) const;
  [[nodiscard]] std::optional<Blocked> OnThePath(const std::vector<Beside>& stands) const;
  [[nodiscard]] bool IsFree(double left_m, double now_left_m, double until_m, double clearance_m,
                            const std::vector<Beside>& stands) const;
  [[nodiscard]] std::optional<double> Choose(double now_left_m, double until_m,
                                             const std::vector<Beside>& stands) const;

  PassingOptions options_;
  double left_m_ = 0.0;
  double back_at_m_ = 0.0;  // along the route, while beside the path
  std::string says_;
};

}  // namespace trailcast::replay
