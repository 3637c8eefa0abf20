#pragma once

#include "services/base/result.h"
#include "services/lab/trial/route_recorder.h"
#include "services/refresh/refresh.h"
#include "services/refresh/visit.h"

namespace trailcast::trial {

// Makes of a route what a visit leaves of it, for the next follower. kUnavailable: the visit is not
// believed, and the route as it was.
[[nodiscard]] Result<refresh::Refreshed> RefreshTaught(const refresh::Visit& visit,
                                                       TaughtRoute& route);

}  // namespace trailcast::trial
