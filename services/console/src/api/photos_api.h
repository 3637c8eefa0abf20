#pragma once

#include "services/console/album.h"
#include "services/http/server.h"

namespace trailcast::console {

// Serves the photos that robots took on missions, `/api/photos` and what is below it in
// openapi.yaml. `album` outlives the server.
void ServePhotos(http::Server& server, Album& album);

}  // namespace trailcast::console
