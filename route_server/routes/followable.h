#pragma once

#include "services/route/route.h"

namespace trailcast::server {

// Says whether robots follow this revision.
[[nodiscard]] inline bool IsFollowable(const route::RouteInfo& info) {
  return info.state == route::RouteState::kComplete && info.standing == route::Standing::kActive;
}

// Says whether a junction may be on it, for which it must have metres as well.
[[nodiscard]] inline bool IsJoinable(const route::RouteInfo& info) {
  return IsFollowable(info) && info.length_m > 0.0;
}

}  // namespace trailcast::server
