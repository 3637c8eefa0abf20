#pragma once

#include <optional>
#include <vector>

#include "services/junctions/weighed.h"
#include "services/route/route.h"
#include "services/view/view_table.h"

namespace trailcast::junctions {

// The key views of a route, or of a section of one, prepared for comparison with another's.
class RouteViews {
 public:
  struct View {
    double along = 0.0;    // from the route's beginning, in its units
    double heading = 0.0;  // taught heading in radians from the route's beginning,
                           // counter-clockwise positive
    bool reverse = false;  // the robot drove backwards
    // The logarithm of how much things grow in the picture a unit further along; 0 if not known.
    double growth = 0.0;
    view::ViewTable table;
  };

  // `width_px` is the width of the scout's pictures, above 0; `along` is where the first segment
  // begins.
  explicit RouteViews(int width_px, double along = 0.0)
      : width_px_(width_px), along_(along), begin_(along) {}

  // Adds the next segment.
  void Add(const route::Segment& segment);

  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  // Says whether its units are metres. A route taught without odometry has seconds of teaching.
  [[nodiscard]] bool metric() const { return metric_; }
  // Returns by how many half widths a radian of turning shifts the picture, as learnt from the
  // taught turns: 1.7 in the middle of a picture of 60 degrees. It is nothing if the route never
  // turns.
  [[nodiscard]] std::optional<double> half_widths_a_radian() const;
  // Returns the taught heading there, interpolated between views, of which there must be some.
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

}  // namespace trailcast::junctions
