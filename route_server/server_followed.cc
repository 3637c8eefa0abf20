// How well robots follow.
#include <spdlog/spdlog.h>

#include "route_server/server.h"
#include "services/base/unix_time.h"

namespace trailcast::server {

// Not with each status: a commit of each would hold up receipts.
void Server::KeepFollowed(std::chrono::steady_clock::time_point now) {
  constexpr std::chrono::seconds kEvery{10};
  followed_due_ = now + kEvery;
  if (!network_) return;
  if (const auto kept = network_->KeepFollowed(NowUnixMs()); !kept) {
    spdlog::warn("how well robots follow is not saved: {}", kept.error().message);
  }
}

}  // namespace trailcast::server
