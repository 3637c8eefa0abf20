#pragma once

#include "services/console/access.h"
#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves openapi.yaml's /api/alerts: what somebody has to see to, and has had to.
void ServeAlerts(http::Server& server, Desk& desk, const Access& access);

}  // namespace trailcast::console
