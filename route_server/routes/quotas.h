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

// 0: as much as there is.
struct QuotaOptions {
  std::uint32_t segments_per_s = 0;  // that an agent may have stored, or be sent
  std::uint32_t requests_per_s = 0;  // of a member: questions, edits, missions
  std::uint64_t stored_bytes = 0;    // of the routes that a scout taught
  std::uint32_t routes = 0;          // that a scout taught, all revisions

  [[nodiscard]] bool any() const {
    return segments_per_s > 0 || requests_per_s > 0 || stored_bytes > 0 || routes > 0;
  }
};

// How much of a server each agent, by its name, may use. Whoever reaches a quota is told so in
// words; what is not taken stays where it is, and is offered, or asked for, again. Errors are
// kUnavailable with these words. No clock.
class Quotas {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Stored {
    std::uint64_t routes = 0;
    std::uint64_t bytes = 0;
  };
  // What is stored of a scout's routes, at present.
  using Look = std::function<Result<Stored>(const AgentId& scout)>;
  // So long what was looked up counts, and what was taken since.
  static constexpr std::chrono::seconds kLookAgain{10};
  static constexpr std::size_t kMostAgents = 4096;  // strangers can make up names

  Quotas(const QuotaOptions& options, Look look) : options_(options), look_(std::move(look)) {}

  // How many of so many segments may be taken from `agent`, or sent to it, now.
  [[nodiscard]] std::size_t TakeSegments(const AgentId& agent, std::size_t wanted, Time now);
  [[nodiscard]] Error TooManySegments(const AgentId& agent) const;
  [[nodiscard]] Result<void> TakeRequest(const AgentId& member, Time now);
  [[nodiscard]] Result<void> TakeBytes(const AgentId& scout, std::size_t bytes, Time now);
  [[nodiscard]] bool limits_routes() const { return options_.routes > 0; }
  // Of a route that is not stored yet.
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
    Stored stored;                    // then, and the bytes taken since
    std::set<route::RouteKey> begun;  // routes taken since
  };
  [[nodiscard]] Result<Account*> LookedAt(const AgentId& scout, Time now);

  QuotaOptions options_;
  Look look_;
  NewestMap<AgentId, Account> accounts_{kMostAgents};
};

}  // namespace trailcast::server
