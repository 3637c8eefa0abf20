#pragma once

#include "services/route/route.h"

namespace trailcast::server {

// What robots follow of a route.
[[nodiscard]] inline bool IsFollowable(const route::RouteInfo& info) {
  return info.state == route::RouteState::kComplete && info.standing == route::Standing::kActive;
}

// And what a joint may lead to or from: it has metres.
[[nodiscard]] inline bool IsJoinable(const route::RouteInfo& info) {
  return IsFollowable(info) && info.length_m > 0.0;
}

}  // namespace trailcast::server
