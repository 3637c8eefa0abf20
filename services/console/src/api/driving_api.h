#pragma once

#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves openapi.yaml's /api/robots/{robot}/drive. `desk` outlives the server.
void ServeDriving(http::Server& server, Desk& desk);

}  // namespace trailcast::console
