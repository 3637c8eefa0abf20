#include "services/junctions/src/taught_path.h"

#include <algorithm>
#include <cmath>

#include "services/route/heading.h"

namespace trailcast::junctions {

TaughtPath::TaughtPath(std::span<const route::Segment> segments) {
  constexpr int kSteps = 8;  // for each segment
  Pose pose;
  poses_.push_back(pose);
  for (const route::Segment& segment : segments) {
    const double begin_rad = pose.heading_rad + segment.turn_before_rad;
    const double step_m = segment.length_m / kSteps;
    const double ahead_m = segment.reverse ? -step_m : step_m;
    for (int i = 0; i < kSteps; ++i) {
      pose.heading_rad = begin_rad + route::HeadingAt(segment.heading, (i + 0.5) * step_m);
      pose.x_m += ahead_m * std::cos(pose.heading_rad);
      pose.y_m += ahead_m * std::sin(pose.heading_rad);
      pose.along_m += step_m;
      poses_.push_back(pose);
    }
    pose.heading_rad = begin_rad + segment.heading_change_rad;
  }
}

TaughtPath::Pose TaughtPath::At(double along_m) const {
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), along_m,
                       [](const Pose& pose, double value) { return pose.along_m < value; });
  if (after == poses_.begin()) return poses_.front();
  if (after == poses_.end()) return poses_.back();
  const Pose& before = *std::prev(after);
  const double way_m = after->along_m - before.along_m;
  const double share = way_m > 0.0 ? (along_m - before.along_m) / way_m : 0.0;
  return {along_m, before.x_m + share * (after->x_m - before.x_m),
          before.y_m + share * (after->y_m - before.y_m), after->heading_rad};
}

std::optional<double> PathsAside::At(double along_m, double within_m) const {
  constexpr double kStep_m = 0.5;
  constexpr double kShortest_m = 4.0;
  const auto at = on_second_(along_m);
  if (!at) return std::nullopt;
  std::vector<std::pair<TaughtPath::Pose, TaughtPath::Pose>> pairs;
  for (double off_m = -within_m; off_m <= within_m; off_m += kStep_m) {
    const double there_m = along_m + off_m;
    if (there_m < 0.0 || there_m > first_.length_m()) continue;
    if (const auto on_second = on_second_(there_m)) {
      pairs.emplace_back(first_.At(there_m), second_.At(*on_second));
    }
  }
  const auto n = static_cast<double>(pairs.size());
  if (n * kStep_m < kShortest_m) return std::nullopt;
  TaughtPath::Pose middle;
  TaughtPath::Pose middle_b;
  for (const auto& [a, b] : pairs) {
    middle.x_m += a.x_m / n;
    middle.y_m += a.y_m / n;
    middle_b.x_m += b.x_m / n;
    middle_b.y_m += b.y_m / n;
  }
  double dot = 0.0;
  double cross = 0.0;
  for (const auto& [a, b] : pairs) {
    const double bx = b.x_m - middle_b.x_m;
    const double by = b.y_m - middle_b.y_m;
    dot += bx * (a.x_m - middle.x_m) + by * (a.y_m - middle.y_m);
    cross += bx * (a.y_m - middle.y_m) - by * (a.x_m - middle.x_m);
  }
  const double turn_rad = std::atan2(cross, dot);
  const TaughtPath::Pose here = first_.At(along_m);
  const TaughtPath::Pose there = second_.At(*at);
  const double bx = there.x_m - middle_b.x_m;
  const double by = there.y_m - middle_b.y_m;
  const double off_x = middle.x_m + std::cos(turn_rad) * bx - std::sin(turn_rad) * by - here.x_m;
  const double off_y = middle.y_m + std::sin(turn_rad) * bx + std::cos(turn_rad) * by - here.y_m;
  return std::cos(here.heading_rad) * off_y - std::sin(here.heading_rad) * off_x;
}

}  // namespace trailcast::junctions
