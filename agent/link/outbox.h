#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/route_sender.h"
#include "services/route/manifest.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Sends everything in a scout's store that no server has acknowledged yet: the route being taught,
// and what earlier runs left behind. The link thread owns it, as it owns the store.
class Outbox {
 public:
  using Time = exchange::RouteSender::Time;

  // `store` must outlive the outbox.
  Outbox(AgentId self, store::RouteStore& store) : self_(std::move(self)), store_(store) {}

  // Takes up what earlier runs of this agent left: unacknowledged segments, and routes whose
  // teaching was cut off, which end with what is on disk. Returns one line for people on each.
  [[nodiscard]] Result<std::vector<std::string>> LoadBacklog();
  // Keeps LoadBacklog from sending this route, because its teaching may continue.
  void Spare(const route::RouteKey& key) { spared_ = key; }

  // Begins a new route, which is on disk when this returns.
  [[nodiscard]] Result<void> Begin(const route::RouteInfo& info);
  // Begins a teaching with all segments of an earlier one that was cut off; it is the same one if
  // `info` has its key. kCorrupt means that they cannot all be read.
  [[nodiscard]] Result<void> GoOn(const route::RouteInfo& earlier, const route::RouteInfo& info);
  // Gives up a teaching that was cut off, which is never offered again. If servers may have some of
  // it, they are told that it ends there (`send`: now), because a scout deletes nothing on a
  // server. Returns one line for people.
  [[nodiscard]] Result<std::string> Discard(route::RouteInfo info, bool send);
  // Adds the route's next segment, which is on disk when this returns and is sent afterwards.
  [[nodiscard]] Result<void> Add(const route::RouteKey& key, const route::Segment& segment);
  // Ends the route; with `cut_off` more segments were meant to follow.
  [[nodiscard]] Result<void> Complete(const route::RouteKey& key, bool cut_off = false);

  // A segment that a server lacks is offered again if the store has it, even if it was acknowledged
  // once.
  void Handle(const exchange::Message& message, Time now);
  // Returns messages to publish.
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);
  // Takes back one of Tick's messages that could not be sent; a later Tick returns it again.
  void NotSent(const exchange::Message& message, Time now);
  // Returns the errors since the last call of reading what should have been sent.
  [[nodiscard]] std::vector<Error> TakeReadErrors();
  // Writes down what servers have acknowledged.
  [[nodiscard]] Result<void> SaveReceipts();

  [[nodiscard]] const route::RouteInfo& info(const route::RouteKey& key) const;
  // Returns how many segments were not acknowledged, over all routes that were not deleted.
  [[nodiscard]] std::size_t unreceipted() const;
  // Returns why a server refuses a route, or what it has instead, as one line for people; the first
  // of several.
  [[nodiscard]] std::optional<std::string> refusal() const;
  // Returns a server's remark on a route, for people, which may be empty.
  [[nodiscard]] const std::string& remark(const route::RouteKey& key) const;
  // Says whether every route is complete and acknowledged.
  [[nodiscard]] bool AllReceipted() const;
  // Says whether nothing is left to be sent: everything is acknowledged, or was deleted by an
  // operator.
  [[nodiscard]] bool Done() const;
  // Returns the route's state by a server, or nothing if none has told it.
  [[nodiscard]] std::optional<exchange::StandingThere> standing(const route::RouteKey& key) const;
  // Returns all routes whose final description was sent and acknowledged.
  [[nodiscard]] std::vector<route::RouteInfo> Receipted() const;

 private:
  struct Sending {
    exchange::RouteSender sender;
    std::optional<route::RouteBuilder> teaching;
    std::set<SegmentIndex> confirmed{};  // not yet written down
    // Deleted by an operator, or discarded; later runs do not offer it again.
    bool laid_aside = false;
  };

  // Tells which acknowledgements count: those noted in the store, or none, for a server that does
  // not have the route.
  enum class Receipts : std::uint8_t { kNoted, kNone };
  Result<std::string> TakeUp(route::RouteInfo info, Receipts receipts);
  // Handles a server's question for a route that was once acknowledged completely.
  void OfferAgain(const exchange::SegmentRequest& request);
  [[nodiscard]] Result<void> EndCutOff(route::RouteInfo& info,
                                       const std::vector<store::HeldSegment>& held);
  void Emplace(const route::RouteInfo& info, exchange::SegmentDigests held,
               const std::vector<SegmentIndex>& receipted,
               std::optional<route::RouteBuilder> teaching);

  AgentId self_;
  store::RouteStore& store_;
  std::map<route::RouteKey, Sending> sending_;
  NewestMap<AgentId, std::monostate> servers_{64};  // that were heard
  std::optional<route::RouteKey> spared_;
};

}  // namespace trailcast::agent
