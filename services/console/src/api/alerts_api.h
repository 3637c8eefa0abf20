#pragma once

#include "services/console/access.h"
#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves openapi.yaml's /api/alerts: what people have to see to, and had to.
void ServeAlerts(http::Server& server, Desk& desk, const Access& access);

}  // namespace trailcast::console
