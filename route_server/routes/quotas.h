#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "services/base/newest_map.h"
#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// 0 means no limit.
struct QuotaOptions {
  std::uint32_t segments_per_s = 0;  // that may be stored for, or sent to, an agent
  std::uint32_t requests_per_s = 0;  // of a member: questions, edits, missions
  std::uint64_t stored_bytes = 0;    // of the routes that a scout taught
  std::uint32_t routes = 0;          // that a scout taught, counting all revisions

  [[nodiscard]] bool any() const {
    return segments_per_s > 0 || requests_per_s > 0 || stored_bytes > 0 || routes > 0;
  }
};

// Limits how much of a server each agent, by its name, may use. An agent that reaches a limit is
// told so. It keeps the rest, and offers or requests it again. Errors are kUnavailable with the
// text for the agent. It has no clock.
class Quotas {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Stored {
    std::uint64_t routes = 0;
    std::uint64_t bytes = 0;
  };
  // Returns what is stored of a scout's routes at present.
  using Look = std::function<Result<Stored>(const AgentId& scout)>;
  // So long the result of a look, and what was taken since, count.
  static constexpr std::chrono::seconds kLookAgain{10};
  static constexpr std::size_t kMostAgents = 4096;  // strangers can make up names

  Quotas(const QuotaOptions& options, Look look) : options_(options), look_(std::move(look)) {}

  // Returns how many of the wanted segments may now be taken from `agent`, or sent to it.
  [[nodiscard]] std::size_t TakeSegments(const AgentId& agent, std::size_t wanted, Time now);
  [[nodiscard]] Error TooManySegments(const AgentId& agent) const;
  [[nodiscard]] Result<void> TakeRequest(const AgentId& member, Time now);
  [[nodiscard]] Result<void> TakeBytes(const AgentId& scout, std::size_t bytes, Time now);
  [[nodiscard]] bool limits_routes() const { return options_.routes > 0; }
  // Takes a route that is not stored yet.
  [[nodiscard]] Result<void> TakeRoute(const AgentId& scout, const route::RouteKey& key, Time now);

 private:
  struct Bucket {
    std::optional<Time> filled_at;
    double holds = 0.0;
    [[nodiscard]] std::size_t Take(std::size_t wanted, double per_s, Time now);
  };
  struct Account {
    Bucket segments;
    Bucket requests;
    std::optional<Time> looked_at;
    Stored stored;                    // at that time, plus the bytes taken since
    std::set<route::RouteKey> begun;  // routes taken since
  };
  [[nodiscard]] Result<Account*> LookedAt(const AgentId& scout, Time now);

  QuotaOptions options_;
  Look look_;
  NewestMap<AgentId, Account> accounts_{kMostAgents};
};

}  // namespace trailcast::server
