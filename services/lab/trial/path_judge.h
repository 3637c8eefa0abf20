#pragma once

#include <optional>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::trial {

// A driven path in the world's plane, in metres, with points at least a centimetre apart.
class TruePath {
 public:
  // Ignores a point less than a centimetre from the last one.
  void Add(const Eigen::Vector2d& point_m);

  [[nodiscard]] bool empty() const { return points_m_.empty(); }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points_m() const { return points_m_; }
  // Returns where the drive ended: the last point given to Add, even if it was too close to keep.
  [[nodiscard]] const Eigen::Vector2d& end_m() const { return end_m_; }
  [[nodiscard]] double length_m() const { return length_m_; }
  // Returns the distance from `point_m` to the nearest place on the path, which must not be empty.
  [[nodiscard]] double DistanceTo(const Eigen::Vector2d& point_m) const;

 private:
  std::vector<Eigen::Vector2d> points_m_;
  Eigen::Vector2d end_m_ = Eigen::Vector2d::Zero();
  double length_m_ = 0.0;
};

// The verdict on one robot's following by the truth.
struct PathVerdict {
  Eigen::Vector2d final_m = Eigen::Vector2d::Zero();
  double final_error_m = 0.0;       // from the taught end
  double mean_path_error_m = 0.0;   // from the taught path, over the metres driven
  double p90_path_error_m = 0.0;    // nine tenths of the metres driven were within it
  double max_path_error_m = 0.0;    // after the first kSettlingDistance_m
  double worst_path_error_m = 0.0;  // from the start on
  double driven_m = 0.0;
  // Distance from the taught path, kReturnDistance_m after a push; nothing if the robot did not
  // come that far.
  std::optional<double> after_push_m;
};

inline constexpr double kSettlingDistance_m = 2.0;  // belongs to the start error
inline constexpr double kReturnDistance_m = 10.0;   // within which a pushed robot must be back
inline constexpr double kArrivalRadius_m = 2.0;
inline constexpr double kStrayLimit_m = 5.0;

// Compares a follower's true positions, given in order, with the taught path. A drive too short to
// settle is judged by its last position.
class PathJudge {
 public:
  explicit PathJudge(TruePath taught) : taught_(std::move(taught)) {}

  // Returns the distance from the taught path.
  double Observe(const Eigen::Vector2d& position_m);

  // Notes that the robot was just pushed; the push is no driving of its own.
  void NotePush();
  [[nodiscard]] double driven_m() const { return driven_m_; }

  [[nodiscard]] PathVerdict verdict() const;
  [[nodiscard]] const TruePath& taught() const { return taught_; }
  [[nodiscard]] const TruePath& replayed() const { return replayed_; }

 private:
  TruePath taught_;
  TruePath replayed_;
  std::optional<Eigen::Vector2d> last_m_;
  double last_error_m_ = 0.0;
  double driven_m_ = 0.0;
  struct Section {
    double error_m = 0.0;
    double driven_m = 0.0;
  };
  [[nodiscard]] double WithinFor(double share) const;

  std::vector<Section> sections_;
  std::optional<double> max_settled_m_;
  double worst_m_ = 0.0;
  std::optional<double> pushed_at_m_;  // distance driven until then
  std::optional<double> after_push_m_;
};

}  // namespace trailcast::trial
