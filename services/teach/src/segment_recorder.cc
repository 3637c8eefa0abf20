#include "services/teach/segment_recorder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "services/teach/picture_turn.h"

namespace trailcast::teach {
namespace {

constexpr int kFewestKnots = 3;
constexpr std::size_t kFewestToTellStill = 4;

// A robot that moves less than this between two frames waits: neither time nor track goes on.
constexpr double kStep_m = 1e-4;
constexpr double kStep_rad = 1e-4;

}  // namespace

void SegmentRecorder::Begin(SensorTime stamp, std::vector<route::DescribedFeature> features,
                            const std::optional<motion::Pose2>& odometry) {
  first_ = std::move(features);
  Moment first;
  for (const route::DescribedFeature& feature : first_) {
    first.features[feature.at.id] = feature.at;
  }
  moved_features_ = first.features;
  moments_.clear();
  moments_.push_back(std::move(first));
  last_stamp_ = stamp;
  moved_odometry_ = odometry;
  if (other_way_from_) way_ = -way_;
  other_way_from_.reset();
  if (!turning_) turn_ = SpotTurnWatch();  // a possible beginning of a turn counts as driven
}

bool SegmentRecorder::Moved(const Features& tracked,
                            const std::optional<motion::OdometryIncrement>& step) const {
  if (step) {
    return std::abs(step->distance_m) > kStep_m || std::abs(step->heading_change_rad) > kStep_rad;
  }
  std::vector<double> moved_px;
  for (const auto& [id, feature] : tracked) {
    const auto before = moved_features_.find(id);
    if (before == moved_features_.end()) continue;
    moved_px.push_back(
        std::hypot(feature.u_px - before->second.u_px, feature.v_px - before->second.v_px));
  }
  if (moved_px.size() < kFewestToTellStill) return true;
  const auto middle = moved_px.begin() + std::ssize(moved_px) / 2;
  std::nth_element(moved_px.begin(), middle, moved_px.end());
  return *middle >= still_px_;
}

// Returns the turn since the robot last moved, by its picture.
double SegmentRecorder::SeenTurn(const std::vector<route::TrackedFeature>& tracked) const {
  std::vector<MovedFeature> moved;
  for (const route::TrackedFeature& feature : tracked) {
    const auto before = moved_features_.find(feature.id);
    if (before != moved_features_.end()) moved.push_back({before->second, feature});
  }
  return TurnOf(FlowOf(moved, still_px_), width_px_);
}

bool SegmentRecorder::LongEnough() const {
  if (moments_.empty()) return false;
  return moved_odometry_ ? distance_m() >= options_.shortest_m
                         : Seconds(moments_.back().moving) >= options_.shortest_s;
}

// Handles a robot that turns on the spot, or may do so.
SegmentRecorder::Event SegmentRecorder::TurnOnTheSpot(SpotTurnWatch::State before) {
  using State = SpotTurnWatch::State;
  if (before == State::kDrives && turn_.state() != State::kDrives) turn_from_ = moments_.size();
  if (turning_ && turn_.state() == State::kDrives) {
    turning_ = false;
    turn_before_rad_ += turn_.turned_rad();
    return Event::kEnds;
  }
  if (turn_.state() == State::kTurns) {
    turning_ = true;
    furthest_.reset();
    return Event::kTurns;
  }
  return Event::kGoesOn;
}

// Handles a robot that drives, perhaps back. Once it is further than it has been, `step` becomes
// what it has come further.
SegmentRecorder::Way SegmentRecorder::Follow(const motion::Pose2& from, const motion::Pose2& now,
                                             motion::OdometryIncrement& step) {
  if (!furthest_) {
    if (way_ * motion::Between(from, now).x_m >= 0.0) return Way::kOn;
    furthest_ = from;
  }
  const double on_m = way_ * motion::Between(*furthest_, now).x_m;
  if (on_m < -options_.shunt_m) {
    other_way_from_ = PlaceOf(motion::Between(*std::exchange(furthest_, std::nullopt), now));
    return Way::kOther;
  }
  if (on_m < -kStep_m) return Way::kBehind;
  step = motion::IncrementBetween(*furthest_, now);
  furthest_.reset();
  return Way::kOn;
}

// Returns the robot's place in this segment, with its heading, when it goes on the other way.
// `back` is its pose relative to the furthest that it came.
SegmentRecorder::Moment SegmentRecorder::PlaceOf(const motion::Pose2& back) const {
  Moment place;
  place.distance_m = moments_.back().distance_m + way_ * back.x_m;
  place.heading_rad = moments_.back().heading_rad + back.heading_rad;
  return place;
}

SegmentRecorder::Event SegmentRecorder::Add(SensorTime stamp,
                                            const std::vector<route::TrackedFeature>& tracked,
                                            const std::optional<motion::Pose2>& odometry) {
  advanced_ = false;
  Features features;
  for (const route::TrackedFeature& feature : tracked) features[feature.id] = feature;
  std::optional<motion::OdometryIncrement> step;
  if (odometry && moved_odometry_) {
    step = motion::IncrementBetween(*moved_odometry_, *odometry);
  }
  const bool moved = Moved(features, step);
  const double seen_turn_rad = moved && !step ? SeenTurn(tracked) : 0.0;
  const std::optional<motion::Pose2> from = moved_odometry_;
  const SensorTime took = stamp - last_stamp_;
  last_stamp_ = stamp;
  if (moved) {
    moved_odometry_ = odometry;
    moved_features_ = features;
  }
  if (step && moved) {
    const SpotTurnWatch::State before = turn_.state();
    std::ignore = turn_.Add(*step);
    const Event event = TurnOnTheSpot(before);
    if (event != Event::kGoesOn) return event;
    const Way way = Follow(*from, *odometry, *step);
    if (way == Way::kOther) return Event::kEnds;
    if (way == Way::kBehind) return Event::kGoesOn;
  } else if (turning_) {
    return Event::kTurns;
  }

  Moment moment = moments_.back();
  if (moved) {
    moment.key_views.clear();
    moment.moving += took;
    moment.distance_m += step ? way_ * step->distance_m : 0.0;
    moment.heading_rad += step ? step->heading_change_rad : seen_turn_rad;
  }
  moment.features = std::move(features);
  advanced_ = moved;
  if (moved) {
    moments_.push_back(std::move(moment));
  } else {
    moments_.back() = std::move(moment);
  }
  const bool few = static_cast<double>(tracked.size()) <
                   options_.survival_share * static_cast<double>(first_.size());
  const bool ends = distance_m() >= options_.longest_m || (few && LongEnough());
  // Features of people who stood by a standing robot are lost when they leave.
  const bool not_begun = few && moments_.size() == 1;
  return ends || not_begun ? Event::kEnds : Event::kGoesOn;
}

void SegmentRecorder::Keep(const route::View& view) {
  if (behind()) return;
  if (turning_) {
    views_before_.push_back(view);
  } else if (!moments_.empty()) {
    moments_.back().key_views.push_back(view);
  }
}

void SegmentRecorder::PutBefore(std::vector<route::View> views) {
  std::move(views.begin(), views.end(), std::back_inserter(views_before_));
}

double SegmentRecorder::FractionAt(const Moment& moment) const {
  const double length_m = moments_.back().distance_m;
  if (length_m > 0.0) return std::clamp(moment.distance_m / length_m, 0.0, 1.0);
  const double duration_s = Seconds(moments_.back().moving);
  return duration_s > 0.0 ? Seconds(moment.moving) / duration_s : 0.0;
}

int SegmentRecorder::KnotsFor(double length_m) const {
  if (!moved_odometry_) return options_.knots;
  const int by_length = 1 + static_cast<int>(std::ceil(length_m / options_.knot_spacing_m));
  return std::min(std::max(by_length, kFewestKnots), options_.knots);
}

route::Feature SegmentRecorder::Store(const route::DescribedFeature& feature, int knots) const {
  route::Feature stored{feature.patch, {}, {}};
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
    // Knots come in strictly rising s, so a robot that stood gets fewer of them.
    if (s > stored.track.back().s && s < 1.0 && next + 1 < moments_.size()) {
      stored.track.push_back(knot_of(moments_[next], s));
    }
  }
  stored.track.push_back(knot_of(moments_.back(), 1.0));
  return stored;
}

