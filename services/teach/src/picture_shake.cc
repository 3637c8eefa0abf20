#include "services/teach/picture_shake.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::teach {
namespace {

// A motion with a longer period than 2 pi times this is forgotten, twice: nods of 1 Hz are halved
// once.
constexpr double kForget_s = 0.3;
// After this long, nothing is left of what was before the sums began.
constexpr double kSettle_s = 3.0 * kForget_s;
constexpr std::size_t kFewest = 8;
// This share of the features, those that come past most slowly, is used. Features that are far
// away, or straight ahead, tell a nod from a robot that accelerates or brakes.
constexpr double kSlowShare = 0.5;
// After more than this between two pictures, the motion in between is unknown.
constexpr double kLongest_s = 0.25;

// This is the change of the speed at which one feature moves down the picture.
struct Change {
  double passing_px_per_s = 0.0;  // its own speed, without the camera's nodding
  double by_px_per_s = 0.0;
};

// Returns what the changes have in common, or nothing if they are too few to tell.
std::optional<double> CommonOf(std::vector<Change> changes) {
  if (changes.size() < kFewest) return std::nullopt;
  const auto slow = std::max<std::size_t>(
      kFewest, static_cast<std::size_t>(kSlowShare * static_cast<double>(changes.size())));
  std::nth_element(
      changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(slow) - 1, changes.end(),
      [](const Change& a, const Change& b) { return a.passing_px_per_s < b.passing_px_per_s; });
  changes.resize(slow);
  const auto middle = changes.begin() + std::ssize(changes) / 2;
  std::nth_element(changes.begin(), middle, changes.end(),
                   [](const Change& a, const Change& b) { return a.by_px_per_s < b.by_px_per_s; });
  return middle->by_px_per_s;
}

}  // namespace

void PictureShake::Begin(const std::vector<route::TrackedFeature>& features) {
  features_.clear();
  for (const route::TrackedFeature& feature : features) features_[feature.id] = {feature.v_px};
}

void PictureShake::Add(SensorTime stamp, const std::vector<route::TrackedFeature>& features,
                       bool drives) {
  const double dt_s = last_ ? Seconds(stamp - *last_) : 0.0;
  last_ = stamp;
  if (dt_s <= 0.0 || dt_s > kLongest_s) {
    rate_px_per_s_ = nod_px_ = seen_s_ = 0.0;
    Begin(features);
    return;
  }
  std::unordered_map<int, Motion> now;
  std::vector<Change> changes;
  for (const route::TrackedFeature& feature : features) {
    Motion& motion = now[feature.id];
    motion.v_px = feature.v_px;
    const auto before = features_.find(feature.id);
    if (before == features_.end()) continue;
    motion.rate_px_per_s = (feature.v_px - before->second.v_px) / dt_s;
    if (before->second.rate_px_per_s) {
      const double before_px_per_s = *before->second.rate_px_per_s;
      changes.push_back(
          {std::abs(before_px_per_s - rate_px_per_s_), *motion.rate_px_per_s - before_px_per_s});
    }
  }
  features_ = std::move(now);
  const std::optional<double> change = CommonOf(std::move(changes));
  Nod(change.value_or(0.0), dt_s);
  if (drives && change && seen_s_ > kSettle_s) window_.Add(nod_px_, dt_s);
}

void PictureShake::Nod(double rate_change_px_per_s, double dt_s) {
  const double kept = std::exp(-dt_s / kForget_s);
  rate_px_per_s_ = kept * rate_px_per_s_ + rate_change_px_per_s;
  nod_px_ = kept * nod_px_ + rate_px_per_s_ * dt_s;
  seen_s_ += dt_s;
}

std::optional<double> PictureShake::Measure() const {
  const auto spread = window_.Measure();
  if (!spread) return std::nullopt;
  return spread->deviation / height_px_;
}

}  // namespace trailcast::teach
