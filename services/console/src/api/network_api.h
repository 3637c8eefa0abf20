#pragma once

#include "services/console/access.h"
#include "services/console/desk.h"
#include "services/console/network_watch.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves what openapi.yaml has below /api/network. All arguments outlive the server.
void ServeNetwork(http::Server& server, Desk& desk, NetworkWatch& watch, const Access& access);

}  // namespace trailcast::console
