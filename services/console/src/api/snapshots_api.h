#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves camera snapshots, `/api/robots/{robot}/snapshot` of openapi.yaml. No more requests than
// kMostLookers wait for a picture, because each takes a thread. `desk` outlives the server.
inline constexpr int kMostLookers = 16;
void ServeSnapshots(http::Server& server, Desk& desk);

}  // namespace trailcast::console
