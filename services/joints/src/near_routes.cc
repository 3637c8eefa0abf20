#include "services/joints/near_routes.h"

#include <algorithm>
#include <map>

#include "services/view/key_views.h"

namespace trailcast::joints {
namespace {

struct Hit {
  std::size_t view = 0;  // of the route asked for
  std::uint32_t segment = 0;
};

// The longest sequence of hits, each a later view's, none on an earlier segment.
NearRoute LongestInOrder(const route::RouteKey& key, const std::vector<Hit>& hits) {
  std::vector<std::size_t> lengths(hits.size(), 1);
  std::vector<std::uint32_t> begins(hits.size());
  std::size_t best = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    begins[i] = hits[i].segment;
    for (std::size_t j = 0; j < i; ++j) {
      if (hits[j].view >= hits[i].view || hits[j].segment > hits[i].segment) continue;
      if (lengths[j] < lengths[i]) continue;
      lengths[i] = lengths[j] + 1;
      begins[i] = begins[j];
    }
    if (lengths[i] > lengths[best]) best = i;
  }
  return {key, SegmentIndex(begins[best]), SegmentIndex(hits[best].segment), lengths[best]};
}

}  // namespace

std::vector<NearRoute> NearRoutes(view::ViewIndex& index, const RouteId& self,
                                  std::span<const route::Segment> route,
                                  const NearRouteOptions& options) {
  std::map<route::RouteKey, std::vector<Hit>> hits;
  std::size_t view = 0;
  for (const route::Segment& segment : route) {
    for (const route::KeyView& key : view::KeyViewsOf(segment)) {
      for (const auto& place : index.Candidates(key.features, options.most_alike)) {
        if (place.key.route != self) hits[place.key].push_back({view, place.segment.value()});
      }
      ++view;
    }
  }
  std::vector<NearRoute> near;
  for (const auto& [key, of_route] : hits) {
    NearRoute found = LongestInOrder(key, of_route);
    if (found.views < options.least_views) continue;
    found.first = SegmentIndex(found.first.value() - std::min(found.first.value(), options.margin));
    found.last = SegmentIndex(found.last.value() + options.margin);
    near.push_back(std::move(found));
  }
  std::stable_sort(near.begin(), near.end(), [](const NearRoute& one, const NearRoute& other) {
    return one.views > other.views;
  });
  if (near.size() > options.most_routes) near.resize(options.most_routes);
  return near;
}

}  // namespace trailcast::joints
