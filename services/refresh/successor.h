#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "services/refresh/refresh.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// What a revision is tagged with that refreshes another one.
inline constexpr std::string_view kTag = "refreshed";

// What such a revision says of itself, for people: whose visit to which revision made it, and what
// has changed.
[[nodiscard]] std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                                            const RefreshCounts& counts);

// The revision that it says it refreshes; nothing: it is tagged, or described, as none.
[[nodiscard]] std::optional<RevisionNumber> RevisionRefreshed(const route::RouteInfo& info);

// Whether `segment` is `before` as one visit may leave it: as taught but for features, of which no
// more have gone and come than a visit takes away and adds.
[[nodiscard]] bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                               const RefreshOptions& options = {});

}  // namespace trailcast::refresh
