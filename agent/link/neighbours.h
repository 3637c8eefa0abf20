#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::agent {

// Another follower on one's own revision of a route, as it last told of itself.
struct Neighbour {
  AgentId agent;
  double along_m = 0.0;  // its place on the route
  double speed_mps = 0.0;
  std::chrono::steady_clock::time_point told_at{};  // when that was heard
  bool heard =
      true;  // false: its agent has ended or is out of reach; its robot may stand there yet
  bool operator==(const Neighbour&) const = default;
};

// Who else is on the route, from the statuses that agents publish, and, where agents do not hear
// each other, from what servers tell. Owned by the thread that owns the exchange.
//
// Whoever arrived is taken to make room. Whoever ended anywhere else, or is no longer heard, is
// taken to stand where it last was, until it tells of another place or for kRemembered: somebody
// may restart it, or fetch it, or the radio may come back. An agent that was restarted stays where
// it was until it has found itself on a route again.
class Neighbours {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{60};
  // Strangers can make up names: beyond it the one is forgotten that told of itself the longest
  // ago.
  static constexpr std::size_t kMost = 1024;

  // `self` is no neighbour of its own, nor is what went by its name before.
  explicit Neighbours(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now);

  // Those on `route`, by name.
  [[nodiscard]] std::vector<Neighbour> On(const route::RouteKey& route) const;
  // Takes those out who are remembered for too long, and says who they are.
  [[nodiscard]] std::vector<Neighbour> Forget(Time now);

 private:
  struct Known {
    std::uint64_t instance = 0;
    route::RouteKey route;
    Neighbour neighbour;
    std::optional<AgentId> told_by{};  // a server; none: it spoke itself
  };
  void Handle(const exchange::AgentStatus& status, Time now);
  void MakeRoom();
  void Handle(const exchange::AgentGone& gone);
  void Handle(const exchange::RouteFollowers& told, Time now);

  AgentId self_;
  std::map<AgentId, Known> known_;
};

}  // namespace trailcast::agent
