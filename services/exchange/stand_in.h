#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/exchange/servers_there.h"

namespace trailcast::exchange {

struct StandInOptions {
  // How long who comes before is left to answer, and, as long as it does, to go on.
  std::chrono::milliseconds patience{300};
  // Who asks for the same again within this is answered by all.
  std::chrono::milliseconds asked_again{10'000};
  // A server that let others stand in has not got the route: it is not waited for, for so long.
  std::chrono::milliseconds silent_for{60'000};
};

// Of several servers, which may share a store, one answers who lacks segments of a route: the one
// to which the route falls (rendezvous hashing). The others hear it, and stand in, one after the
// other, for what it does not send. No clock, no I/O.
class StandIn {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMostRemembered = 16'384;  // of what is left to others

  explicit StandIn(AgentId self, StandInOptions options = {})
      : self_(std::move(self)), options_(options) {}

  // Who is there, and what it sends.
  void Handle(const Message& message, Time now);
  // Of what is asked for, all of it held here, that which is to be sent at once.
  [[nodiscard]] std::vector<SegmentIndex> Mine(const AgentId& requester, const route::RouteKey& key,
                                               const std::vector<SegmentIndex>& asked, Time now);
  // What was left to others, and none of them sent.
  [[nodiscard]] std::map<route::RouteKey, std::vector<SegmentIndex>> Due(Time now);

 private:
  using Place = std::pair<route::RouteKey, SegmentIndex>;
  struct Left {
    AgentId owner;
    Time heard_at{};  // another server, of this route
    std::map<SegmentIndex, Time> due;
  };

  void HandleBatch(const SegmentBatch& batch, Time now);
  // Those that come before this one, the first first.
  [[nodiscard]] std::vector<AgentId> Before(const AgentId& requester, const route::RouteKey& key,
                                            Time now) const;

  AgentId self_;
  StandInOptions options_;
  ServersThere servers_;  // others
  std::map<route::RouteKey, Left> left_;
  std::size_t remembered_ = 0;  // in left_
  NewestMap<std::pair<AgentId, Place>, Time> asked_once_{kMostRemembered};
  NewestMap<Place, Time> sent_{kMostRemembered};  // by other servers
  NewestMap<std::pair<AgentId, route::RouteKey>, Time> silent_until_{1024};
};

}  // namespace trailcast::exchange
