#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "agent/link/feed.h"
#include "agent/link/route_wish.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_finder.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// The route that a follower will drive next. It is found, fetched into the own store as far as that
// lacks it, and read from there, while the robot follows another one. The link's thread owns it. If
// anything fails, there is nothing to read; a robot that comes to that route asks for it again, and
// is told why.
class RouteAhead {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` must outlive it. If it is not `online`, the route comes from the own store or not at
  // all.
  RouteAhead(const AgentId& self, RouteWish wish, store::RouteStore& store, bool online, Time now);

  void Handle(const exchange::Message& message, Time now);
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);
  // Returns the route for whose segments it waits.
  [[nodiscard]] std::optional<route::RouteKey> listens_to() const;
  // Returns true once, when the own store has the whole route.
  [[nodiscard]] bool TakeFetched() { return std::exchange(fetched_, false); }

  [[nodiscard]] std::uint32_t number() const { return wish_.number; }
  // Returns the next item: the route, where the robot begins on it, its segments, that these are
  // all; or nothing for now. An item that could not be passed on is given back.
  [[nodiscard]] std::optional<Feed> Next();
  void GiveBack(Feed item) { given_back_ = std::move(item); }

 private:
  void Choose(Time now);
  void FetchMissing(Time now);
  void StoreArrived(Time now);
  [[nodiscard]] std::optional<Feed> Read();

  AgentId self_;
  RouteWish wish_;
  store::RouteStore& store_;
  bool online_;
  Time began_;
  exchange::RouteFinder finder_;
  std::optional<route::RouteInfo> route_;
  std::optional<exchange::RouteFetcher> fetcher_;  // while segments are missing
  bool fails_ = false;
  bool all_here_ = false;
  bool fetched_ = false;
  std::uint32_t next_ = 0;  // index of the next segment
  enum class Fed : std::uint8_t { kNothing, kRoute, kSegments, kAll } fed_ = Fed::kNothing;
  std::optional<Feed> given_back_;
};

}  // namespace trailcast::agent
