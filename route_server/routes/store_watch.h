#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/store/route_store.h"

namespace trailcast::server {

// Checks now and then that the store can be used, so that even an idle server notices a failure.
class StoreWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLookEvery{5'000};
  static constexpr std::chrono::milliseconds kLookEveryAway{1'000};

  // `store` must outlive it.
  explicit StoreWatch(store::RouteStore& store) : store_(store) {}

  // Checks if that is due. Returns a line if the store went away, or is back.
  [[nodiscard]] std::optional<std::string> Look(Time now);
  // Returns why it cannot be used, or an empty text.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  store::RouteStore& store_;
  Time due_{};
  std::string trouble_;
};

}  // namespace trailcast::server
