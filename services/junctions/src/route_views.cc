#include "services/junctions/route_views.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "services/route/heading.h"
#include "services/view/key_views.h"

namespace trailcast::junctions {

// Returns the scale and shift that map the features from a segment's first picture to its last, in
// the least-squares sense. It is nothing if they are too few.
std::optional<RouteViews::Change> RouteViews::ChangeAlong(const route::Segment& segment) const {
  constexpr std::size_t kEnough = 6;
  if (segment.features.size() < kEnough) return std::nullopt;
  const auto n = static_cast<double>(segment.features.size());
  double first_u = 0.0, first_v = 0.0, last_u = 0.0, last_v = 0.0;
  for (const route::Feature& feature : segment.features) {
    first_u += feature.first().u_px / n;
    first_v += feature.first().v_px / n;
    last_u += feature.milestone().u_px / n;
    last_v += feature.milestone().v_px / n;
  }
  double cross = 0.0, square = 0.0;
  for (const route::Feature& feature : segment.features) {
    const double du = feature.first().u_px - first_u;
    const double dv = feature.first().v_px - first_v;
    cross += du * (feature.milestone().u_px - last_u) + dv * (feature.milestone().v_px - last_v);
    square += du * du + dv * dv;
  }
  if (square <= 0.0 || cross <= 0.0) return std::nullopt;
  const double scale = cross / square;
  return Change{scale, 2.0 / width_px_ * (last_u - scale * first_u)};
}

void RouteViews::Add(const route::Segment& segment) {
  constexpr double kLeastTurn_rad = 0.1;
  constexpr double kLeastExtent = 1e-3;
  if (views_.empty() && along_ == begin_) metric_ = segment.has_odometry;
  const double extent = segment.extent();
  heading_ += segment.turn_before_rad;
  const auto change = ChangeAlong(segment);
  const double growth =
      change && extent > kLeastExtent ? std::max(0.0, std::log(change->scale) / extent) : 0.0;
  const double turn = segment.heading_change_rad;
  if (change && std::abs(turn) > kLeastTurn_rad) {
    turns_.push_back({change->shift_u / turn, std::abs(turn)});
  }
  for (const route::KeyView& key : view::ScoutViewsOf(segment)) {
    views_.push_back({along_ + key.s * extent,
                      heading_ + route::HeadingAt(segment.heading, key.s * segment.length_m),
                      segment.reverse, growth, view::Tabulate(key.features, width_px_)});
  }
  along_ += extent;
  heading_ += segment.heading_change_rad;
}

double RouteViews::HeadingAt(double along) const {
  const auto after = std::find_if(views_.begin(), views_.end(),
                                  [&](const View& view) { return view.along > along; });
  if (after == views_.begin()) return views_.front().heading;
  if (after == views_.end()) return views_.back().heading;
  const auto before = std::prev(after);
  const double share = (along - before->along) / (after->along - before->along);
  return before->heading + share * (after->heading - before->heading);
}

std::optional<double> RouteViews::half_widths_a_radian() const {
  constexpr double kEnough_rad = 0.5;
  constexpr double kLeast = 0.2;  // a mirror that sees all round has 0.3
  double turned = 0.0;
  for (const Weighed& each : turns_) turned += each.weight;
  if (turned < kEnough_rad) return std::nullopt;
  const double told = *Median(turns_);
  return told > kLeast ? std::optional(told) : std::nullopt;
}

}  // namespace trailcast::junctions
