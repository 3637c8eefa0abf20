#include "agent/session/src/place/route_place.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trailcast::agent {
namespace {

constexpr double kGapLearns = 0.1;  // share of each gap between two key views

belief::RouteBeliefOptions OptionsFor(bool metric) {
  belief::RouteBeliefOptions options;
  options.cell = metric ? 0.1 : 0.02;
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
  paces_.push_back(metric_ ? segment.speed_mps() : PaceByViews(segment, views));
  const double extent = metric_ ? segment.length_m : paces_.back() * segment.duration_s;
  std::vector<belief::ViewPlace> places;
  places.reserve(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    places.push_back({views[i].s * extent, growths[i], !views[i].missed});
  }
  belief_->Extend(extent, places);
  begins_.push_back(begins_.back() + extent);
}

// The usual gap is a mean of logarithms, since it is as often twice as long as half as long.
double RoutePlace::PaceByViews(const route::Segment& segment,
                               std::span<const route::KeyView> views) {
  double from = 0.0;
  for (const route::KeyView& view : views) {
    if (view.missed) continue;
    const double gap_s = since_view_s_ + (view.s - from) * segment.duration_s;
    from = view.s;
    since_view_s_ = 0.0;
    if (gap_s <= 0.0) continue;
    if (!usual_gap_s_) usual_gap_s_ = gap_s;
    *usual_gap_s_ *= std::pow(gap_s / *usual_gap_s_, kGapLearns);
  }
  since_view_s_ += (1.0 - from) * segment.duration_s;
  const double gap_s = usual_gap_s_.value_or(since_view_s_);
  return gap_s > 0.0 ? 1.0 / (kViewsInUnit * gap_s) : 0.0;
}

double RoutePlace::ExtentOf(SegmentIndex segment) const {
  return begins_[segment.value() + 1] - begins_[segment.value()];
}

double RoutePlace::AlongOf(const RoutePoint& point) const {
  return begins_[point.segment.value()] + point.fraction * ExtentOf(point.segment);
}

RoutePoint RoutePlace::PointAt(double along) const {
  // This is the last segment that begins there or before, and is not over yet.
  const auto after = std::upper_bound(std::next(begins_.begin()), std::prev(begins_.end()), along);
  const auto index = static_cast<std::uint32_t>(std::distance(begins_.begin(), after) - 1);
  const SegmentIndex segment(index);
  const double extent = ExtentOf(segment);
  const double fraction = extent > 0.0 ? (along - begins_[index]) / extent : 1.0;
  return {segment, std::clamp(fraction, 0.0, 1.0)};
}

}  // namespace trailcast::agent
