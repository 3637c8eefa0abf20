#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// What openapi.yaml has at /api/robots/{robot}/glance. Of those who wait for a picture no more are
// let in, since each takes a thread. `desk` outlives the server.
inline constexpr int kMostLookers = 16;
void ServeGlances(http::Server& server, Desk& desk);

}  // namespace trailcast::console
