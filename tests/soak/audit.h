#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/route_fetcher.h"
#include "tests/soak/member.h"

namespace trailcast::soak {

// This fetches a revision as any follower does, from any member that serves it, and compares it
// with what its scout taught.
class Audit {
 public:
  Audit(route::RouteKey key, const std::vector<route::SegmentPiece>& taught, Clock::time_point now);

  void Handle(const exchange::Message& message, Clock::time_point now);
  // Returns what to publish.
  [[nodiscard]] std::vector<exchange::Message> Tick(Clock::time_point now);
  [[nodiscard]] bool Complete() const { return fetcher_.Complete(); }
  // Returns the segments that came otherwise than they were taught.
  [[nodiscard]] std::size_t wrong() const { return wrong_; }

 private:
  std::vector<route::SegmentPiece> taught_;
  exchange::RouteFetcher fetcher_;
  std::size_t wrong_ = 0;
};

}  // namespace trailcast::soak
