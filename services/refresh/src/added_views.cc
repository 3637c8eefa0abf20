#include "services/refresh/src/added_views.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "services/refresh/src/missed.h"
#include "services/route/codec.h"

namespace trailcast::refresh {
namespace {

using route::KeyView;

bool IsSound(const route::View& view) {
  return !view.empty() && view.size() <= route::kMaxKeyViewFeatures &&
         std::all_of(view.begin(), view.end(), [](const route::ViewFeature& feature) {
           return std::isfinite(feature.u_px) && std::isfinite(feature.v_px) &&
                  std::isfinite(feature.size_px);
         });
}

const OfferedView* OfferedBeside(const std::vector<OfferedView>& offered, std::size_t position) {
  const auto found = std::find_if(offered.begin(), offered.end(),
                                  [&](const OfferedView& each) { return each.beside == position; });
  return found != offered.end() && IsSound(found->features) ? &*found : nullptr;
}

}  // namespace

void RefreshViews(const SegmentVisit& visit, std::optional<std::size_t> most_bytes,
                  const RefreshOptions& options, route::Segment& segment, RefreshCounts& counts) {
  if (visit.views.empty()) return;
  const std::vector<KeyView> before = std::exchange(segment.key_views, {});
  std::vector<std::pair<std::size_t, KeyView>> new_ones;  // and their positions
  for (std::size_t i = 0; i < before.size();) {
    const std::size_t own = i;
    int added = 0;
    do {
      KeyView view = before[i];
      if (view.missed) NoteVisit(visit.views[i], *view.missed);
      ++i;
      if (view.missed && *view.missed >= options.missed_to_drop) {
        ++counts.dropped;
        continue;
      }
      added += view.missed ? 1 : 0;
      segment.key_views.push_back(std::move(view));
    } while (i < before.size() && before[i].missed);
    const OfferedView* offered = OfferedBeside(visit.offered_views, own);
    if (offered == nullptr || added >= options.most_added_views) continue;
    new_ones.emplace_back(segment.key_views.size(),
                          KeyView{before[own].s, offered->features, std::uint8_t{0}});
  }
  // The first ones are taken, as many as are allowed.
  std::size_t inserted = 0;
  for (auto& [place, view] : new_ones) {
    if (segment.key_views.size() >= route::kMaxKeyViews) return;
    const auto there = segment.key_views.begin() + static_cast<std::ptrdiff_t>(place + inserted);
    const auto at = segment.key_views.insert(there, std::move(view));
    if (most_bytes && route::Encode(segment).size() > *most_bytes) {
      segment.key_views.erase(at);
      return;
    }
    ++inserted;
    ++counts.added;
  }
}

}  // namespace trailcast::refresh
