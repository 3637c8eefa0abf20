#pragma once

#include <string>
#include <vector>

#include "services/store/route_store.h"

namespace trailcast::store {

// Reads everything that a store, called `name` in messages, has of a revision, and adds a line for
// all damage. A revision that is deleted meanwhile counts as whole. Errors: the store cannot be
// read, or its index of the revision is kCorrupt.
[[nodiscard]] Result<void> VerifyRevision(RouteStore& store, const std::string& name,
                                          const route::RouteKey& key,
                                          std::vector<std::string>& damage);

}  // namespace trailcast::store
