#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Which revisions a server keeps without being told. The active one of a route always is.
struct RetentionPolicy {
  std::uint32_t keep_revisions = 0;  // of the others of a route the newest complete ones; 0: all
  // Others go when nothing of them was stored for so long, by this machine's clock; 0: never.
  std::chrono::hours keep_for{0};
  [[nodiscard]] bool any() const { return keep_revisions > 0 || keep_for.count() > 0; }
};

// Walks through the stored routes again and again, some at a time, and says what is to go. No
// clock of a scout counts, and what is being taught is not old. Not thread-safe.
class Retention {
 public:
  // `store` outlives it.
  Retention(store::RouteStore& store, const RetentionPolicy& policy)
      : store_(store), policy_(policy) {}

  // Looks at some routes more: their revisions that are to go, as tombstones. Writes nothing.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> Next(
      std::chrono::system_clock::time_point now);

 private:
  [[nodiscard]] std::vector<route::RouteInfo> Outdated(
      const std::vector<route::RouteInfo>& revisions,
      const std::map<TeachingId, std::int64_t>& grown_unix_ms, std::int64_t now_unix_ms) const;

  store::RouteStore& store_;
  RetentionPolicy policy_;
  std::string cursor_;
};

}  // namespace trailcast::catalog
