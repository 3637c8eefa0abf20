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

// Which revisions a server keeps on its own. It always keeps a route's active one.
struct RetentionPolicy {
  std::uint32_t keep_revisions = 0;  // of a route's other complete revisions, the newest; 0 keeps
                                     // all
  // Other revisions are deleted if nothing of them was stored for so long, by the time that the
  // server has seen pass; 0 keeps them for ever.
  std::chrono::hours keep_for{0};
  // At most so many are deleted in a day, of all routes together; the others wait for the next
  // days.
  std::uint32_t most_a_day = 100;
  [[nodiscard]] bool any() const { return keep_revisions > 0 || keep_for.count() > 0; }
};

// Decides which revisions are to be deleted. It walks through the stored routes again and again,
// some at a time. It uses no clock, because somebody may have set that, and a route that is being
// taught is not old. It is not thread-safe.
class Retention {
 public:
  // `store` must outlive it.
  Retention(store::RouteStore& store, const RetentionPolicy& policy)
      : store_(store), policy_(policy) {}

  // Returns for how long each of these has been in the store unchanged, with the same
  // `grown_unix_ms`.
  using Grown = std::pair<route::RouteKey, std::int64_t>;
  using AgesOf =
      std::function<Result<std::vector<std::chrono::milliseconds>>(const std::vector<Grown>&)>;
  // Looks at some more routes and returns their revisions that are to be deleted, as tombstones. It
  // writes nothing.
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
