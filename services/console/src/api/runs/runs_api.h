#pragma once

#include "services/console/desk.h"
#include "services/console/runs.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves /api/runs, the logs of runs. All arguments outlive the server.
void ServeRuns(http::Server& server, Desk& desk, Runs& runs);

}  // namespace trailcast::console
