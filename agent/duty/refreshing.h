#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// A follower's action for a route that it found changed.
enum class Refreshing : std::uint8_t {
  kOff,
  kReview,  // refreshes it; robots follow the new revision once an operator has activated it
  kAuto,    // refreshes it, and needs no operator
};
[[nodiscard]] const std::vector<std::string>& RefreshingNames();
// Returns the value of a name on the command line.
[[nodiscard]] Refreshing RefreshingOf(const std::string& name);

// Stores the route as it should be after the visit: a new teaching of it by this agent, complete
// and not yet acknowledged, so that it is sent with the rest of the store. Its tags and description
// say what it is. kUnavailable says why nothing was refreshed, or why the visit is not believed;
// other errors are the store's.
[[nodiscard]] Result<route::RouteInfo> StoreRefreshed(const AgentId& self,
                                                      const route::RouteInfo& followed,
                                                      const refresh::Visit& visit, Refreshing how,
                                                      store::RouteStore& store);

// Logs the outcome.
void TellRefreshed(const Result<route::RouteInfo>& refreshed);

}  // namespace trailcast::agent
