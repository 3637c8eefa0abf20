#include "agent/link/src/held_revisions.h"

#include "services/exchange/bounds.h"

namespace trailcast::agent {

Result<std::vector<route::RouteKey>> HeldRevisions(store::RouteStore& store) {
  const auto page = store.QueryRoutes(
      {.state = route::RouteState::kComplete, .page_size = exchange::kMaxHeldTold});
  if (!page) return tl::unexpected(page.error());
  std::vector<route::RouteKey> held;
  for (const route::RouteInfo& info : page->routes) held.push_back(info.key);
  return held;
}

}  // namespace trailcast::agent
