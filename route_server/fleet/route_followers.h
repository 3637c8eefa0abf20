#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::server {

// Tells followers on the same route of each other's places, because they do not hear each other.
//
// A robot that arrived has made room. One that ended anywhere else, or is no longer heard, is taken
// to stand at its last place for kRemembered, or until it reports another one. It has no clock and
// no I/O.
class FollowerRegistry {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{60};
  // Each route is published this often, and less often with more robots on it.
  static constexpr std::chrono::milliseconds kEvery{200};
  static constexpr std::chrono::milliseconds kForEachFollower{10};
  // A robot that is left alone on a route is told so this often and for so long, because some of it
  // may be lost.
  static constexpr std::chrono::seconds kAloneEvery{1};
  static constexpr std::chrono::seconds kAlone{10};

  explicit FollowerRegistry(AgentId server) : server_(std::move(server)) {}

  void Handle(const exchange::Message& message, Time now);
  // Returns what is to be published now.
  [[nodiscard]] std::vector<exchange::RouteFollowers> Due(Time now);

 private:
  struct Known {
    std::uint64_t instance = 0;
    double along_m = 0.0;
    double speed_mps = 0.0;
    bool heard = true;
    Time told_at{};
  };
  struct Route {
    std::map<AgentId, Known> followers;
    Time due{};
    std::optional<Time> alone_until;
  };
  void Hear(const exchange::AgentStatus& status, Time now);
  void Remove(const AgentId& agent, Time now);
  [[nodiscard]] exchange::RouteFollowers Tell(const route::RouteKey& key, Route& route, Time now);

  static constexpr std::size_t kMostFollowers = 65'536;  // strangers can make up names

  AgentId server_;
  std::map<route::RouteKey, Route> routes_;
  std::map<AgentId, route::RouteKey> on_;  // each follower's route
  Time next_{};                            // nothing is due before
};

}  // namespace trailcast::server
