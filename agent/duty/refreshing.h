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

// What becomes of a route that a follower has met changed.
enum class Refreshing : std::uint8_t {
  kOff,
  kReview,  // it is refreshed, and followed once an operator has activated that
  kAuto,    // and needs no look first
};
[[nodiscard]] const std::vector<std::string>& RefreshingNames();
// Of one of them.
[[nodiscard]] Refreshing RefreshingOf(const std::string& name);

// Puts the route as it should be after the visit into the agent's own store: another teaching of
// it, by this agent, complete, without a receipt yet, so that who delivers what the store has sends
// this, too. Its tags and description say what it is. kUnavailable, saying why, where there is
// nothing to refresh, or the visit is not believed; otherwise errors are the store's.
[[nodiscard]] Result<route::RouteInfo> StoreRefreshed(const AgentId& self,
                                                      const route::RouteInfo& followed,
                                                      const refresh::Visit& visit, Refreshing how,
                                                      store::RouteStore& store);

// Says in the log what has come of it.
void TellRefreshed(const Result<route::RouteInfo>& refreshed);

}  // namespace trailcast::agent
