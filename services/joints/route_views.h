#pragma once

#include <optional>
#include <vector>

#include "services/joints/weighed.h"
#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::joints {

// The key views of a route, or of a stretch of one, ready to be compared with another's.
class RouteViews {
 public:
  struct View {
    double along = 0.0;    // from the route's beginning, in its units
    double heading = 0.0;  // taught, radians from the route's beginning, counter-clockwise positive
    bool reverse = false;  // the robot drove backwards
    // By how much of its logarithm things grow in the picture, a unit further along; 0: not known.
    double growth = 0.0;
    view::ViewTable table;
  };

  // `width_px`: of the scout's pictures, above 0. `along`: where the first segment begins.
  explicit RouteViews(int width_px, double along = 0.0)
      : width_px_(width_px), along_(along), begin_(along) {}

  // The next segment, in order.
  void Add(const route::Segment& segment);

  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  // Whether its units are metres, or, of a route taught without odometry, seconds of teaching.
  [[nodiscard]] bool metric() const { return metric_; }
  // By how many half widths of the picture a radian of turning shifts it, by what was taught in
  // turns: of a camera of 60 degrees in the middle of its picture 1.7. Nothing if it never turned.
  [[nodiscard]] std::optional<double> half_widths_a_radian() const;
  // Taught heading there, straight between views. Not of a route without views.
  [[nodiscard]] double HeadingAt(double along) const;
  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return along_; }

 private:
  struct Change {
    double scale = 1.0;
    double shift_u = 0.0;  // half widths
  };
  [[nodiscard]] std::optional<Change> ChangeAlong(const route::Segment& segment) const;

  int width_px_;
  double along_;
  double begin_;
  double heading_ = 0.0;
  bool metric_ = true;
  std::vector<View> views_;
  std::vector<Weighed> turns_;  // half widths a radian, by radians turned
};

}  // namespace trailcast::joints
