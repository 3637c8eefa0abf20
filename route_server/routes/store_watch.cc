#include "route_server/routes/store_watch.h"

#include <fmt/format.h>

#include <utility>

namespace trailcast::server {

std::optional<std::string> StoreWatch::Look(Time now) {
  if (now < due_) return std::nullopt;
  const auto reachable = store_.CheckReachable();
  const std::string before = std::exchange(trouble_, reachable ? "" : reachable.error().message);
  due_ = now + (reachable ? kLookEvery : kLookEveryAway);
  if (before.empty() == trouble_.empty()) return std::nullopt;
  if (reachable) return "the store is there again";
  return fmt::format("the store is away, nothing is confirmed or answered meanwhile: {}", trouble_);
}

}  // namespace trailcast::server
