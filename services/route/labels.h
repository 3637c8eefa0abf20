#pragma once

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// "staged", "active", "retired", "deleted".
[[nodiscard]] const char* NameOf(Standing standing);

// The labels of `info` become those of `from`: name, tags, description, standing and edition.
void TakeLabels(RouteInfo& info, const RouteInfo& from);

// Whether two infos are of the same teaching: equal but for their labels.
[[nodiscard]] bool SameTeaching(const RouteInfo& a, const RouteInfo& b);

// What is known of a revision once `news` of it arrived; announcements overtake each other. Of what
// was taught the longer counts, of the labels the later edition; what is deleted stays deleted.
// kConflict when a complete revision would change. Both have the same key.
[[nodiscard]] Result<RouteInfo> AfterNews(const RouteInfo& known, const RouteInfo& news);

}  // namespace trailcast::route
