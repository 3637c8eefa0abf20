#pragma once

#include "services/console/desk.h"
#include "services/console/transfers.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves what openapi.yaml has below /api/transfers. `desk` and `transfers` outlive the server.
void ServeTransfers(http::Server& server, Desk& desk, Transfers& transfers);

}  // namespace trailcast::console
