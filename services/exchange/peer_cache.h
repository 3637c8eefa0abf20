#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/servers_there.h"

namespace trailcast::exchange {

struct PeerCacheOptions {
  // Others have this long to answer first. It is multiplied by one to two, depending on the
  // holder's name, so that one of many holders answers and the others hear it.
  std::chrono::milliseconds patience{300};
  std::size_t answer_bytes_per_tick = 64U << 10U;
  // After a request in vain it listens this long to what others answer.
  std::chrono::milliseconds listen_for{10'000};
};

// This is a peer cache: a follower that has whole revisions in its own store serves them to a
// server whose copy was damaged, and to any agent while no server is present. It serves only what
// was asked for in vain. The first request is left to the scout and to other servers, and what
// another agent answers is forgotten, so that a busy link carries nothing twice. No clock, no I/O:
// messages go in, messages come out.
class PeerCache {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Reads from the owner's store. A segment that cannot be read is not sent.
  using ReadPiece =
      std::function<Result<route::SegmentPiece>(const route::RouteKey&, SegmentIndex)>;
  using ReadInfo = std::function<Result<std::optional<route::RouteInfo>>(const route::RouteKey&)>;

  // With `read_info` it also answers a server that asks who has a route that the server lacks.
  PeerCache(AgentId self, ReadPiece read, ReadInfo read_info = {}, PeerCacheOptions options = {});

  // Sets the revisions that are whole in the owner's store.
  void Hold(const std::vector<route::RouteKey>& revisions);

  void Handle(const Message& message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Notes that a message of Tick could not be handed over. A later Tick returns it again, unless
  // another agent answers meanwhile.
  void NotSent(const Message& message, Time now);
  // Returns the routes whose segments it has to hear, so as not to repeat what others answer.
  [[nodiscard]] std::set<route::RouteKey> ListensTo(Time now) const;

 private:
  using Place = std::pair<route::RouteKey, SegmentIndex>;
  struct Due {
    Time at;  // unless another agent answers
    bool digest_only = false;
  };

  void HandleRequest(const SegmentRequest& request, Time now);

  AgentId self_;
  ReadPiece read_;
  ReadInfo read_info_;
  PeerCacheOptions options_;
  std::chrono::milliseconds patience_;
  std::set<route::RouteKey> held_;
  ServersThere servers_;
  std::set<std::pair<AgentId, Place>> asked_once_;
  std::map<Place, Due> to_answer_;
  std::map<route::RouteKey, Time> listens_until_;
  std::map<route::RouteKey, Time> to_announce_;
};

}  // namespace trailcast::exchange
