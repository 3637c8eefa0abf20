#include "agent/session/src/place/route_place.h"

#include <algorithm>
#include <iterator>

namespace trailcast::agent {
namespace {

belief::RouteBeliefOptions OptionsFor(bool metric) {
  belief::RouteBeliefOptions options;
  options.cell = metric ? 0.1 : 0.05;
  options.window = metric ? 1.0 : 0.75;
  return options;
}

}  // namespace

void RoutePlace::Learn(const route::Segment& segment, std::span<const route::KeyView> views,
                       std::span<const std::optional<double>> growths) {
  if (!belief_) {
    metric_ = segment.has_odometry;
    belief_.emplace(OptionsFor(metric_));
    begins_.push_back(0.0);
  }
  const double extent = metric_ ? segment.length_m : segment.duration_s;
  std::vector<belief::ViewPlace> places;
  places.reserve(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    places.push_back({views[i].s * extent, growths[i], !views[i].missed});
  }
  belief_->Extend(extent, places);
  begins_.push_back(begins_.back() + extent);
}

double RoutePlace::ExtentOf(SegmentIndex segment) const {
  return begins_[segment.value() + 1] - begins_[segment.value()];
}

double RoutePlace::AlongOf(const RoutePoint& point) const {
  return begins_[point.segment.value()] + point.fraction * ExtentOf(point.segment);
}

RoutePoint RoutePlace::PointAt(double along) const {
  // The last segment that begins there or before, and is not yet over.
  const auto after = std::upper_bound(std::next(begins_.begin()), std::prev(begins_.end()), along);
  const auto index = static_cast<std::uint32_t>(std::distance(begins_.begin(), after) - 1);
  const SegmentIndex segment(index);
  const double extent = ExtentOf(segment);
  const double fraction = extent > 0.0 ? (along - begins_[index]) / extent : 1.0;
  return {segment, std::clamp(fraction, 0.0, 1.0)};
}

}  // namespace trailcast::agent
