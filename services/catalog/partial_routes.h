#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/lacking.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Complete routes that a server has in part only: some of their segments are not in the store, or
// are damaged there. Walks through the store again and again, some routes at a time, and is told of
// what is found damaged or stored meanwhile. Not thread-safe.
class PartialRoutes {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` outlives it.
  explicit PartialRoutes(store::RouteStore& store) : store_(store) {}

  // Looks at some routes more; those of them that are there in part.
  [[nodiscard]] Result<std::vector<route::RouteKey>> Look();
  void NoteDamaged(const route::RouteKey& key, SegmentIndex segment);
  void NoteStored(const route::RouteKey& key, SegmentIndex segment);
  // Of which nobody was told yet, or not for an hour.
  [[nodiscard]] std::vector<store::LackingRoute> TakeUntold(Time now);

  [[nodiscard]] std::size_t routes() const { return partial_.size(); }
  [[nodiscard]] std::size_t segments() const;  // that these lack
  [[nodiscard]] std::size_t LackingOf(const route::RouteKey& key) const;

 private:
  struct Partial {
    route::RouteInfo info;
    std::set<SegmentIndex> missing;
    std::set<SegmentIndex> damaged;
    std::optional<Time> told;
    int seen_in_round = 0;
  };
  // True if it is there in part.
  [[nodiscard]] Result<bool> LookAt(const route::RouteInfo& info);
  void ForgetUnseen();

  store::RouteStore& store_;
  std::map<route::RouteKey, Partial> partial_;
  std::string cursor_;
  int round_ = 0;
};

}  // namespace trailcast::catalog
