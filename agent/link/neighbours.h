#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::agent {

// Another follower on the same revision of a route, by its last report.
struct Neighbour {
  AgentId agent;
  double along_m = 0.0;  // its place on the route
  double speed_mps = 0.0;
  std::chrono::steady_clock::time_point told_at{};  // when the report was heard
  bool heard =
      true;  // false if its agent has ended or is out of reach; its robot may still stand there
  bool operator==(const Neighbour&) const = default;
};

// Knows the other robots on the route. It hears the statuses that agents publish and, where agents
// do not hear each other, servers' reports. The thread that owns the exchange owns it.
//
// A robot that arrived is taken to make room. One that ended anywhere else, or is no longer heard,
// is taken to stand at its last place until it reports another one, or for kRemembered: somebody
// may restart it or fetch it, or the radio may come back. A restarted agent stays where it was
// until it has found itself on a route again.
class Neighbours {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{60};
  // Strangers can make up names, so beyond this number the one with the oldest report is forgotten.
  static constexpr std::size_t kMost = 1024;

  // `self` is not its own neighbour, and neither is an earlier process of its name.
  explicit Neighbours(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now);

  // Returns the robots on `route`, by name.
  [[nodiscard]] std::vector<Neighbour> On(const route::RouteKey& route) const;
  // Removes those that were remembered for too long, and returns them.
  [[nodiscard]] std::vector<Neighbour> Forget(Time now);

 private:
  struct Known {
    std::uint64_t instance = 0;
    route::RouteKey route;
    Neighbour neighbour;
    std::optional<AgentId> told_by{};  // the server that reported it; none if it reported itself
  };
  void Handle(const exchange::AgentStatus& status, Time now);
  void MakeRoom();
  void Handle(const exchange::AgentGone& gone);
  void Handle(const exchange::RouteFollowers& told, Time now);

  AgentId self_;
  std::map<AgentId, Known> known_;
};

}  // namespace trailcast::agent
