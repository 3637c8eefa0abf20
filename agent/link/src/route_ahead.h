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

// The route that a follower is to drive along next: found, fetched into the own store as far as
// that lacks it, and read from there, beside the one that it follows. The link's thread. Whatever
// fails, there is nothing to read: who then stands before that route asks for it anew, and is told
// why.
class RouteAhead {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `store` outlives it. Not `online`: the own store has it, or it is not to be had.
  RouteAhead(const AgentId& self, RouteWish wish, store::RouteStore& store, bool online, Time now);

  void Handle(const exchange::Message& message, Time now);
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);
  // Whose segments it waits for.
  [[nodiscard]] std::optional<route::RouteKey> listens_to() const;
  // True once, when the own store has come to have all of it.
  [[nodiscard]] bool TakeFetched() { return std::exchange(fetched_, false); }

  [[nodiscard]] std::uint32_t number() const { return wish_.number; }
  // The next of: the route, where on it the robot begins, its segments, that these are all.
  // Nothing: not now. An item that could not be handed on is given back.
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
  std::optional<exchange::RouteFetcher> fetcher_;  // while some of it is missing
  bool fails_ = false;
  bool all_here_ = false;
  bool fetched_ = false;
  std::uint32_t next_ = 0;  // of its segments
  enum class Fed : std::uint8_t { kNothing, kRoute, kSegments, kAll } fed_ = Fed::kNothing;
  std::optional<Feed> given_back_;
};

}  // namespace trailcast::agent
