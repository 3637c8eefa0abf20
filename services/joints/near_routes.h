#pragma once

#include <cstddef>
#include <span>
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
  std::uint32_t margin = 3;  // segments before the first and after the last that was alike
  std::size_t most_routes = 50;
};

// Which of the index's routes are worth comparing with this one (find_joints.h): several of its
// views have some of their segments among those most like them, in order. Those with the most such
// views first. Teachings of the same route are left out.
[[nodiscard]] std::vector<NearRoute> NearRoutes(view::ViewIndex& index, const RouteId& self,
                                                std::span<const route::Segment> route,
                                                const NearRouteOptions& options = {});

}  // namespace trailcast::joints
