#include "agent/session/src/place/view_taker.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "services/teach/key_view_recorder.h"
#include "services/view/key_views.h"

namespace trailcast::agent {
namespace {

// A place is only seen as its key view shows it from within this distance, in metres, and in a
// route's other units.
constexpr double kHere_m = 0.3;
constexpr double kHere = 0.2;
constexpr int kFewestLooks = 2;
// This many features that agree tell how two pictures map onto each other, to a pixel or two.
constexpr int kTells = 10;
constexpr double kLargest = 1.4;  // the magnification has to be near the scout's
// These are shares of a key view's features: it is recognised, and so well that there is nothing to
// add.
constexpr double kFoundShare = 0.3;
constexpr double kWellShare = 0.5;
constexpr int kFewest = 8;
constexpr auto kNoPlace = static_cast<std::size_t>(-1);

// A feature within this distance, in half widths of the picture, that differs in no more bits than
// this, in two looks from places this far apart, is no part of the place.
constexpr double kStays = 0.03;
constexpr int kStays_bits = 60;
constexpr double kElsewhere_m = 0.5;
constexpr double kElsewhere = 0.15;
constexpr std::size_t kMostThatStays = 500;
// Not every look shows all of it: dirt shows no corner in front of what looks alike.
constexpr std::size_t kSeenBefore = 3;

bool IsSame(const view::ViewTable& a, std::size_t i, const view::ViewTable& b, std::size_t j) {
  return std::abs(a.u[i] - b.u[j]) < kStays && std::abs(a.v[i] - b.v[j]) < kStays &&
         view::Hamming(a.bits[i], b.bits[j]) <= kStays_bits;
}

bool Has(const view::ViewTable& table, const view::ViewTable& other, std::size_t feature) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (IsSame(table, i, other, feature)) return true;
  }
  return false;
}

}  // namespace

bool ViewTaker::Place::recognised_well() const {
  for (std::size_t i = 0; i < agreed.size(); ++i) {
    if (agreed[i] >= kWellShare * static_cast<double>(features[i])) return true;
  }
  return false;
}

void ViewTaker::Learn(const route::Segment& segment) {
  // A segment without key views has nothing to refresh.
  if (segment.key_views.empty()) {
    views_.resize(views_.size() + view::KeyViewsOf(segment).size(), {kNoPlace, 0});
  }
  for (std::size_t i = 0; i < segment.key_views.size(); ++i) {
    const route::KeyView& view = segment.key_views[i];
    if (!view.missed || i == 0) {
      Place& place = places_.emplace_back();
      place.segment = segment.index;
      place.position = i;
      place.metric = segment.has_odometry;
    }
    Place& place = places_.back();
    views_.emplace_back(places_.size() - 1, place.features.size());
    place.features.push_back(view.features.size());
    place.agreed.push_back(0);
  }
}

route::View ViewTaker::AsTaught(const Place& at) const {
  const double half_px = 0.5 * width_px_;
  route::View view;
  for (std::size_t i = 0; i < at.seen.size(); ++i) {
    if (Has(stays_, at.seen, i)) continue;
    route::ViewFeature feature;
    std::memcpy(feature.descriptor.data(), at.seen.bits[i].data(), feature.descriptor.size());
    feature.u_px = static_cast<float>(half_px * (at.seen.u[i] - at.told.shift_u) / at.told.scale);
    feature.v_px = static_cast<float>(half_px * (at.seen.v[i] - at.told.shift_v) / at.told.scale);
    if (std::abs(feature.u_px) > half_px || std::abs(feature.v_px) > 0.5 * height_px_) continue;
    const double log_size = at.seen.log_size[i];
    if (!std::isnan(log_size)) {
      feature.size_px = static_cast<float>(half_px * std::exp(log_size) / at.told.scale);
    }
    view.push_back(feature);
  }
  return view;
}

