#pragma once

#include <span>
#include <vector>

#include "services/store/route_store.h"

namespace trailcast::exchange {

// The numbers that teachings get which are new to the store: the one that each has already, if no
// other teaching of the route ever had it there, or else the next one; what the store knows keeps
// its number. Of a store that several processes share: within Exclusively, with the PutRoutes that
// follows.
[[nodiscard]] Result<void> GiveNumbers(store::RouteStore& store, std::span<route::RouteInfo> infos);

// What servers that did not hear of each other have made of one route need not fit: two of its
// teachings have one number, or two are active. Its living `revisions` of which that is to be
// changed, as they are then; any server makes the same of the same ones. Of one number, who was
// taught first keeps it, and the others get those after `last`, the greatest there ever was. Of
// several that are active the one with the greatest edition stays, of these the one with the
// smallest number: an operator who activates a revision gives it the greatest, and what a server
// activated by itself was the first that it had.
[[nodiscard]] std::vector<route::RouteInfo> Disagreements(std::vector<route::RouteInfo> revisions,
                                                          RevisionNumber last);
// The same of a route in the store. Where several processes share it: within Exclusively, with the
// PutRoutes that follows.
[[nodiscard]] Result<std::vector<route::RouteInfo>> Disagreements(store::RouteStore& store,
                                                                  const RouteId& route);

}  // namespace trailcast::exchange
