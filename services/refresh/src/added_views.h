#pragma once

#include <cstddef>
#include <optional>

#include "services/refresh/refresh.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// Updates the key views of `segment` after a visit. The scout's stay as they are. The ones that
// followers added stay as long as they are recognised now and then, and offered ones are added.
// Additions do not make the segment larger than `most_bytes`, if that is given.
void RefreshViews(const SegmentVisit& visit, std::optional<std::size_t> most_bytes,
                  const RefreshOptions& options, route::Segment& segment, RefreshCounts& counts);

}  // namespace trailcast::refresh
