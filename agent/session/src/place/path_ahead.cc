#include "agent/session/src/place/path_ahead.h"

#include <algorithm>
#include <cmath>

#include "services/route/heading.h"

namespace trailcast::agent {

replay::PathAhead PathAheadOf(const KnownRoute& route, SegmentIndex index, double along_m,
                              double length_m) {
  constexpr double kStep_m = replay::Passing::kApart_m;
  replay::PathAhead path{Eigen::Vector2d::Zero()};
  const auto heading_in = [&](std::size_t segment, double at_m) {
    return route::HeadingAt(route.segments()[segment].heading, std::max(0.0, at_m));
  };
  std::size_t i = index.value();
  double at_m = along_m + 0.5 * kStep_m;
  double begin_rad = -heading_in(i, along_m);  // heading of the segment's beginning
  for (double driven_m = kStep_m; driven_m <= length_m + 1e-9; driven_m += kStep_m) {
    while (at_m > route.segments()[i].length_m) {
      if (!route.has(i + 1) || route.stands_after(route.segments()[i].index)) return path;
      begin_rad += heading_in(i, route.segments()[i].length_m);
      at_m -= route.segments()[i++].length_m;
    }
    const double heading_rad = begin_rad + heading_in(i, at_m);
    path.emplace_back(path.back() +
                      kStep_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
    at_m += kStep_m;
  }
  return path;
}

std::optional<PlaceBehind> NearestBehind(const KnownRoute& route, SegmentIndex index,
                                         const Eigen::Vector2d& position, double furthest_m) {
  constexpr double kStep_m = 0.02;
  std::optional<PlaceBehind> nearest;
  double nearest_m = 0.0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double end_rad = 0.0;  // heading of the path where it reaches `at`
  double back_m = 0.0;
  for (std::size_t i = index.value(); i > 0 && back_m < furthest_m; --i) {
    const route::Segment& segment = route.segments()[i - 1];
    if (segment.reverse || route.segments()[i].reverse) break;
    end_rad -= route.segments()[i].turn_before_rad;
    const auto heading_at = [&](double along_m) {
      return end_rad + route::HeadingAt(segment.heading, along_m) -
             route::HeadingAt(segment.heading, segment.length_m);
    };
    for (double along_m = segment.length_m; back_m < furthest_m;) {
      const double off_m = (at - position).norm();
      if (!nearest || off_m < nearest_m) {
        nearest = {segment.index, along_m, {at.x(), at.y(), heading_at(along_m)}};
        nearest_m = off_m;
      }
      if (along_m <= 0.0) break;
      const double step_m = std::min(kStep_m, along_m);
      const double heading_rad = heading_at(along_m - 0.5 * step_m);
      at -= step_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
      along_m -= step_m;
      back_m += step_m;
    }
    end_rad = heading_at(0.0);
  }
  return nearest;
}

}  // namespace trailcast::agent