// Views that were seen before the segment's first image are put at its beginning.
std::vector<route::KeyView> SegmentRecorder::TakeKeyViews() {
  std::vector<route::KeyView> views;
  for (route::View& view : std::exchange(views_before_, {}))
    views.push_back({0.0, std::move(view)});
  for (Moment& moment : moments_) {
    const double s = FractionAt(moment);
    for (route::View& view : moment.key_views) views.push_back({s, std::move(view)});
  }
  return views;
}

std::size_t SegmentRecorder::MostFeatures(const route::Segment& segment) const {
  if (!segment.has_odometry) return first_.size();
  const auto by_length = static_cast<std::size_t>(options_.features_per_metre * segment.length_m);
  return std::max(options_.fewest_kept, by_length);
}

// Returns the position of the first moment that is not part of the segment, because it was seen
// before it was clear that the robot turns on the spot or goes on the other way.
std::size_t SegmentRecorder::End() const {
  if (turning_) return std::min(turn_from_, moments_.size());
  std::size_t end = moments_.size();
  if (!other_way_from_) return end;
  while (end > 1 && moments_[end - 1].distance_m > other_way_from_->distance_m) --end;
  return end;
}

// Gives each moment of a scout without odometry the place that its pictures tell.
void SegmentRecorder::DriveBySight() {
  std::vector<VisualOdometry::Moment> seen;
  seen.reserve(moments_.size());
  for (const Moment& moment : moments_) {
    seen.push_back({Seconds(moment.moving), &moment.features, moment.heading_rad});
  }
  const std::vector<VisualOdometry::Place> places = visual_odometry_.Follow(seen);
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i].distance_m = places[i].way_m;
    moments_[i].heading_rad = places[i].turned_rad;
  }
}

