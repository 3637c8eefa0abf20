#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "services/route/route.h"
#include "services/view/view_index.h"

namespace trailcast::junctions {

// A section of another route that may come to the same place.
struct NearRoute {
  route::RouteKey key;
  SegmentIndex first;
  SegmentIndex last;
  std::size_t views = 0;  // how many of this route's views resemble these segments, in order

  bool operator==(const NearRoute&) const = default;
};

struct NearRouteOptions {
  std::size_t most_alike = 10;  // segments for each view
  std::size_t least_views = 2;
  std::uint32_t margin = 3;      // segments added before the first match and after the last
  std::size_t most_routes = 50;  // at most so many sections of routes
  // One route gives at most so many sections; those after the first need at least so many views.
  std::size_t most_sections = 3;
  std::size_t least_views_again = 4;
};

// Finds the routes of an index that are worth comparing with this one (find_junctions.h): several
// of its views have segments of theirs among their nearest matches, in order. It takes one view at
// a time, for callers that have little time at once.
class NearRouteSearch {
 public:
  explicit NearRouteSearch(RouteId self, const NearRouteOptions& options = {})
      : self_(std::move(self)), options_(options) {}

  // Takes the route's next view.
  void Look(view::ViewIndex& index, std::span<const route::ViewFeature> view);
  // Drops all but the last so many views.
  void KeepLast(std::uint32_t views);
  // Returns the sections with the most matching views first. A route that is met twice, or in
  // another order, gives a section for each. Teachings of the same route are left out.
  [[nodiscard]] std::vector<NearRoute> Found() const;

 private:
  struct Hit {
    std::uint32_t view = 0;
    std::uint32_t route = 0;  // its number
    std::uint32_t segment = 0;
  };
  RouteId self_;
  NearRouteOptions options_;
  std::uint32_t views_ = 0;
  std::map<route::RouteKey, std::uint32_t> numbers_;
  std::uint32_t next_number_ = 0;
  std::deque<Hit> hits_;
};

// Does the same for a whole route.
[[nodiscard]] std::vector<NearRoute> NearRoutes(view::ViewIndex& index, const RouteId& self,
                                                std::span<const route::Segment> route,
                                                const NearRouteOptions& options = {});

}  // namespace trailcast::junctions
