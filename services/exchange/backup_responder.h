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

struct BackupResponderOptions {
  // A server that comes before this one has this long to answer and, once it answers, between its
  // messages.
  std::chrono::milliseconds patience{300};
  // All servers answer an agent that asks for the same again within this time.
  std::chrono::milliseconds asked_again{10'000};
  // A server that did not send a route has probably not got it. Others do not wait for it for this
  // long.
  std::chrono::milliseconds silent_for{60'000};
};

// This makes one of several servers, which may share a store, answer an agent that lacks segments
// of a route: the one to which the route falls (rendezvous hashing). The others hear it and back it
// up, one after the other, for what it does not send. No clock, no I/O.
class BackupResponder {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMostRemembered = 16'384;  // segments that are left to others

  explicit BackupResponder(AgentId self, BackupResponderOptions options = {})
      : self_(std::move(self)), options_(options) {}

  // Takes in which servers are present, and what they send.
  void Handle(const Message& message, Time now);
  // Returns those of the asked segments, all of them held here, that have to be sent at once.
  [[nodiscard]] std::vector<SegmentIndex> Mine(const AgentId& requester, const route::RouteKey& key,
                                               const std::vector<SegmentIndex>& asked, Time now);
  // Returns segments that were left to others, and that none of them sent.
  [[nodiscard]] std::map<route::RouteKey, std::vector<SegmentIndex>> Due(Time now);

 private:
  using Place = std::pair<route::RouteKey, SegmentIndex>;
  struct Left {
    AgentId owner;
    Time heard_at{};  // when another server of this route was last heard
    std::map<SegmentIndex, Time> due;
  };

  void HandleBatch(const SegmentBatch& batch, Time now);
  // Returns the servers that come before this one, in order.
  [[nodiscard]] std::vector<AgentId> Before(const AgentId& requester, const route::RouteKey& key,
                                            Time now) const;

  AgentId self_;
  BackupResponderOptions options_;
  ServersThere servers_;  // other servers
  std::map<route::RouteKey, Left> left_;
  std::size_t remembered_ = 0;  // in left_
  NewestMap<std::pair<AgentId, Place>, Time> asked_once_{kMostRemembered};
  NewestMap<Place, Time> sent_{kMostRemembered};  // by other servers
  NewestMap<std::pair<AgentId, route::RouteKey>, Time> silent_until_{1024};
};

}  // namespace trailcast::exchange
