#include "services/refresh/refresh.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "services/refresh/src/added_views.h"
#include "services/refresh/src/missed.h"
#include "services/route/codec.h"

namespace trailcast::refresh {
namespace {

using route::Feature;
using route::Segment;

// A feature that no scout could have taught is not of this kind of route.
bool IsSound(const Feature& feature) {
  if (feature.track.size() < 2 || feature.track.size() > route::kMaxKnots) return false;
  float last_s = -1.0F;
  for (const route::TrackKnot& knot : feature.track) {
    if (!(knot.s > last_s) || knot.s > 1.0F || !std::isfinite(knot.u_px) ||
        !std::isfinite(knot.v_px)) {
      return false;
    }
    last_s = knot.s;
  }
  return feature.first().s == 0.0F && feature.milestone().s == 1.0F;
}

void Count(std::size_t all, const std::vector<Sought>& sought, RefreshCounts& counts) {
  if (sought.empty()) counts.unjudged += static_cast<int>(all);
  for (const Sought each : sought) {
    (each == Sought::kFound    ? counts.found
     : each == Sought::kMissed ? counts.missed
                               : counts.unjudged) += 1;
  }
}

// Drops those that were missed for longest first.
int Drop(std::size_t most, const RefreshOptions& options, Segment& segment) {
  std::vector<Feature>& features = segment.features;
  int dropped = 0;
  while (most > 0 && features.size() > options.fewest_left) {
    const auto worst =
        std::max_element(features.begin(), features.end(),
                         [](const Feature& a, const Feature& b) { return a.missed < b.missed; });
    if (worst->missed < options.missed_to_drop) break;
    features.erase(worst);
    --most;
    ++dropped;
  }
  return dropped;
}

int Add(const std::vector<Feature>& offered, std::size_t most, std::size_t most_bytes,
        Segment& segment) {
  int added = 0;
  for (const Feature& feature : offered) {
    if (most == 0 || segment.features.size() >= route::kMaxFeatures) break;
    if (!IsSound(feature)) continue;
    segment.features.push_back(feature);
    segment.features.back().missed = 0;
    segment.features.back().descriptor = {};  // key views have descriptors
    if (route::Encode(segment).size() > most_bytes) {
      segment.features.pop_back();
      break;
    }
    --most;
    ++added;
  }
  return added;
}

bool Speaks(const std::vector<Sought>& sought, std::size_t of) {
  return sought.empty() || sought.size() == of;
}

Result<void> CheckFits(const std::vector<Segment>& route, const Visit& visit) {
  std::size_t next = 0;
  for (const SegmentVisit& each : visit.segments) {
    const std::size_t index = each.index.value();
    if (index < next || index >= route.size() ||
        !Speaks(each.features, route[index].features.size()) ||
        !Speaks(each.views, route[index].key_views.size())) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the visit speaks of {} features and {} key views of segment {}: it is not one "
                  "of this route",
                  each.features.size(), each.views.size(), index);
    }
    next = index + 1;
  }
  return {};
}

// `what` names the counted things for people.
Result<void> CheckBelievable(const RefreshCounts& counts, const char* what,
                             const RefreshOptions& options) {
  if (counts.found_share() < options.least_found_share) {
    return Fail(ErrorCode::kUnavailable,
                "of the {} that should have been seen {:.0f} % were found, less than {:.0f} %: "
                "nothing is learnt from such a visit",
                what, 100.0 * counts.found_share(), 100.0 * options.least_found_share);
  }
  const int judged = counts.found + counts.missed;
  if (judged < options.least_judged_share * (judged + counts.unjudged)) {
    return Fail(ErrorCode::kUnavailable,
                "{} of {} {} could be judged, less than {:.0f} %: nothing is learnt from such a "
                "visit",
                judged, judged + counts.unjudged, what, 100.0 * options.least_judged_share);
  }
  return {};
}

void RefreshFeatures(const SegmentVisit& visit, std::size_t most_bytes,
                     const RefreshOptions& options, Segment& segment, RefreshCounts& counts) {
  if (visit.features.empty()) return;
  const auto most = static_cast<std::size_t>(
      std::ceil(options.most_share * static_cast<double>(segment.features.size())));
  for (std::size_t i = 0; i < visit.features.size(); ++i) {
    NoteVisit(visit.features[i], segment.features[i].missed);
  }
  counts.dropped += Drop(most, options, segment);
  counts.added += Add(visit.offered, most, most_bytes, segment);
}

}  // namespace

Result<Refreshed> Refresh(const std::vector<Segment>& route, const Visit& visit,
                          const RefreshOptions& options) {
  if (auto fits = CheckFits(route, visit); !fits) return tl::unexpected(fits.error());
  static const SegmentVisit kNothing{};
  std::vector<const SegmentVisit*> visits(route.size(), &kNothing);
  for (const SegmentVisit& each : visit.segments) visits[each.index.value()] = &each;
  Refreshed refreshed{route, {}, {}};
  double bytes = 0.0;
  double length_m = 0.0;
  for (std::size_t i = 0; i < route.size(); ++i) {
    Count(route[i].features.size(), visits[i]->features, refreshed.counts);
    Count(route[i].key_views.size(), visits[i]->views, refreshed.views);
    bytes += static_cast<double>(route::Encode(route[i]).size());
    length_m += route[i].length_m;
  }
  const auto features = CheckBelievable(refreshed.counts, "features", options);
  const auto views = CheckBelievable(refreshed.views, "key views", options);
  if (!features && !views) {
    const bool by_features = refreshed.counts.found + refreshed.counts.missed > 0;
    return tl::unexpected(by_features ? features.error() : views.error());
  }
  // The route's spare bytes are shared among its segments by length. A segment of a sharp turn has
  // more bytes a metre than others, and keeps them.
  const double spare_per_m =
      length_m > 0.0 ? std::max(0.0, options.most_bytes_per_m - bytes / length_m) : 0.0;
  for (std::size_t i = 0; i < route.size(); ++i) {
    Segment& segment = refreshed.segments[i];
    const auto most_bytes = static_cast<std::size_t>(
        static_cast<double>(route::Encode(segment).size()) + spare_per_m * segment.length_m);
    if (features) RefreshFeatures(*visits[i], most_bytes, options, segment, refreshed.counts);
    if (!views) continue;
    const bool weighs = segment.has_odometry;
    RefreshViews(*visits[i], weighs ? std::optional(most_bytes) : std::nullopt, options, segment,
                 refreshed.views);
  }
  return refreshed;
}

}  // namespace trailcast::refresh
