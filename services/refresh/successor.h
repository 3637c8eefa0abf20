#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "services/refresh/refresh.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// What a revision is tagged with that refreshes another one.
inline constexpr std::string_view kTag = "refreshed";

// What has changed, and what such a revision says of itself: whose visit to which revision made it,
// too. For people.
[[nodiscard]] std::string Describe(const Refreshed& refreshed);
[[nodiscard]] std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                                            const Refreshed& refreshed);

// The revision that it says it refreshes; nothing: it is tagged, or described, as none.
[[nodiscard]] std::optional<RevisionNumber> RevisionRefreshed(const route::RouteInfo& info);

// Whether `segment` is `before` as one visit may leave it: as taught but for features and added key
// views, of which no more have gone and come than a visit takes away and adds.
[[nodiscard]] bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                               const RefreshOptions& options = {});

}  // namespace trailcast::refresh
