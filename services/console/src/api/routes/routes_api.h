#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves what openapi.yaml has below /api/routes. `desk` outlives the server.
void ServeRoutes(http::Server& server, Desk& desk);

}  // namespace trailcast::console
