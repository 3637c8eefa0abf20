#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "services/catalog/retention.h"
#include "services/records/age_store.h"

namespace trailcast::server {

// Which revisions go without anybody asking: what the policy does not keep, by ages that no clock
// makes, and so many a day. Tells the log what waits for another day.
class Outdated {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` outlives it.
  Outdated(store::RouteStore& store, const catalog::RetentionPolicy& policy,
           std::unique_ptr<store::AgeStore> ages, Time now)
      : retention_(store, policy),
        ages_(std::move(ages)),
        most_a_day_(policy.most_a_day),
        aged_at_(now) {}

  // Of some routes more, as tombstones; they count as deleted.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> Next(Time now);

 private:
  catalog::Retention retention_;
  std::unique_ptr<store::AgeStore> ages_;
  std::uint32_t most_a_day_;
  Time aged_at_;
  Time tell_at_{};
};

}  // namespace trailcast::server
