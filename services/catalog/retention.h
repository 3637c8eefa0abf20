#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Which revisions a server keeps without being told. The active one of a route always is.
struct RetentionPolicy {
  std::uint32_t keep_revisions = 0;  // of the others of a route the newest complete ones; 0: all
  // Others go when nothing of them was stored for so long, by the time that the server has seen
  // pass; 0: never.
  std::chrono::hours keep_for{0};
  // Of all routes together at most so many go in a day; what is more waits for the next ones.
  std::uint32_t most_a_day = 100;
  [[nodiscard]] bool any() const { return keep_revisions > 0 || keep_for.count() > 0; }
};

// Walks through the stored routes again and again, some at a time, and says what is to go. No
// clock counts, which somebody may have set, and what is being taught is not old. Not thread-safe.
class Retention {
 public:
  // `store` outlives it.
  Retention(store::RouteStore& store, const RetentionPolicy& policy)
      : store_(store), policy_(policy) {}

  // For how long each of these lies in the store as it is: with the same `grown_unix_ms`.
  using Grown = std::pair<route::RouteKey, std::int64_t>;
  using AgesOf =
      std::function<Result<std::vector<std::chrono::milliseconds>>(const std::vector<Grown>&)>;
  // Looks at some routes more: their revisions that are to go, as tombstones. Writes nothing.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> Next(const AgesOf& ages_of);

 private:
  using Ages = std::map<route::RouteKey, std::chrono::milliseconds>;
  [[nodiscard]] std::vector<route::RouteInfo> Outdated(
      const std::vector<route::RouteInfo>& revisions, const Ages& ages) const;

  store::RouteStore& store_;
  RetentionPolicy policy_;
  std::string cursor_;
};

}  // namespace trailcast::catalog
