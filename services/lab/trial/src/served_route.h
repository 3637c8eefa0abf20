#pragma once

#include "services/base/result.h"
#include "services/lab/trial/trial_teach.h"

namespace trailcast::trial {

// Returns the route as a follower gets it from a server: its scout's sender publishes it, the
// server's keeper makes it durable, and a follower fetches it, over a bus in this process with a
// time of its own. kUnavailable means that it has not arrived within a minute of that time.
[[nodiscard]] Result<TaughtRoute> FetchFromServer(const TaughtRoute& taught);

}  // namespace trailcast::trial
