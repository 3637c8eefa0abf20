#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/base/ids.h"
#include "services/belief/route_belief.h"
#include "services/route/route.h"

namespace trailcast::agent {

// A place on a route, as followers know it.
struct RoutePoint {
  SegmentIndex segment;
  double fraction = 0.0;  // of that segment, 0 to 1
};

// The belief over a route's segments as they become known: its units, and which segment is where.
// Metres, or, where the route was taught without odometry, seconds of teaching in motion.
class RoutePlace {
 public:
  // Segments in order, with the places of their key views as fractions of them, and how much larger
  // each shows things than the one before it.
  void Learn(const route::Segment& segment, std::span<const route::KeyView> views,
             std::span<const std::optional<double>> growths);

  [[nodiscard]] belief::RouteBelief& belief() { return *belief_; }
  [[nodiscard]] const belief::RouteBelief& belief() const { return *belief_; }
  [[nodiscard]] bool known() const { return belief_.has_value(); }
  [[nodiscard]] bool metric() const { return metric_; }

  [[nodiscard]] double AlongOf(const RoutePoint& point) const;
  [[nodiscard]] RoutePoint PointAt(double along) const;
  [[nodiscard]] double ExtentOf(SegmentIndex segment) const;

 private:
  std::optional<belief::RouteBelief> belief_;
  bool metric_ = false;
  std::vector<double> begins_;  // of each segment, and the last one's end
};

}  // namespace trailcast::agent
