#include "services/view/weak_places.h"

#include <algorithm>
#include <utility>

#include "services/view/key_views.h"

namespace trailcast::view {
namespace {

// A follower keeps its place while five features agree there (services/belief). If a view has fewer
// than twice as many, hardly any other picture finds five of them, and if two successive views have
// fewer than this in common, there may be places between them that neither recognises. Odometry
// bridges that, and its routes have their views further apart. In views of a toy car's track, which
// is followed well, 0 of 63 have so little in common; in a night drive's it is 20 of 89.
constexpr std::size_t kFewestOfAView = 12;
constexpr int kFewestInCommon = 6;
constexpr int kFewestInCommonWithOdometry = 3;
// A segment with fewer features is bare: an estimate by odometry and three of them drifts.
constexpr std::size_t kFewestToSteerBy = 8;
constexpr double kSamePlace = 1e-3;  // a robot that turned on the spot

}  // namespace

const char* NameOf(Weakness why) {
  switch (why) {
    case Weakness::kBland:
      return "bland";
    case Weakness::kUnrelated:
      return "unrelated";
    case Weakness::kBare:
      break;
  }
  return "bare";
}

void WeakPlaceFinder::AddView(double at, const route::KeyView& view, int fewest_in_common) {
  View next{at, Tabulate(view.features, width_px_)};
  const double before = last_ ? 0.5 * (last_->at + at) : 0.0;
  if (last_ && last_->table.size() < kFewestOfAView) {
    places_.push_back(
        {bland_from_, before, Weakness::kBland, static_cast<int>(last_->table.size())});
  }
  if (last_ && at - last_->at > kSamePlace) {
    const int agreed = Compare(last_->table, next.table).agreed();
    if (agreed < fewest_in_common) {
      places_.push_back({last_->at, at, Weakness::kUnrelated, agreed});
    }
  }
  bland_from_ = before;
  last_ = std::move(next);
}

void WeakPlaceFinder::Add(const route::Segment& segment) {
  const double extent = segment.extent();
  const int fewest_in_common = segment.has_odometry ? kFewestInCommonWithOdometry : kFewestInCommon;
  for (const route::KeyView& view : ScoutViewsOf(segment)) {
    AddView(length_ + view.s * extent, view, fewest_in_common);
  }
  const bool is_bare = segment.has_odometry && segment.features.size() < kFewestToSteerBy;
  if (is_bare && extent > kSamePlace) {
    places_.push_back(
        {length_, length_ + extent, Weakness::kBare, static_cast<int>(segment.features.size())});
  }
  length_ += extent;
}

std::vector<WeakPlace> WeakPlaceFinder::Places() const {
  std::vector<WeakPlace> all = places_;
  if (!last_) {
    if (length_ > 0.0) all.push_back({0.0, length_, Weakness::kBland, 0});
  } else if (last_->table.size() < kFewestOfAView) {
    all.push_back({bland_from_, length_, Weakness::kBland, static_cast<int>(last_->table.size())});
  }
  std::stable_sort(all.begin(), all.end(), [](const WeakPlace& a, const WeakPlace& b) {
    return std::pair(a.why, a.begin) < std::pair(b.why, b.begin);
  });
  std::vector<WeakPlace> merged;
  for (const WeakPlace& place : all) {
    const bool goes_on = !merged.empty() && merged.back().why == place.why &&
                         place.begin - merged.back().end < kSamePlace;
    if (!goes_on) {
      merged.push_back(place);
      continue;
    }
    merged.back().end = place.end;
    merged.back().features = std::min(merged.back().features, place.features);
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const WeakPlace& a, const WeakPlace& b) { return a.begin < b.begin; });
  return merged;
}

}  // namespace trailcast::view
