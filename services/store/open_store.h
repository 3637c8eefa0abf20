#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

struct StoreOptions {
  std::uint64_t max_bytes = 0;  // see SqliteOptions; a database's size is limited by its own means
};

// Opens a store in a file, or in the PostgreSQL database of a URL (postgres_url.h). Errors are
// those of OpenSqliteStore and OpenPostgresStore, and kInvalidArgument for a limit that would have
// no effect.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenStore(const std::string& location,
                                                            const StoreOptions& options = {});

}  // namespace trailcast::store
