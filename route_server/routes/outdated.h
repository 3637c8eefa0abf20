#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "services/catalog/retention.h"
#include "services/records/age_store.h"

namespace trailcast::server {

// Decides which revisions the server deletes on its own: those that the policy does not keep, by
// ages that depend on no clock, and so many a day. It logs how many wait for another day.
class Outdated {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` must outlive it.
  Outdated(store::RouteStore& store, const catalog::RetentionPolicy& policy,
           std::unique_ptr<store::AgeStore> ages, Time now)
      : retention_(store, policy),
        ages_(std::move(ages)),
        most_a_day_(policy.most_a_day),
        aged_at_(now) {}

  // Looks at some more routes and returns tombstones, which count as deleted.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> Next(Time now);

 private:
  catalog::Retention retention_;
  std::unique_ptr<store::AgeStore> ages_;
  std::uint32_t most_a_day_;
  Time aged_at_;
  Time tell_at_{};
};

}  // namespace trailcast::server
