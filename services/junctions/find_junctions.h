#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "services/junctions/route_views.h"

namespace trailcast::junctions {

struct JunctionOptions {
  view::ComparisonOptions comparison;
  // Two views must have so many features that agree to count at all; more count for more.
  int least_agreed = 5;
  // Seen from one place with cameras of one kind, things look equally large. A difference of this
  // much in its logarithm (one sigma) means that the views are from different places. The second
  // value is for cameras that magnify differently: their features match only if they look equally
  // large, so the size says less about the place.
  double log_scale_sigma = 0.2;
  double other_camera_sigma = 0.4;
  // A shift of this much between two views (one sigma, in half widths) makes them count for less:
  // in a turn, views further along match too, and are shifted more.
  double shift_sigma = 0.6;
  // How far apart two views that match are (one sigma), in metres, or in seconds of teaching
  // without odometry. This, the noise of how large things look, and how fast they grow tell where
  // things look equally large.
  double off_sigma_m = 4.0;
  double off_sigma_s = 0.1;
  double log_scale_noise = 0.05;
  // The largest gap between consecutive pairs of views of one junction: so many views on either
  // route, or so many units, whichever is further.
  std::size_t most_passed_over = 3;
  double most_apart = 3.0;
  // How far the two distances between consecutive pairs of views may differ: so many metres, and a
  // share of the longer one. Teaching without odometry differs by a factor.
  double slack_m = 1.0;
  double slack_share = 0.3;
  double most_pace = 3.0;
  // A route comes back to an earlier place only after least_loop, in its units, and only after it
  // has gone as far as the two parts run together; sure_loop is enough for any part.
  double least_loop = 2.0;
  double sure_loop = 8.0;
  // A junction needs so many pairs of views, and so many features more than agree by chance.
  std::size_t least_views = 3;
  double least_evidence = 8.0;
  std::size_t most_junctions = 20;  // between two routes
  // Only so many pairs of matching views are examined. Where everything looks alike, this finds
  // nothing among the rest.
  std::size_t most_alike = 20'000;
  // Called now and then; true ends the search with what is found so far.
  std::function<bool()> give_up{};
};

// A place at which two routes come together, looking the same way, and run on together.
struct Junction {
  double at_a = 0.0;  // where they come together, in the units of each
  double at_b = 0.0;
  double end_a = 0.0;
  double end_b = 0.0;
  int views = 0;            // pairs of views, in order along both
  int features = 0;         // their features that match and that one scale and shift map onto each
                            // other
  double evidence = 0.0;    // how many more features that is than agree by chance
  double confidence = 0.0;  // 0.5 to 1
  // How much further left the second route looks, in radians. The shift of its pictures by a radian
  // is known if it turned; otherwise a camera of 60 degrees is assumed.
  double heading_rad = 0.0;
  bool heading_scaled = false;  // its turns tell the scale
  // The logarithm of how much larger the second route's camera shows things.
  double log_scale = 0.0;

  [[nodiscard]] double length() const { return end_a - at_a; }
  bool operator==(const Junction&) const = default;
};

// Finds junctions by matching views at neighbouring places in order, the surest first. With
// `same_camera` things look equally large in both routes at one place. Otherwise turns on both
// routes tell how much larger they look, and without turns places are less certain. Sections driven
// backwards are left out. The lateral distance between the routes is not known. It is
// deterministic.
[[nodiscard]] std::vector<Junction> FindJunctions(const RouteViews& a, const RouteViews& b,
                                                  bool same_camera,
                                                  const JunctionOptions& options = {});
// Finds where a route comes back to an earlier place, which is `at_a`.
[[nodiscard]] std::vector<Junction> FindLoops(const RouteViews& route,
                                              const JunctionOptions& options = {});

}  // namespace trailcast::junctions
