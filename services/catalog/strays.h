#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Segments that nobody can ever ask for: of teachings of which nothing else is known, because they
// were never announced, or of deleted ones. Walks through the store again and again, some teachings
// at a time. What is being taught is announced, and grows. Not thread-safe.
class Strays {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::hours kKept{24};

  // `store` outlives it.
  explicit Strays(store::RouteStore& store) : store_(store) {}

  // Looks at some teachings more: those that were seen to be strays, and to have as many segments,
  // for so long.
  [[nodiscard]] Result<std::vector<store::HeldTeaching>> Next(Time now);

 private:
  struct Seen {
    std::uint64_t segments = 0;
    Time since;
  };
  [[nodiscard]] static route::RouteKey BeforeAll() { return {RouteId(), TeachingId()}; }
  [[nodiscard]] bool IsOld(const store::HeldTeaching& stray, Time now);

  store::RouteStore& store_;
  std::map<route::RouteKey, Seen> seen_;
  route::RouteKey last_ = BeforeAll();  // looked at
};

}  // namespace trailcast::catalog
