#include "services/junctions/near_routes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "services/view/key_views.h"

namespace trailcast::junctions {
namespace {

struct ViewOnSegment {
  std::uint32_t view = 0;  // of this route
  std::uint32_t segment = 0;
};

// Returns the longest sequence of hits, each of a later view, none on an earlier segment; among the
// longest, one that ends on the earliest segment. `hits` are by rising view and, within a view, by
// falling segment.
NearRoute LongestInOrder(const route::RouteKey& key, const std::vector<ViewOnSegment>& hits) {
  struct Sequence {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<Sequence> ending;  // for each length, the one that ends on the earliest segment
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
  for (const auto& place : index.Candidates(view, options_.most_alike)) {
    if (place.key.route == self_) continue;
    const auto [at, is_new] = numbers_.try_emplace(place.key, next_number_);
    if (is_new) ++next_number_;
    hits_.push_back({views_, at->second, place.segment.value()});
  }
  ++views_;
}

void NearRouteSearch::KeepLast(std::uint32_t views) {
  while (!hits_.empty() && hits_.front().view + views < views_) hits_.pop_front();
  std::set<std::uint32_t> kept;
  for (const Hit& hit : hits_) kept.insert(hit.route);
  std::erase_if(numbers_, [&](const auto& each) { return !kept.contains(each.second); });
}

std::vector<NearRoute> NearRouteSearch::Found() const {
  std::map<std::uint32_t, std::vector<ViewOnSegment>> hits;
  for (const Hit& hit : hits_) hits[hit.route].push_back({hit.view, hit.segment});
  std::vector<NearRoute> near;
  for (const auto& [key, number] : numbers_) {
    auto& of_route = hits[number];
    // A sequence has at most one hit of a view, so the later segment comes first.
    std::sort(of_route.begin(), of_route.end(), [](const auto& one, const auto& other) {
      return one.view != other.view ? one.view < other.view : one.segment > other.segment;
    });
    for (std::size_t i = 0; i < options_.most_sections && !of_route.empty(); ++i) {
      NearRoute found = LongestInOrder(key, of_route);
      if (found.views < (i == 0 ? options_.least_views : options_.least_views_again)) break;
      found.first =
          SegmentIndex(found.first.value() - std::min(found.first.value(), options_.margin));
      found.last = SegmentIndex(found.last.value() + options_.margin);
      std::erase_if(of_route, [&](const ViewOnSegment& hit) {
        return hit.segment >= found.first.value() && hit.segment <= found.last.value();
      });
      near.push_back(std::move(found));
    }
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
    for (const route::KeyView& key : view::ScoutViewsOf(segment)) search.Look(index, key.features);
  }
  return search.Found();
}

}  // namespace trailcast::junctions
