#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves POST /api/where with a picture, which may be anybody's. `desk` outlives the server.
void ServeWhere(http::Server& server, Desk& desk);

}  // namespace trailcast::console
