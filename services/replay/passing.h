#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "services/motion/free_way.h"
#include "services/replay/follower.h"

namespace trailcast::replay {

struct PassingOptions {
  double most_m = 0.0;        // so far beside the taught path at most; 0: nothing is passed
  motion::Outline robot;      // with what is to spare on either side
  double clearance_m = 0.1;   // and besides, from what is passed
  double look_ahead_m = 3.5;  // along the path
  // From what stands on the path. Further ahead a small error of the heading puts it there, or
  // beside the path, and it is not seen how wide it is.
  double begin_m = 2.5;
  double sure_sigma_m = 0.15;  // of the place beside the path; less sure, it passes nothing
  double come_back_m = 1.5;    // along the path, until it is on the path again
};

// The taught path from where the robot is beside it: points kApart_m apart, x along the path there,
// y to its left. One that is shorter than look_ahead_m ends there, or turns on the spot.
using PathAhead = std::vector<Eigen::Vector2d>;

// Goes round what stands on the path: decides how far beside the taught path to drive, to the side
// with room, and when to come back. What it drives into all the same is somebody else's to notice.
class Passing {
 public:
  static constexpr double kApart_m = 0.1;

  explicit Passing(const PassingOptions& options) : options_(options) {}

  // By one look: where the robot is beside the path, and so far along the route; whether it is sure
  // of that; and where something stands, seen from its axle: x ahead, y left.
  void Look(const PathOffset& offset, double route_m, bool sure, const PathAhead& path,
            const std::vector<Eigen::Vector2d>& stands);

  // Where to drive: to the left of the taught path; 0: on it.
  [[nodiscard]] double left_m() const { return left_m_; }
  // What it does about what stands on the path, or why it does nothing, one line for people, the
  // same as long as that holds; empty: nothing stands there.
  [[nodiscard]] const std::string& says() const { return says_; }

 private:
  // Where something stands by the path: along it from the robot, and to its left.
  struct Beside {
    double along_m = 0.0;
    double left_m = 0.0;
  };
  // What is on the path itself.
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
