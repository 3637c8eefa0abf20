#pragma once

#include <string>
#include <string_view>

#include "services/refresh/refresh.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// The tag of a revision that refreshes another one (RouteInfo::refreshes), so that it can be found.
inline constexpr std::string_view kTag = "refreshed";

// Both return text for people: the changes, and the description of such a revision, which names the
// visit and the visited revision.
[[nodiscard]] std::string Describe(const Refreshed& refreshed);
[[nodiscard]] std::string DescribeRefreshed(RevisionNumber visited, const AgentId& by,
                                            const Refreshed& refreshed);

// Says whether `segment` is `before` as one visit may leave it: as taught except for features and
// added key views, of which no more come and go than one visit allows.
[[nodiscard]] bool IsRefreshed(const route::Segment& segment, const route::Segment& before,
                               const RefreshOptions& options = {});

}  // namespace trailcast::refresh
