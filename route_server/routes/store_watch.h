#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/store/route_store.h"

namespace trailcast::server {

// Whether the store can be used, looked at now and then, so that a server which nobody asks
// anything knows it too.
class StoreWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLookEvery{5'000};
  static constexpr std::chrono::milliseconds kLookEveryAway{1'000};

  // `store` outlives it.
  explicit StoreWatch(store::RouteStore& store) : store_(store) {}

  // Looks when that is due. A line when it went away, or is back.
  [[nodiscard]] std::optional<std::string> Look(Time now);
  // Why it cannot be used; empty: it can.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  store::RouteStore& store_;
  Time due_{};
  std::string trouble_;
};

}  // namespace trailcast::server
