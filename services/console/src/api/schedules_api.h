#pragma once

#include "services/console/access.h"
#include "services/console/desk.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves what openapi.yaml has below /api/schedules. All arguments outlive the server.
void ServeSchedules(http::Server& server, Desk& desk, const Access& access);

}  // namespace trailcast::console
