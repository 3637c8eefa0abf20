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

struct SpareHolderOptions {
  // How long others are left to answer first: between once and twice this, by the holder's name,
  // so that of many spare holders one answers and the others hear it.
  std::chrono::milliseconds patience{300};
  std::size_t answer_bytes_per_tick = 64U << 10U;
  // How long it listens to what others answer, once it was asked in vain.
  std::chrono::milliseconds listen_for{10'000};
};

// A follower that has whole revisions in its own store, and lends them: to a server, whose copy
// was damaged, and to anybody while no server is there. Only what was asked for in vain: the first
// time it is left to the scout and to other servers, and what somebody else answers is forgotten.
// So a busy link carries nothing twice. No clock, no I/O: messages in, messages out.
class SpareHolder {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Reads from the owner's store; what fails is not sent.
  using ReadPiece =
      std::function<Result<route::SegmentPiece>(const route::RouteKey&, SegmentIndex)>;
  using ReadInfo = std::function<Result<std::optional<route::RouteInfo>>(const route::RouteKey&)>;

  // With `read_info` it also answers a server that asks who has a route that it lacks.
  SpareHolder(AgentId self, ReadPiece read, ReadInfo read_info = {},
              SpareHolderOptions options = {});

  // The revisions that the owner has all of.
  void Hold(const std::vector<route::RouteKey>& revisions);

  void Handle(const Message& message, Time now);
  [[nodiscard]] std::vector<Message> Tick(Time now);
  // Of what Tick returned, this could not be handed over: a later Tick returns it again, unless
  // somebody else answers meanwhile.
  void NotSent(const Message& message, Time now);
  // Whose segments it has to hear, to leave to others what they answer.
  [[nodiscard]] std::set<route::RouteKey> ListensTo(Time now) const;

 private:
  using Place = std::pair<route::RouteKey, SegmentIndex>;
  struct Due {
    Time at;  // unless somebody else answers
    bool digest_only = false;
  };

  void HandleRequest(const SegmentRequest& request, Time now);

  AgentId self_;
  ReadPiece read_;
  ReadInfo read_info_;
  SpareHolderOptions options_;
  std::chrono::milliseconds patience_;
  std::set<route::RouteKey> held_;
  ServersThere servers_;
  std::set<std::pair<AgentId, Place>> asked_once_;
  std::map<Place, Due> to_answer_;
  std::map<route::RouteKey, Time> listens_until_;
  std::map<route::RouteKey, Time> to_announce_;
};

}  // namespace trailcast::exchange
