#include "services/refresh/refresh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "services/route/codec.h"

namespace trailcast::refresh {
namespace {

using route::Feature;
using route::Segment;

constexpr std::uint8_t kMostMissed = std::numeric_limits<std::uint8_t>::max();

// Whoever offers what no scout could have taught is not of this route's kind.
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

void Count(const Segment& segment, const std::vector<Sought>& sought, RefreshCounts& counts) {
  if (sought.empty()) counts.unjudged += static_cast<int>(segment.features.size());
  for (const Sought each : sought) {
    (each == Sought::kFound    ? counts.found
     : each == Sought::kMissed ? counts.missed
                               : counts.unjudged) += 1;
  }
}

void NoteMissed(const std::vector<Sought>& sought, Segment& segment) {
  for (std::size_t i = 0; i < sought.size(); ++i) {
    std::uint8_t& missed = segment.features[i].missed;
    if (sought[i] == Sought::kFound) missed = 0;
    if (sought[i] == Sought::kMissed && missed < kMostMissed) ++missed;
  }
}

// The longest missed first.
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
    segment.features.back().descriptor = {};  // key views have them
    if (route::Encode(segment).size() > most_bytes) {
      segment.features.pop_back();
      break;
    }
    --most;
    ++added;
  }
  return added;
}

Result<void> CheckFits(const std::vector<Segment>& route, const Visit& visit) {
  std::size_t next = 0;
  for (const SegmentVisit& each : visit.segments) {
    const std::size_t index = each.index.value();
    if (index < next || index >= route.size() ||
        each.features.size() != route[index].features.size()) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the visit speaks of {} features of segment {}: it is not one of this route",
                  each.features.size(), index);
    }
    next = index + 1;
  }
  return {};
}

Result<void> CheckBelievable(const RefreshCounts& counts, const RefreshOptions& options) {
  if (counts.found_share() < options.least_found_share) {
    return Fail(ErrorCode::kUnavailable,
                "of the features that should have been seen {:.0f} % were found, less than {:.0f} "
                "%: nothing is learnt from such a visit",
                100.0 * counts.found_share(), 100.0 * options.least_found_share);
  }
  const int judged = counts.found + counts.missed;
  if (judged < options.least_judged_share * (judged + counts.unjudged)) {
    return Fail(ErrorCode::kUnavailable,
                "{} of {} features could be judged, less than {:.0f} %: nothing is learnt from "
                "such a visit",
                judged, judged + counts.unjudged, 100.0 * options.least_judged_share);
  }
  return {};
}

}  // namespace

Result<Refreshed> Refresh(const std::vector<Segment>& route, const Visit& visit,
                          const RefreshOptions& options) {
  if (auto fits = CheckFits(route, visit); !fits) return tl::unexpected(fits.error());
  std::vector<const SegmentVisit*> visits(route.size(), nullptr);
  for (const SegmentVisit& each : visit.segments) visits[each.index.value()] = &each;
  Refreshed refreshed{route, {}};
  double bytes = 0.0;
  double length_m = 0.0;
  for (std::size_t i = 0; i < route.size(); ++i) {
    Count(route[i], visits[i] != nullptr ? visits[i]->features : std::vector<Sought>{},
          refreshed.counts);
    bytes += static_cast<double>(route::Encode(route[i]).size());
    length_m += route[i].length_m;
  }
  if (auto good = CheckBelievable(refreshed.counts, options); !good) {
    return tl::unexpected(good.error());
  }
  // What the whole route has left goes to its segments by their lengths: one of a sharp turn has
  // more bytes a metre than others, and keeps them.
  const double spare_per_m =
      length_m > 0.0 ? std::max(0.0, options.most_bytes_per_m - bytes / length_m) : 0.0;
  for (std::size_t i = 0; i < route.size(); ++i) {
    if (visits[i] == nullptr) continue;
    Segment& segment = refreshed.segments[i];
    const auto most_bytes = static_cast<std::size_t>(
        static_cast<double>(route::Encode(segment).size()) + spare_per_m * segment.length_m);
    const auto most = static_cast<std::size_t>(
        std::ceil(options.most_share * static_cast<double>(segment.features.size())));
    NoteMissed(visits[i]->features, segment);
    refreshed.counts.dropped += Drop(most, options, segment);
    refreshed.counts.added += Add(visits[i]->offered, most, most_bytes, segment);
  }
  return refreshed;
}

}  // namespace trailcast::refresh
