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

namespace trailcast::joints {

// A stretch of another route that may come to the same place.
struct NearRoute {
  route::RouteKey key;
  SegmentIndex first;
  SegmentIndex last;
  std::size_t views = 0;  // of the route asked for that are like one of these segments, in order

  bool operator==(const NearRoute&) const = default;
};

struct NearRouteOptions {
  std::size_t most_alike = 10;  // segments a view
  std::size_t least_views = 2;
  std::uint32_t margin = 3;      // segments before the first and after the last that was alike
  std::size_t most_routes = 50;  // stretches of them
  // Of one route so many stretches, those after the first of so many views at least.
  std::size_t most_stretches = 3;
  std::size_t least_views_again = 4;
};

// Which of an index's routes are worth comparing with this one (find_joints.h): several of its
// views have some of their segments among those most like them, in order. View after view, for who
// has little time at once.
class NearRouteSearch {
 public:
  explicit NearRouteSearch(RouteId self, const NearRouteOptions& options = {})
      : self_(std::move(self)), options_(options) {}

  // The route's next view.
  void Look(view::ViewIndex& index, std::span<const route::ViewFeature> view);
  // Only the last so many count.
  void KeepLast(std::uint32_t views);
  // Those with the most such views first; of a route that is met again, or in another order, a
  // stretch for each. Teachings of the same route are left out.
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

// The same of a whole route.
[[nodiscard]] std::vector<NearRoute> NearRoutes(view::ViewIndex& index, const RouteId& self,
                                                std::span<const route::Segment> route,
                                                const NearRouteOptions& options = {});

}  // namespace trailcast::joints
