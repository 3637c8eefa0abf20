#pragma once

#include <cstddef>
#include <optional>

#include "services/refresh/refresh.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// The key views of `segment` as a visit leaves them: those of the scout as they are, and beside
// them what followers added, as far as it is recognised now and then, or offered now. The segment
// becomes no larger than `most_bytes` by what is added; nothing: whatever it weighs.
void RefreshViews(const SegmentVisit& visit, std::optional<std::size_t> most_bytes,
                  const RefreshOptions& options, route::Segment& segment, RefreshCounts& counts);

}  // namespace trailcast::refresh
