#include "services/joints/near_routes.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "services/view/key_views.h"

namespace trailcast::joints {
namespace {

struct ViewOnSegment {
  std::size_t view = 0;  // of the route asked for
  std::uint32_t segment = 0;
};

// The longest sequence of them, each a later view's, none on an earlier segment; of these one that
// ends on the earliest segment.
NearRoute LongestInOrder(const route::RouteKey& key, std::vector<ViewOnSegment> hits) {
  // Of one view no two are in a sequence: the later segment comes first.
  std::sort(hits.begin(), hits.end(), [](const ViewOnSegment& one, const ViewOnSegment& other) {
    return one.view != other.view ? one.view < other.view : one.segment > other.segment;
  });
  struct Sequence {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<Sequence> ending;  // of each length the one that ends on the earliest segment
  for (const ViewOnSegment& hit : hits) {
    const auto at = std::upper_bound(
        ending.begin(), ending.end(), hit.segment,
        [](std::uint32_t segment, const Sequence& each) { return segment < each.last; });
    const Sequence now{at == ending.begin() ? hit.segment : std::prev(at)->first, hit.segment};
    if (at != ending.end()) {
      *at = now;
    } else {
      ending.push_back(now);
    }
  }
  return {key, SegmentIndex(ending.back().first), SegmentIndex(ending.back().last), ending.size()};
}

}  // namespace

void NearRouteSearch::Look(view::ViewIndex& index, std::span<const route::ViewFeature> view) {
  for (auto& place : index.Candidates(view, options_.most_alike)) {
    if (place.key.route != self_) hits_.push_back({views_, std::move(place)});
  }
  ++views_;
}

void NearRouteSearch::KeepLast(std::size_t views) {
  while (!hits_.empty() && hits_.front().view + views < views_) hits_.pop_front();
}

std::vector<NearRoute> NearRouteSearch::Found() const {
  std::map<route::RouteKey, std::vector<ViewOnSegment>> hits;
  for (const Hit& hit : hits_) {
    hits[hit.place.key].push_back({hit.view, hit.place.segment.value()});
  }
  std::vector<NearRoute> near;
  for (auto& [key, of_route] : hits) {
    NearRoute found = LongestInOrder(key, std::move(of_route));
    if (found.views < options_.least_views) continue;
    found.first =
        SegmentIndex(found.first.value() - std::min(found.first.value(), options_.margin));
    found.last = SegmentIndex(found.last.value() + options_.margin);
    near.push_back(std::move(found));
  }
  std::stable_sort(near.begin(), near.end(), [](const NearRoute& one, const NearRoute& other) {
    return one.views > other.views;
  });
  if (near.size() > options_.most_routes) near.resize(options_.most_routes);
  return near;
}

std::vector<NearRoute> NearRoutes(view::ViewIndex& index, const RouteId& self,
                                  std::span<const route::Segment> route,
                                  const NearRouteOptions& options) {
  NearRouteSearch search(self, options);
  for (const route::Segment& segment : route) {
    for (const route::KeyView& key : view::KeyViewsOf(segment)) search.Look(index, key.features);
  }
  return search.Found();
}

}  // namespace trailcast::joints
