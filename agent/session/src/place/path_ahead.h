#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/session/src/place/known_route.h"
#include "services/motion/motion.h"
#include "services/replay/passing.h"

namespace trailcast::agent {

// Returns the course of the route from `along_m` of a segment on, for `length_m`, or as far as it
// is known and driven without a stop.
[[nodiscard]] replay::PathAhead PathAheadOf(const KnownRoute& route, SegmentIndex index,
                                            double along_m, double length_m);

// This is a place on the path that leads to a segment's beginning.
struct PlaceBehind {
  SegmentIndex segment;
  double along_m = 0.0;  // along the segment
  motion::Pose2 pose;    // in the frame of that beginning: ahead, to the left
};

// Returns the one nearest to a position, no more than `furthest_m` back, and not before where the
// scout last drove backwards, or nothing if no path leads there.
[[nodiscard]] std::optional<PlaceBehind> NearestBehind(const KnownRoute& route, SegmentIndex index,
                                                       const Eigen::Vector2d& position,
                                                       double furthest_m);

}  // namespace trailcast::agent
