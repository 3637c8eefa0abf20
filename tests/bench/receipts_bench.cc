// How soon a scout has its receipts from a server with a large store, which looks for junctions
// meanwhile, or does not.
//
//   bench_receipts FILE STORE [JUNCTIONS]
//
// STORE's routes are taught, twenty segments a second, to a server whose store is FILE. With
// JUNCTIONS, the file of its network, it looks for junctions of FILE's routes, those that were not
// looked for.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "route_server/server.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_sender.h"
#include "services/program/command_line.h"
#include "services/program/presence.h"
#include "services/route/digest.h"
#include "tests/bench/must.h"
#include "tests/bench/taught_routes.h"

namespace trailcast::bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kASegment{50};

// Under keys that no store has.
std::vector<Taught> TaughtAnew(const std::string& file) {
  const auto now = static_cast<std::uint64_t>(steady_clock::now().time_since_epoch().count());
  std::vector<Taught> taught = TaughtIn(file);
  for (std::size_t i = 0; i < taught.size(); ++i) {
    Taught& route = taught[i];
    for (route::SegmentPiece& piece : route.pieces) {
      piece.key = {RouteId(fmt::format("{:016x}{:016x}", now, i + 1)), TeachingId(now)};
    }
    route.info.key = route.pieces.front().key;
    route.info.revision = RevisionNumber(1);
    route.info.standing = route::Standing::kStaged;
  }
  return taught;
}

class Bench {
 public:
  Bench(const std::string& file, const std::string& junctions)
      : server_(
            Must(server::Server::Open(AgentId("server"), Must(store::OpenSqliteStore(file)),
                                      bus_.Open(program::WithAgents(exchange::ServerTopics()))))),
        scout_(bus_.Open(program::WithAgents(exchange::ScoutTopics()))) {
    if (!junctions.empty() && !server_->KeepNetwork(Must(store::NetworkStore::Open(junctions)))) {
      std::abort();
    }
    serving_ = std::thread([this] { (void)server_->Run([this] { return stopping_.load(); }); });
  }
  ~Bench() {
    stopping_ = true;
    serving_.join();
  }

  // Until its index has all of the store.
  void AwaitViews(const route::View& view) {
    const auto desk = bus_.Open(exchange::OperatorTopics());
    exchange::CatalogRequest request{.client = AgentId("desk"), .query = {.view = view}};
    for (bool filled = false; !filled;) {
      ++request.request;
      if (!desk->Publish(request)) std::abort();
      for (const exchange::Message& message : desk->Take(milliseconds(1000))) {
        const auto* reply = std::get_if<exchange::CatalogReply>(&message);
        if (reply == nullptr || reply->client != request.client) continue;
        if (!reply->error.empty()) std::abort();
        filled |= reply->coverage.routes_unseen == 0 &&
                  reply->coverage.segments_indexed == reply->coverage.segments_stored;
      }
    }
  }

  void Teach(const Taught& route) {
    route::RouteInfo info = route.info;
    info.state = route::RouteState::kTeaching;
    info.segment_count = 0;
    const auto read = [&](SegmentIndex index) -> Result<route::SegmentPiece> {
      return route.pieces.at(index.value());
    };
    exchange::RouteSender sender(info.scout, info, read, {}, {});
    for (const route::SegmentPiece& piece : route.pieces) {
      const auto offered = steady_clock::now();
      ++info.segment_count;
      sender.Add(piece, info);
      Trade(sender, [&] { return sender.Unreceipted().empty(); });
      took_ms_.push_back(
          std::chrono::duration<double, std::milli>(steady_clock::now() - offered).count());
      Trade(sender, [&] { return steady_clock::now() - offered > kASegment; });
    }
    sender.Update(route.info);
    Trade(sender, [&] { return sender.AllReceipted(); });
  }

  void Print() {
    std::sort(took_ms_.begin(), took_ms_.end());
    const auto at = [&](double share) {
      return took_ms_[static_cast<std::size_t>(share * static_cast<double>(took_ms_.size() - 1))];
    };
    fmt::print("{} receipts: half within {:.1f} ms, p90 {:.1f}, p99 {:.1f}, the last {:.1f}\n",
               took_ms_.size(), at(0.5), at(0.9), at(0.99), at(1.0));
  }

 private:
  void Trade(exchange::RouteSender& sender, const std::function<bool()>& done) {
    while (!done()) {
      (void)exchange::PublishAll(*scout_, sender.Tick(steady_clock::now()));
      for (const exchange::Message& message : scout_->Take(milliseconds(1))) {
        sender.Handle(message, steady_clock::now());
      }
    }
  }

  exchange::InProcessBus bus_;
  std::unique_ptr<server::Server> server_;
  std::unique_ptr<exchange::RouteExchange> scout_;
  std::atomic<bool> stopping_{false};
  std::thread serving_;
  std::vector<double> took_ms_;
};

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2 || words.size() > 3) {
    std::cerr << "usage: bench_receipts FILE STORE [JUNCTIONS]\n";
    return program::kExitUsage;
  }
  const auto taught = TaughtAnew(words[1]);
  Bench bench(words[0], words.size() > 2 ? words[2] : "");
  bench.AwaitViews(Must(route::Open(taught.front().pieces.front())).key_views.front().features);
  for (const Taught& route : taught) bench.Teach(route);
  bench.Print();
  return program::kExitOk;
}

}  // namespace
}  // namespace trailcast::bench

int main(int argc, char** argv) {
  return trailcast::program::RunMain("bench_receipts", [&] {
    return trailcast::bench::Run({argv + 1, argv + argc});
  });
}
