#pragma once

#include <span>
#include <vector>

#include "services/store/route_store.h"

namespace trailcast::exchange {

// Gives numbers to teachings that are new to the store. A teaching keeps the number it has if no
// other teaching of the route ever had it there, and gets the next one otherwise. Teachings that
// the store knows keep their numbers. If several processes share the store, call this within
// Exclusively, together with the PutRoutes that follows.
[[nodiscard]] Result<void> GiveNumbers(store::RouteStore& store, std::span<route::RouteInfo> infos);

// Returns those of a route's living `revisions` that have to change, as they are after the change.
// Servers that did not hear each other may have given one number to two teachings, or have two
// active ones. Any server decides the same from the same revisions. The teaching that was taught
// first keeps a number that several have; the others get numbers after `last`, the greatest there
// ever was. The active revision with the greatest edition stays active and, of several such ones,
// the one with the smallest number: an operator who activates a revision gives it the
// greatest edition, and a server activates by itself the first one that it has.
[[nodiscard]] std::vector<route::RouteInfo> Disagreements(std::vector<route::RouteInfo> revisions,
                                                          RevisionNumber last);
// Does the same for a route in the store. If several processes share the store, call it within
// Exclusively, together with the PutRoutes that follows.
[[nodiscard]] Result<std::vector<route::RouteInfo>> Disagreements(store::RouteStore& store,
                                                                  const RouteId& route);

}  // namespace trailcast::exchange
