#pragma once

#include "services/base/result.h"
#include "services/lab/trial/route_recorder.h"
#include "services/refresh/refresh.h"
#include "services/refresh/visit.h"

namespace trailcast::trial {

// Refreshes a route after a visit, for the next follower. kUnavailable means that the visit is not
// believed, and leaves the route as it was.
[[nodiscard]] Result<refresh::Refreshed> RefreshTaught(const refresh::Visit& visit,
                                                       TaughtRoute& route);

}  // namespace trailcast::trial
