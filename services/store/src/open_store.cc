#include "services/store/open_store.h"

#include "services/store/postgres_url.h"

namespace trailcast::store {

Result<std::unique_ptr<RouteStore>> OpenStore(const std::string& location,
                                              const StoreOptions& options) {
  if (!IsPostgresUrl(location)) return OpenSqliteStore(location, {.max_bytes = options.max_bytes});
  if (options.max_bytes > 0) {
    return Fail(ErrorCode::kInvalidArgument,
                "a store in PostgreSQL takes no limit from here: several servers share it; leave "
                "the limit out, and give the database a tablespace or disk of the size wanted");
  }
  return OpenPostgresStore(location);
}

}  // namespace trailcast::store
