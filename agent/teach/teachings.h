#pragma once

#include <string>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Returns the contents of an agent's store for people: a line for each revision, the newest first,
// and what can be done about those that were cut off. `store_file` appears in these lines.
[[nodiscard]] Result<std::string> TeachingsText(store::RouteStore& store,
                                                const std::string& store_file);

}  // namespace trailcast::agent
