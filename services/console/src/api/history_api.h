#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves GET /api/missions, GET /api/figures, GET /api/commands and GET /api/changes. `desk`
// outlives the server.
void ServeHistory(http::Server& server, Desk& desk);

}  // namespace trailcast::console
