#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

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

  // A new route: on disk when this returns.
  [[nodiscard]] Result<void> Begin(const route::RouteInfo& info);
  // The route's next segment: on disk when this returns, sent afterwards.
  [[nodiscard]] Result<void> Add(const route::RouteKey& key, const route::Segment& segment);
  // No segment will follow.
  [[nodiscard]] Result<void> Complete(const route::RouteKey& key);

  void Handle(const exchange::Message& message, Time now);
  // What is to be published.
  [[nodiscard]] std::vector<exchange::Message> Tick(Time now);
  // What should have been sent but could not be read, since the last call.
  [[nodiscard]] std::vector<Error> TakeReadErrors();
  // Writes down what servers have confirmed.
  [[nodiscard]] Result<void> SaveReceipts();

  [[nodiscard]] const route::RouteInfo& info(const route::RouteKey& key) const;
  // Segments without a receipt, over all routes.
  [[nodiscard]] std::size_t unreceipted() const;
  // Why a server takes nothing of a route, one line for people; of several the first.
  [[nodiscard]] std::optional<std::string> refusal() const;
  // Every route is complete and confirmed, or was deleted by an operator.
  [[nodiscard]] bool AllReceipted() const;

 private:
  struct Sending {
    exchange::RouteSender sender;
    std::optional<route::RouteBuilder> teaching;
    std::set<SegmentIndex> confirmed;  // not yet written down
  };

  Result<std::string> TakeUp(route::RouteInfo info);
  void Emplace(const route::RouteInfo& info, const std::vector<SegmentIndex>& receipted,
               std::optional<route::RouteBuilder> teaching);

  AgentId self_;
  store::RouteStore& store_;
  std::map<route::RouteKey, Sending> sending_;
};

}  // namespace trailcast::agent
