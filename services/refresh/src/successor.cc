#include "services/refresh/successor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::refresh {
namespace {

std::string WhatChanged(const RefreshCounts& counts, const char* what) {
  return fmt::format("{} {} new, {} gone; {} of {} were found", counts.added, what, counts.dropped,
                     counts.found, counts.found + counts.missed);
}

bool AreSame(const route::Feature& a, const route::Feature& b) {
  return a.patch == b.patch && a.descriptor == b.descriptor && a.track == b.track;
}

// The scout's key views remain.
route::Segment WithoutWhatChanges(route::Segment segment) {
  segment.features.clear();
  std::erase_if(segment.key_views, [](const route::KeyView& view) { return view.missed; });
  return segment;
}

// Says whether no more key views were added beside each of the scout's than are allowed.
bool AddsFew(const route::Segment& segment, const RefreshOptions& options) {
  int added = 0;
  for (const route::KeyView& view : segment.key_views) {
    added = view.missed ? added + 1 : 0;
    if (added > options.most_added_views) return false;
  }
  return true;
}

}  // namespace

std::string Describe(const Refreshed& refreshed) {
  const auto& [segments, features, views] = refreshed;
  const bool by_views = features.found + features.missed == 0;
  if (by_views) return WhatChanged(views, "views");
  std::string text = WhatChanged(features, "features");
  if (views.added + views.dropped > 0) text += "; " + WhatChanged(views, "views");
  return text;
}

std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                              const Refreshed& refreshed) {
  return fmt::format("revision {} refreshed by {}: {}", visited.value(), by.value(),
                     Describe(refreshed));
}

bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                 const RefreshOptions& options) {
  if (WithoutWhatChanges(segment) != WithoutWhatChanges(before)) return false;
  if (!AddsFew(segment, options)) return false;
  // The features that stay keep their order.
  std::size_t stayed = 0;
  auto from = before.features.begin();
  for (const route::Feature& feature : segment.features) {
    const auto found = std::find_if(from, before.features.end(), [&](const route::Feature& other) {
      return AreSame(feature, other);
    });
    if (found == before.features.end()) continue;
    ++stayed;
    from = found + 1;
  }
  const auto most = static_cast<std::size_t>(
      std::ceil(options.most_share * static_cast<double>(before.features.size())));
  return before.features.size() - stayed <= most && segment.features.size() - stayed <= most;
}

}  // namespace trailcast::refresh
