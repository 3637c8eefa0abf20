#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::server {

// Where followers are on their routes, told to those on the same one, who do not hear each other.
//
// Who arrived has made room. Who ended anywhere else, or is no longer heard, is taken to stand
// where it last was for kRemembered, and until it tells of another place. No clock, no I/O.
class RouteFollowersBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRemembered{60};
  // Each route is told of so often, and ever more rarely with more on it.
  static constexpr std::chrono::milliseconds kEvery{200};
  static constexpr std::chrono::milliseconds kForEachFollower{10};
  // Who is left alone on a route is told so, this often and so long: some of it may be lost.
  static constexpr std::chrono::seconds kAloneEvery{1};
  static constexpr std::chrono::seconds kAlone{10};

  explicit RouteFollowersBoard(AgentId server) : server_(std::move(server)) {}

  void Handle(const exchange::Message& message, Time now);
  // To be told now.
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
  std::map<AgentId, route::RouteKey> on_;  // the route that each is on
  Time next_{};                            // nothing is due before
};

}  // namespace trailcast::server