// The scout's own view decides, if it can: places that rely on views which followers added would
// drift.
void ViewTaker::Note(const view::ViewTable& seen, Place& at, std::size_t variant,
                     const view::Comparison& comparison) {
  at.agreed[variant] = std::max(at.agreed[variant], comparison.agreed());
  if (at.recognised_well()) {
    at.seen = {};
    return;
  }
  const bool tells = comparison.agreed() >= kTells && comparison.scale < kLargest &&
                     comparison.scale > 1.0 / kLargest;
  const bool by_another = variant > 0 && at.agreed.front() >= kTells;
  if (!tells || by_another || comparison.likeness <= at.told.likeness) return;
  at.told = comparison;
  at.told.pairs.clear();
  at.seen = seen;
}

void ViewTaker::NoteWhatStays(const view::ViewTable& seen, const Localiser& place) {
  const double along = place.where().along;
  const double elsewhere = place.metric() ? kElsewhere_m : kElsewhere;
  if (last_along_ && std::abs(along - *last_along_) < elsewhere) return;
  for (std::size_t i = 0; i < seen.size() && stays_.size() < kMostThatStays; ++i) {
    const bool stayed =
        std::any_of(last_seen_.begin(), last_seen_.end(),
                    [&](const view::ViewTable& before) { return Has(before, seen, i); });
    if (!stayed || Has(stays_, seen, i)) continue;
    stays_.bits.push_back(seen.bits[i]);
    stays_.u.push_back(seen.u[i]);
    stays_.v.push_back(seen.v[i]);
    stays_.log_size.push_back(seen.log_size[i]);
  }
  last_seen_.push_back(seen);
  if (last_seen_.size() > kSeenBefore) last_seen_.pop_front();
  last_along_ = along;
}

void ViewTaker::See(const Localiser& place) {
  if (!place.where().held) return;
  const view::ViewTable& seen = place.look().seen;
  NoteWhatStays(seen, place);
  const double here = place.metric() ? kHere_m : kHere;
  for (const Look::Recognised& each : place.look().views) {
    const auto [at, variant] = views_[each.view];
    const double off = place.belief().view_at(each.view) - place.where().along;
    if (at == kNoPlace || std::abs(off) > here) continue;
    if (variant == 0) ++places_[at].looks;
    Note(seen, places_[at], variant, each.comparison);
  }
}

refresh::Sought ViewTaker::Judge(const Place& at, std::size_t variant) const {
  if (at.looks < kFewestLooks) return refresh::Sought::kUnjudged;
  const double enough =
      std::max<double>(kFewest, kFoundShare * static_cast<double>(at.features[variant]));
  return at.agreed[variant] >= enough ? refresh::Sought::kFound : refresh::Sought::kMissed;
}

route::View ViewTaker::OfferOf(const Place& at) const {
  if (at.looks < kFewestLooks || at.seen.size() == 0) return {};
  teach::KeyViewRecorder chosen(width_px_, at.metric ? teach::KeyViewRecorderOptions::WithOdometry()
                                                     : teach::KeyViewRecorderOptions{});
  return chosen.Keep(AsTaught(at)) ? chosen.kept() : route::View{};
}

void ViewTaker::Take(refresh::Visit& visit) const {
  for (const Place& at : places_) {
    auto of_segment = std::lower_bound(
        visit.segments.begin(), visit.segments.end(), at.segment,
        [](const refresh::SegmentVisit& each, SegmentIndex index) { return each.index < index; });
    if (of_segment == visit.segments.end() || of_segment->index != at.segment) {
      of_segment = visit.segments.insert(of_segment, {at.segment, {}, {}, {}, {}});
    }
    of_segment->views.resize(at.position, refresh::Sought::kUnjudged);
    for (std::size_t i = 0; i < at.features.size(); ++i) {
      of_segment->views.push_back(Judge(at, i));
    }
    route::View offered = OfferOf(at);
    if (!offered.empty()) {
      of_segment->offered_views.push_back({at.position, std::move(offered)});
    }
  }
}

}  // namespace trailcast::agent
