#include "agent/session/src/path_ahead.h"

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

}  // namespace trailcast::agent
