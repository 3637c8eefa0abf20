#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Finds orphans: segments for which nobody can ever ask, because their teaching was never announced
// or was deleted. It walks through the store again and again, some teachings at a time. A route
// that is being taught is announced and grows, so it is none. It is not thread-safe.
class Orphans {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::hours kKept{24};

  // `store` must outlive it.
  explicit Orphans(store::RouteStore& store) : store_(store) {}

  // Looks at some more teachings and returns those that were orphans with the same number of
  // segments for so long.
  [[nodiscard]] Result<std::vector<store::HeldTeaching>> Next(Time now);

 private:
  struct Seen {
    std::uint64_t segments = 0;
    Time since;
  };
  [[nodiscard]] static route::RouteKey BeforeAll() { return {RouteId(), TeachingId()}; }
  [[nodiscard]] bool IsOld(const store::HeldTeaching& orphan, Time now);

  store::RouteStore& store_;
  std::map<route::RouteKey, Seen> seen_;
  route::RouteKey last_ = BeforeAll();  // the last one looked at
};

}  // namespace trailcast::catalog
