#pragma once

#include <vector>

#include "services/store/route_store.h"

namespace trailcast::exchange {

// The numbers that teachings get which are new to the store: the one that each has already, if no
// other teaching of the route ever had it there, or else the next one; what the store knows keeps
// its number. Of a store that several processes share: within Exclusively, with the PutRoutes that
// follows.
[[nodiscard]] Result<void> GiveNumbers(store::RouteStore& store,
                                       std::vector<route::RouteInfo>& infos);

}  // namespace trailcast::exchange
