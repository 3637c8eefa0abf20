#pragma once

#include "services/console/access.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves GET and POST /api/users, PUT and DELETE /api/users/NAME. `access` outlives the server.
void ServeUsers(http::Server& server, const Access& access);

}  // namespace trailcast::console
