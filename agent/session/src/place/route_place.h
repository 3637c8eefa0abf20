#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/base/ids.h"
#include "services/belief/route_belief.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This is a place on a route, as followers know it.
struct RoutePoint {
  SegmentIndex segment;
  double fraction = 0.0;  // share of that segment, 0 to 1
};

// This maps places of the belief to a route's segments as they become known: its units, and which
// segment is where. The units are metres. If the route was taught without odometry, a unit is the
// time in which the moving scout took kViewsInUnit key views around there. So the change in the
// picture decides how well a place is known, and neither a clock nor a frame rate does.
class RoutePlace {
 public:
  static constexpr double kViewsInUnit = 4.0;

  // Takes segments in order, with the places of their key views as fractions of them, and how much
  // larger each shows things than the one before it.
  void Learn(const route::Segment& segment, std::span<const route::KeyView> views,
             std::span<const std::optional<double>> growths);

  [[nodiscard]] belief::RouteBelief& belief() { return *belief_; }
  [[nodiscard]] const belief::RouteBelief& belief() const { return *belief_; }
  [[nodiscard]] bool known() const { return belief_.has_value(); }
  [[nodiscard]] bool metric() const { return metric_; }

  [[nodiscard]] double AlongOf(const RoutePoint& point) const;
  [[nodiscard]] RoutePoint PointAt(double along) const;
  [[nodiscard]] double ExtentOf(SegmentIndex segment) const;
  // Returns the units in a second of teaching there.
  [[nodiscard]] double PaceAt(double along) const { return paces_[PointAt(along).segment.value()]; }

 private:
  [[nodiscard]] double PaceByViews(const route::Segment& segment,
                                   std::span<const route::KeyView> views);

  std::optional<belief::RouteBelief> belief_;
  bool metric_ = false;
  std::vector<double> begins_;  // of each segment; with the last one's end
  std::vector<double> paces_;   // of each segment
  // These are for a route without odometry: the usual time from one key view to the next, and the
  // time since the last.
  std::optional<double> usual_gap_s_;
  double since_view_s_ = 0.0;
};

}  // namespace trailcast::agent
