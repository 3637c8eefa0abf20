#pragma once

#include <string>
#include <string_view>

#include "services/refresh/refresh.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// A revision that refreshes another one (RouteInfo::refreshes) is tagged with this, so that it is
// found.
inline constexpr std::string_view kTag = "refreshed";

// What has changed, and what such a revision says of itself: whose visit to which revision made it,
// too. For people.
[[nodiscard]] std::string Describe(const Refreshed& refreshed);
[[nodiscard]] std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                                            const Refreshed& refreshed);

// Whether `segment` is `before` as one visit may leave it: as taught but for features and added key
// views, of which no more have gone and come than a visit takes away and adds.
[[nodiscard]] bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                               const RefreshOptions& options = {});

}  // namespace trailcast::refresh
