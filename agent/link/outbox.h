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

// Everything in a scout's store that no server has confirmed yet: the route being taught, and what
// earlier runs left behind. Owned by the link thread, as the store is.
class Outbox {
 public:
  using Time = exchange::RouteSender::Time;

  // `store` outlives the outbox.
  Outbox(AgentId self, store::RouteStore& store) : self_(std::move(self)), store_(store) {}

  // Takes up what earlier runs of this agent left: unconfirmed segments, and routes whose teaching
  // was cut off, which end with what is on disk. Returns one line for people on each.
  [[nodiscard]] Result<std::vector<std::string>> LoadBacklog();
  // Nothing of this one is sent by LoadBacklog: it is gone on with, perhaps.
  void Spare(const route::RouteKey& key) { spared_ = key; }

  // A new route: on disk when this returns.
  [[nodiscard]] Result<void> Begin(const route::RouteInfo& info);
  // A teaching that begins with all segments of an earlier one that was cut off: the same one, if
  // `info` has its key. kCorrupt when they cannot all be read.
  [[nodiscard]] Result<void> GoOn(const route::RouteInfo& earlier, const route::RouteInfo& info);
  // Gives up a teaching that was cut off: it is offered to nobody again. Servers are told that it
  // ends where it does, if they may have some of it (`send`: now); a scout deletes nothing there.
  // One line for people.
  [[nodiscard]] Result<std::string> Discard(route::RouteInfo info, bool send);
  // The route's next segment: on disk when this returns, sent afterwards.
  [[nodiscard]] Result<void> Add(const route::RouteKey& key, const route::Segment& segment);
  // No segment will follow; `cut_off`: though more were meant to.
  [[nodiscard]] Result<void> Complete(const route::RouteKey& key, bool cut_off = false);

  // What a server lacks that the store has is offered again, though it was confirmed once.
  void Handle(const exchange::Message& message, Time now);
  // What is to be published.
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);
  // Of what Tick returned, this could not be handed over: a later Tick returns it again.
  void NotSent(const exchange::Message& message, Time now);
  // What should have been sent but could not be read, since the last call.
  [[nodiscard]] std::vector<Error> TakeReadErrors();
  // Writes down what servers have confirmed.
  [[nodiscard]] Result<void> SaveReceipts();

  [[nodiscard]] const route::RouteInfo& info(const route::RouteKey& key) const;
  // Segments without a receipt, over all routes that were not deleted.
  [[nodiscard]] std::size_t unreceipted() const;
  // Why a server takes nothing of a route, or what it holds in its stead, one line for people; of
  // several the first.
  [[nodiscard]] std::optional<std::string> refusal() const;
  // What a server has to say of a route, for people; or nothing.
  [[nodiscard]] const std::string& remark(const route::RouteKey& key) const;
  // Every route is complete and confirmed.
  [[nodiscard]] bool AllReceipted() const;
  // Nothing is left to be sent: all is confirmed, or was deleted by an operator.
  [[nodiscard]] bool Done() const;
  // What a server says that the route is to operators; nothing while none has spoken.
  [[nodiscard]] std::optional<exchange::StandingThere> standing(const route::RouteKey& key) const;
  // All whose last word was sent and receipted.
  [[nodiscard]] std::vector<route::RouteInfo> Receipted() const;

 private:
  struct Sending {
    exchange::RouteSender sender;
    std::optional<route::RouteBuilder> teaching;
    std::set<SegmentIndex> confirmed{};  // not yet written down
    // Deleted by an operator, or discarded: offered no more by later runs.
    bool laid_aside = false;
  };

  // Whose receipts count: those noted in the store; or none of them, for a server that has it not.
  enum class Receipts : std::uint8_t { kNoted, kNone };
  Result<std::string> TakeUp(route::RouteInfo info, Receipts receipts);
  // A server asks who has a route of which all was receipted once.
  void OfferAgain(const exchange::SegmentRequest& request);
  [[nodiscard]] Result<void> EndCutOff(route::RouteInfo& info,
                                       const std::vector<store::HeldSegment>& held);
  void Emplace(const route::RouteInfo& info, exchange::SegmentDigests held,
               const std::vector<SegmentIndex>& receipted,
               std::optional<route::RouteBuilder> teaching);

  AgentId self_;
  store::RouteStore& store_;
  std::map<route::RouteKey, Sending> sending_;
  NewestMap<AgentId, std::monostate> servers_{64};  // heard of
  std::optional<route::RouteKey> spared_;
};

}  // namespace trailcast::agent
