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

// Finds complete routes that a server has only in part, because segments are missing from its store
// or damaged there. It walks through the store again and again, some routes at a time, and is told
// which segments are found damaged or stored meanwhile. It is not thread-safe.
class PartialRoutes {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` must outlive it.
  explicit PartialRoutes(store::RouteStore& store) : store_(store) {}

  // Looks at some more routes and returns those that are there in part.
  [[nodiscard]] Result<std::vector<route::RouteKey>> Look();
  void NoteDamaged(const route::RouteKey& key, SegmentIndex segment);
  void NoteStored(const route::RouteKey& key, SegmentIndex segment);
  // Returns the routes that were not reported yet, or not for an hour.
  [[nodiscard]] std::vector<store::LackingRoute> TakeUntold(Time now);

  [[nodiscard]] std::size_t routes() const { return partial_.size(); }
  [[nodiscard]] std::size_t segments() const;  // how many segments these lack
  [[nodiscard]] std::size_t LackingOf(const route::RouteKey& key) const;

 private:
  struct Partial {
    route::RouteInfo info;
    std::set<SegmentIndex> missing;
    std::set<SegmentIndex> damaged;
    std::optional<Time> told;
    int seen_in_round = 0;
  };
  // Returns true if the route is there in part.
  [[nodiscard]] Result<bool> LookAt(const route::RouteInfo& info);
  void ForgetUnseen();

  store::RouteStore& store_;
  std::map<route::RouteKey, Partial> partial_;
  std::string cursor_;
  int round_ = 0;
};

}  // namespace trailcast::catalog
