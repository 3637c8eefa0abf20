#pragma once

#include "services/base/result.h"
#include "services/lab/trial/trial_teach.h"

namespace trailcast::trial {

// The route as a follower gets it from a server: published by its scout's sender, made durable by
// the server's keeper, fetched by a follower, all three talking over a bus in this process in their
// own time. kUnavailable when it has not come through in a minute of that time.
[[nodiscard]] Result<TaughtRoute> FetchFromServer(const TaughtRoute& taught);

}  // namespace trailcast::trial
