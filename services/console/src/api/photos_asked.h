#pragma once

#include "services/console/desk.h"
#include "services/console/json.h"
#include "services/mission/orders.h"

namespace trailcast::console {

// Returns the photos that a body asks for. A place's name is looked up in the network that servers
// keep.
[[nodiscard]] Result<mission::PhotoWish> PhotosAsked(Desk& desk, const PhotosBody& photos);

}  // namespace trailcast::console