std::vector<HeadingSample> SegmentRecorder::Headings() const {
  std::vector<HeadingSample> headings;
  headings.reserve(moments_.size());
  for (const Moment& moment : moments_) {
    headings.push_back({moment.distance_m, moment.heading_rad});
  }
  return headings;
}

std::optional<route::Segment> SegmentRecorder::Finish() {
  std::vector<route::View> later_views;
  for (std::size_t i = End(); i < moments_.size(); ++i) {
    std::move(moments_[i].key_views.begin(), moments_[i].key_views.end(),
              std::back_inserter(later_views));
  }
  moments_.resize(End());
  if (!LongEnough()) {
    if (other_way_from_) {
      turn_before_rad_ += other_way_from_->heading_rad;
    } else if (turning_ && !moments_.empty()) {
      turn_before_rad_ += moments_.back().heading_rad;
    }
    for (Moment& moment : moments_) PutBefore(std::move(moment.key_views));
    PutBefore(std::move(later_views));
    moments_.clear();
    return std::nullopt;
  }
  route::Segment segment;
  segment.index = next_index_;
  next_index_ = SegmentIndex(next_index_.value() + 1);
  segment.has_odometry = moved_odometry_.has_value();
  segment.duration_s = Seconds(moments_.back().moving);
  if (segment.has_odometry) {
    segment.length_m = moments_.back().distance_m;
    segment.heading_change_rad = moments_.back().heading_rad;
    segment.turn_before_rad = std::exchange(turn_before_rad_, 0.0);
    segment.reverse = way_ < 0.0;
    if (other_way_from_)
      turn_before_rad_ = other_way_from_->heading_rad - moments_.back().heading_rad;
    for (const Moment& moment : moments_) {
      segment.heading_variation_rad =
          std::max(segment.heading_variation_rad, std::abs(moment.heading_rad));
    }
    segment.heading = FitHeading(Headings());
  } else {
    DriveBySight();
    segment.seen_way = route::SeenWay{moments_.back().distance_m, FitHeading(Headings())};
  }
  const std::size_t most = MostFeatures(segment);
  const int knots = KnotsFor(segment.length_m);
  for (const route::DescribedFeature& feature : first_) {
    if (segment.features.size() < most && moments_.back().features.contains(feature.at.id)) {
      segment.features.push_back(Store(feature, knots));
    }
  }
  segment.key_views = TakeKeyViews();
  PutBefore(std::move(later_views));
  moments_.clear();
  return segment;
}

}  // namespace trailcast::teach
