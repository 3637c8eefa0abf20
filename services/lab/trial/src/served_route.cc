#include "services/lab/trial/src/served_route.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "services/base/work_folder.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_keeper.h"
#include "services/exchange/route_sender.h"
#include "services/route/digest.h"
#include "services/store/sqlite_store.h"

namespace trailcast::trial {
namespace {

using Time = std::chrono::steady_clock::time_point;

constexpr std::chrono::milliseconds kTurn{10};
constexpr std::chrono::seconds kFetchPatience{60};

// Runs one turn of a program's loop. Messages that the bus refuses are lost and requested again.
template <typename Protocol>
void Turn(Protocol& protocol, exchange::RouteExchange& bus, Time now) {
  for (const exchange::Message& message : bus.Take(std::chrono::milliseconds(0))) {
    protocol.Handle(message, now);
  }
  std::ignore = exchange::PublishAll(bus, protocol.Tick(now));
}

// Returns the scout's sender with the whole route.
exchange::RouteSender MakeSender(const TaughtRoute& taught) {
  const auto read = [&taught](SegmentIndex index) -> Result<route::SegmentPiece> {
    return taught.pieces.at(index.value());
  };
  route::RouteInfo info = taught.info;
  std::vector<route::Digest> digests;
  for (const route::SegmentPiece& piece : taught.pieces) digests.push_back(piece.digest);
  info.manifest_digest = route::ManifestDigest(digests);
  return exchange::RouteSender(AgentId("scout"), info, read, exchange::SegmentDigests(digests), {});
}

}  // namespace

Result<TaughtRoute> FetchFromServer(const TaughtRoute& taught) {
  const exchange::Integrity integrity{route::CheckDigest, route::ManifestDigest};
  const auto folder = WorkFolder::Make();
  if (!folder) return tl::unexpected(folder.error());
  const auto store = store::OpenSqliteStore(*folder / "routes.db");
  if (!store) return tl::unexpected(store.error());
  auto keeper = exchange::RouteKeeper::Open(AgentId("server"), **store, {}, integrity);
  if (!keeper) return tl::unexpected(keeper.error());

  exchange::InProcessBus bus;
  const auto scout = bus.Open(exchange::ScoutTopics());
  const auto server = bus.Open(exchange::ServerTopics());
  const auto follower = bus.Open(exchange::FollowerTopics());
  exchange::RouteSender sender = MakeSender(taught);
  if (auto listening = follower->Listen(exchange::Topic::kSegments, {taught.info.key});
      !listening) {
    return tl::unexpected(listening.error());
  }
  exchange::RouteFetcher fetcher(AgentId("follower"), taught.info.key, {}, integrity, Time{});

  TaughtRoute fetched;
  for (Time now{}; now < Time{} + kFetchPatience && !fetcher.Complete(); now += kTurn) {
    // The scout leaves once the server has everything, and followers get the route from the server.
    if (!sender.AllReceipted()) Turn(sender, *scout, now);
    Turn(**keeper, *server, now);
    Turn(fetcher, *follower, now);
    for (route::SegmentPiece& piece : fetcher.TakeArrived()) {
      fetched.pieces.push_back(std::move(piece));
    }
  }
  if (!fetcher.Complete()) {
    return Fail(ErrorCode::kUnavailable, "the route did not come through the server: {} of {}",
                fetched.pieces.size(), taught.pieces.size());
  }
  std::sort(fetched.pieces.begin(), fetched.pieces.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  fetched.info = *fetcher.info();
  return fetched;
}

}  // namespace trailcast::trial
