#include "services/teach/segment_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::teach {
namespace {

constexpr double kStandstill_m = 1e-3;
constexpr int kFewestKnots = 3;

// Less than this between two frames is a robot that waits: neither time nor track goes on.
constexpr double kStep_m = 1e-4;
constexpr double kStep_rad = 1e-4;

}  // namespace

void SegmentRecorder::Begin(SensorTime stamp, std::vector<route::DescribedFeature> features,
                            const std::optional<motion::Pose2>& odometry) {
  first_ = std::move(features);
  Moment first{stamp, 0.0, {}};
  for (const route::DescribedFeature& feature : first_) {
    first.features[feature.at.id] = feature.at;
  }
  moments_.clear();
  moments_.push_back(std::move(first));
  headings_.assign(1, {});
  moving_ = SensorTime{0};
  last_odometry_ = odometry;
}

bool SegmentRecorder::Add(SensorTime stamp, const std::vector<route::TrackedFeature>& tracked,
                          const std::optional<motion::Pose2>& odometry) {
  bool moved = true;
  if (odometry && last_odometry_) {
    const motion::OdometryIncrement step = motion::IncrementBetween(*last_odometry_, *odometry);
    moved = std::abs(step.distance_m) > kStep_m || std::abs(step.heading_change_rad) > kStep_rad;
    const HeadingSample before = headings_.back();
    if (moved) {
      headings_.push_back(
          {before.distance_m + step.distance_m, before.heading_rad + step.heading_change_rad});
    }
  }
  if (moved || !odometry) last_odometry_ = odometry;
  Moment moment{stamp, headings_.back().distance_m, {}};
  for (const route::TrackedFeature& feature : tracked) moment.features[feature.id] = feature;
  if (moved || moments_.size() == 1) {
    moving_ += stamp - moments_.back().stamp;
    moments_.push_back(std::move(moment));
  } else {
    moments_.back() = std::move(moment);
  }
  return distance_m() >= options_.longest_m ||
         static_cast<double>(tracked.size()) <
             options_.survival_share * static_cast<double>(first_.size());
}

double SegmentRecorder::FractionAt(const Moment& moment) const {
  const double length_m = moments_.back().distance_m;
  if (length_m > kStandstill_m) return std::clamp(moment.distance_m / length_m, 0.0, 1.0);
  const SensorTime begin = moments_.front().stamp;
  const double duration_s = Seconds(moments_.back().stamp - begin);
  return duration_s > 0.0 ? Seconds(moment.stamp - begin) / duration_s : 0.0;
}

int SegmentRecorder::KnotsFor(double length_m) const {
  if (!last_odometry_) return options_.knots;
  const int by_length = 1 + static_cast<int>(std::ceil(length_m / options_.knot_spacing_m));
  return std::min(std::max(by_length, kFewestKnots), options_.knots);
}

route::Feature SegmentRecorder::Store(const route::DescribedFeature& feature, int knots) const {
  route::Feature stored{feature.patch, feature.descriptor, {}};
  const auto knot_of = [&](const Moment& moment, double s) {
    const route::TrackedFeature& at = moment.features.at(feature.at.id);
    return route::TrackKnot{static_cast<float>(s), static_cast<float>(at.u_px),
                            static_cast<float>(at.v_px)};
  };
  stored.track.push_back(knot_of(moments_.front(), 0.0));
  std::size_t next = 1;
  for (int knot = 1; knot + 1 < knots; ++knot) {
    const double wanted = static_cast<double>(knot) / (knots - 1);
    while (next + 1 < moments_.size() && FractionAt(moments_[next]) < wanted) ++next;
    const double s = FractionAt(moments_[next]);
    // Knots come in strictly rising s; a robot that stood still gives fewer of them.
    if (s > stored.track.back().s && s < 1.0 && next + 1 < moments_.size()) {
      stored.track.push_back(knot_of(moments_[next], s));
    }
  }
  stored.track.push_back(knot_of(moments_.back(), 1.0));
  return stored;
}

std::size_t SegmentRecorder::MostFeatures(const route::Segment& segment) const {
  if (!segment.has_odometry) return first_.size();
  const auto by_length = static_cast<std::size_t>(options_.features_per_metre * segment.length_m);
  return std::max(options_.fewest_kept, by_length);
}

std::optional<route::Segment> SegmentRecorder::Finish() {
  const bool survivors = !moments_.empty() && !moments_.back().features.empty();
  if (moments_.size() < 2 || (!survivors && distance_m() < kStandstill_m)) return std::nullopt;
  route::Segment segment;
  segment.index = next_index_;
  next_index_ = SegmentIndex(next_index_.value() + 1);
  segment.has_odometry = last_odometry_.has_value();
  segment.duration_s = Seconds(moving_);
  if (segment.has_odometry) {
    segment.length_m = std::max(0.0, headings_.back().distance_m);
    segment.heading_change_rad = headings_.back().heading_rad;
    for (const HeadingSample& sample : headings_) {
      segment.heading_variation_rad =
          std::max(segment.heading_variation_rad, std::abs(sample.heading_rad));
    }
    segment.heading = FitHeading(headings_);
  }
  const std::size_t most = MostFeatures(segment);
  const int knots = KnotsFor(segment.length_m);
  for (const route::DescribedFeature& feature : first_) {
    if (segment.features.size() < most && moments_.back().features.contains(feature.at.id)) {
      segment.features.push_back(Store(feature, knots));
    }
  }
  moments_.clear();
  return segment;
}

}  // namespace trailcast::teach
