#pragma once

#include "services/console/atlas.h"
#include "services/console/site.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves what openapi.yaml has of routes' shapes and of the site. Both outlive the server, and
// `site` may be null.
void ServeMap(http::Server& server, Atlas& atlas, Site* site);

}  // namespace trailcast::console
