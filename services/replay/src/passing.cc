#include "services/replay/passing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trailcast::replay {
namespace {

constexpr double kStep_m = 0.05;  // between the candidate offsets
// Between leaving the path and being beside it, and on the way back, the robot may be anywhere
// between.
constexpr double kCrossing_m = 0.8;

}  // namespace

std::vector<Passing::Beside> Passing::Locate(const PathOffset& offset, const PathAhead& path,
                                             const std::vector<Eigen::Vector2d>& stands) const {
  std::vector<Beside> located;
  const double cos = std::cos(offset.heading_rad);
  const double sin = std::sin(offset.heading_rad);
  const double reach_m = options_.look_ahead_m + options_.most_m + options_.robot.side_m;
  for (const Eigen::Vector2d& seen : stands) {
    if (seen.squaredNorm() > reach_m * reach_m) continue;
    const Eigen::Vector2d at(cos * seen.x() - sin * seen.y(),
                             offset.left_m + sin * seen.x() + cos * seen.y());
    // Behind the robot the path is assumed to be straight.
    Beside nearest{at.x(), at.y()};
    double nearest_m = at.x() < 0.0 ? std::abs(at.y()) : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Eigen::Vector2d along = (path[i + 1] - path[i]).normalized();
      const Eigen::Vector2d off = at - path[i];
      // Obstacles beyond its last point do not matter.
      if (i + 2 == path.size() && off.dot(along) > kApart_m) continue;
      const double further_m = std::clamp(off.dot(along), 0.0, kApart_m);
      const double away_m = (off - further_m * along).norm();
      if (away_m >= nearest_m) continue;
      nearest_m = away_m;
      nearest = {static_cast<double>(i) * kApart_m + further_m,
                 along.x() * off.y() - along.y() * off.x()};
    }
    if (std::isfinite(nearest_m)) located.push_back(nearest);
  }
  return located;
}

std::optional<Passing::Blocked> Passing::OnThePath(const std::vector<Beside>& stands) const {
  std::optional<Blocked> blocked;
  for (const Beside& each : stands) {
    if (std::abs(each.left_m) > options_.robot.side_m || each.along_m < -options_.robot.side_m ||
        each.along_m > options_.begin_m) {
      continue;
    }
    if (!blocked) blocked = Blocked{each.along_m, each.along_m};
    blocked->from_m = std::min(blocked->from_m, each.along_m);
    blocked->to_m = std::max(blocked->to_m, each.along_m);
  }
  return blocked;
}

bool Passing::IsFree(double left_m, double now_left_m, double until_m, double clearance_m,
                     const std::vector<Beside>& stands) const {
  const double room_m = options_.robot.side_m + clearance_m;
  return std::none_of(stands.begin(), stands.end(), [&](const Beside& each) {
    if (each.along_m < -options_.robot.side_m || each.along_m > until_m) return false;
    const bool crossing = each.along_m < kCrossing_m;
    const double from_m = crossing ? std::min(left_m, now_left_m) : left_m;
    const double to_m = crossing ? std::max(left_m, now_left_m) : left_m;
    return each.left_m > from_m - room_m && each.left_m < to_m + room_m;
  });
}

// Returns the least offset that is free. A robot that is beside an obstacle already stays on that
// side.
std::optional<double> Passing::Choose(double now_left_m, double until_m,
                                      const std::vector<Beside>& stands) const {
  for (double aside_m = kStep_m; aside_m <= options_.most_m + 1e-9; aside_m += kStep_m) {
    for (const double left_m : {aside_m, -aside_m}) {
      if (left_m * left_m_ < 0.0) continue;
      if (IsFree(left_m, now_left_m, until_m, options_.clearance_m, stands)) return left_m;
    }
  }
  return std::nullopt;
}

void Passing::Look(const PathOffset& offset, double route_m, bool sure, const PathAhead& path,
                   const std::vector<Eigen::Vector2d>& stands) {
  if (options_.most_m <= 0.0) return;
  const std::vector<Beside> beside = Locate(offset, path, stands);
  const auto blocked = OnThePath(beside);
  const bool aside = left_m_ != 0.0;
  // A robot that was found elsewhere is not beside the obstacle that it was passing.
  const bool past = route_m >= back_at_m_ || back_at_m_ - route_m > 2.0 * options_.look_ahead_m;
  if (!blocked && (!aside || past)) {
    left_m_ = 0.0;
    says_.clear();
    return;
  }
  if (!blocked) return;
  const double past_m = blocked->to_m + 2.0 * options_.robot.side_m;
  const double path_m = kApart_m * static_cast<double>(path.size() - 1);
  const bool ends = path_m < options_.look_ahead_m - kApart_m;
  const double back_by_m = path_m - options_.come_back_m;
  const bool too_near = ends && past_m > back_by_m;
  const double back_at_m =
      aside && !past ? std::max(back_at_m_, route_m + past_m) : route_m + past_m;
  const double until_m = back_at_m - route_m;
  // The offset was chosen with a larger clearance, since the visible part of an obstacle varies. An
  // obstacle where the path ends is only passed as far as leaves room to return.
  if (aside && !(past && too_near) &&
      IsFree(left_m_, left_m_, until_m, 0.5 * options_.clearance_m, beside)) {
    back_at_m_ = too_near ? std::max(back_at_m_, route_m + back_by_m) : back_at_m;
    return;
  }
  if (past) left_m_ = 0.0;
  if (!sure || offset.left_sigma_m > options_.sure_sigma_m) {
    says_ =
        "something stands on the path, and the robot is not sure enough of its place to pass it";
    return;
  }
  if (too_near) {
    says_ = "something stands on the path, and too near where the robot is to stand to pass it";
    return;
  }
  const auto left_m = Choose(offset.left_m, until_m, beside);
  if (!left_m) {
    says_ = fmt::format(
        "something stands on the path, and within {:g} m neither side has room to pass it",
        options_.most_m);
    return;
  }
  left_m_ = *left_m;
  back_at_m_ = back_at_m;
  says_ = fmt::format("passes what stands on the path, {:.2f} m to the {} of it", std::abs(left_m_),
                      left_m_ > 0.0 ? "left" : "right");
}

}  // namespace trailcast::replay
