#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

// A complete route that lacks segments here, so that it is served in part.
struct LackingRoute {
  route::RouteInfo info;
  std::vector<SegmentIndex> segments;  // the missing ones, rising
};

// Returns the segments that the route lacks if it is complete. It does not read the segments'
// bytes.
[[nodiscard]] Result<std::vector<SegmentIndex>> FindLacking(RouteStore& store,
                                                            const route::RouteInfo& info);
// Does so for all routes of a store.
[[nodiscard]] Result<std::vector<LackingRoute>> FindLacking(RouteStore& store);

// Returns "segments 3 to 5, 9 and 12 to 40"; a long list ends with how many more there are.
[[nodiscard]] std::string DescribeSegments(const std::vector<SegmentIndex>& rising);
// Returns "segments 3 to 5 of route 'hall' revision 2 (teaching 1f of route 0123..)".
[[nodiscard]] std::string Describe(const LackingRoute& lacking);

}  // namespace trailcast::store
