#pragma once

#include <memory>
#include <vector>

#include "services/exchange/peer_cache.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_keeper.h"
#include "services/exchange/route_sender.h"
#include "tests/contract/network.h"
#include "tests/support/faulty_exchange.h"
#include "tests/support/memory_store.h"
#include "tests/support/pieces.h"

namespace trailcast::test {

// These are a scout, a server and followers that share one route over a network of faults, stepped
// by hand. Each Step is 10 ms of their time, whatever the real network takes. The loops are those
// of the real programs: take, handle, tick, publish.
class Swarm {
 public:
  Swarm(NetworkKind kind, exchange::Faults faults)
      : network_(MakeNetwork(kind)), wait_(kind == NetworkKind::kDds ? 1 : 0), faults_(faults) {}

  struct Follower {
    std::unique_ptr<exchange::FaultyExchange> exchange;
    std::unique_ptr<exchange::RouteFetcher> fetcher;
    std::vector<route::SegmentPiece> arrived;
  };

  void StartScout();   // from its store, which survives StopScout
  void StartServer();  // from its store, likewise
  void StopScout() { sender_.reset(), scout_.reset(); }
  void StopServer() { keeper_.reset(), server_.reset(); }
  Follower& AddFollower();
  void AddLender();  // has all that was taught

  // Stores and streams one more segment. TeachLast also completes the route.
  void Teach(bool last = false);
  void TeachLast() { Teach(true); }

  void Step();
  // Steps until `done`. Returns whether that was within so much of the swarm's time.
  template <typename Done>
  [[nodiscard]] bool StepUntil(const Done& done, std::chrono::seconds limit = kLimit) {
    for (const auto end = now_ + limit; now_ < end && !done();) Step();
    return done();
  }
  void StepFor(std::chrono::milliseconds duration) {
    for (const auto end = now_ + duration; now_ < end;) Step();
  }

  [[nodiscard]] bool EverythingArrived() const;
  [[nodiscard]] bool HoldsExactly(const std::vector<route::SegmentPiece>& got) const;
  [[nodiscard]] std::vector<route::SegmentPiece> ServerPieces();

  [[nodiscard]] exchange::RouteSender& sender() { return *sender_; }
  [[nodiscard]] exchange::FaultyExchange& scout() { return *scout_; }
  [[nodiscard]] exchange::RouteKeeper& keeper() { return *keeper_; }
  [[nodiscard]] MemoryStore& server_store() { return server_store_; }
  [[nodiscard]] const std::vector<route::SegmentPiece>& taught() const { return taught_; }
  [[nodiscard]] std::chrono::steady_clock::time_point now() const { return now_; }
  [[nodiscard]] route::RouteInfo Info() const;

  static constexpr std::chrono::seconds kLimit{120};

 private:
  std::unique_ptr<exchange::FaultyExchange> Open(const exchange::TopicUse& use);

  std::unique_ptr<Network> network_;
  std::chrono::milliseconds wait_;  // real time for a real network
  exchange::Faults faults_;
  std::uint32_t seed_ = 1;
  std::chrono::steady_clock::time_point now_{};

  route::RouteKey key_ = KeyNumber(42);
  std::vector<route::SegmentPiece> taught_;
  bool complete_ = false;

  MemoryStore scout_store_;
  MemoryStore server_store_;
  std::unique_ptr<exchange::FaultyExchange> scout_;
  std::unique_ptr<exchange::FaultyExchange> server_;
  std::unique_ptr<exchange::RouteSender> sender_;
  std::unique_ptr<exchange::RouteKeeper> keeper_;
  std::vector<std::unique_ptr<Follower>> followers_;
  std::unique_ptr<exchange::FaultyExchange> lenders_exchange_;
  std::unique_ptr<exchange::PeerCache> lender_;
};

}  // namespace trailcast::test
