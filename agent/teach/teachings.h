#pragma once

#include <string>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// What is in an agent's store, for people: a line a revision, the newest first, and what may become
// of those that were cut off. `store_file` is for these words.
[[nodiscard]] Result<std::string> TeachingsText(store::RouteStore& store,
                                                const std::string& store_file);

}  // namespace trailcast::agent
