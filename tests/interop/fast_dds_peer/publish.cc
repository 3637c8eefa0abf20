#include <random>

#include "commands.h"
#include "digest.h"
#include "trailcastPubSubTypes.h"

namespace peer {
namespace {

namespace wire = trailcast::wire;

std::string NewRouteId() {
  std::random_device random;
  Digest bytes{};
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return Hex(bytes).substr(0, 32);
}

std::int64_t NowUnixMs() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

// Returns the route as a scout announces it that has just taught it, with labels that nobody has
// changed.
wire::CatalogRoute Relabelled(wire::CatalogRoute route, const std::string& name) {
  route.key().route(NewRouteId());
  route.key().teaching(1);
  route.info().revision(1);
  route.info().name(name);
  route.info().scout(kName);
  route.info().taught_unix_ms(NowUnixMs());
  route.info().standing(0);
  route.info().to_review(0);
  route.info().edition(0);
  route.info().refreshes(0);
  return route;
}

// This is a scout towards servers: it announces, streams and answers until all is acknowledged.
class Scout {
 public:
  Scout(Bus& bus, wire::CatalogRoute route, std::vector<wire::SegmentPiece> pieces)
      : announcements_(bus, "trailcast/routes", kAnnounced),
        segments_(bus, "trailcast/segments", kStreamed),
        statuses_(bus, "trailcast/agents", kAgents),
        requests_(bus, "trailcast/segment_requests", kAsked),
        receipts_(bus, "trailcast/receipts", kAnnounced),
        route_(std::move(route)),
        pieces_(std::move(pieces)) {
    for (wire::SegmentPiece& piece : pieces_) piece.key(route_.key());
  }

  void Announce() {
    wire::RouteAnnouncement announcement;
    announcement.holder(kName);
    announcement.key(route_.key());
    announcement.info(route_.info());
    announcements_.Put(announcement);
    ShowStatus();
  }
  // True when it may go: a receipt can come before a server's reader of statuses is found, and who
  // leaves then was never seen.
  bool IsDone() { return Receipted() && statuses_.IsHeard(); }

 private:
  // True when all of it is on a server's disk, the final announcement included.
  bool Receipted() {
    constexpr std::uint8_t kComplete = 1;
    for (const wire::SegmentRequest& request : requests_.Take()) Answer(request);
    for (const wire::Receipt& receipt : receipts_.Take()) {
      if (!(receipt.key() == route_.key())) continue;
      if (receipt.refusal() != 0) throw std::runtime_error("refused: " + receipt.reason());
      if (receipt.durable_state() == kComplete && receipt.durable_prefix() == pieces_.size()) {
        receipted_ = true;
      }
    }
    return receipted_;
  }
  void Answer(const wire::SegmentRequest& request) {
    if (!(request.key() == route_.key())) return;
    for (const std::uint32_t index : request.lacking()) {
      if (index >= pieces_.size()) continue;
      wire::SegmentBatch batch;  // one piece each: never more than a datagram
      batch.sender(kName);
      batch.pieces({pieces_[index]});
      segments_.Put(batch);
    }
  }
  void ShowStatus() {
    wire::AgentStatus status;
    status.agent(kName);
    status.instance(instance_);
    status.role(1);
    status.mode(2);
    status.route(route_.info().name());
    status.segments(route_.info().segment_count());
    statuses_.Put(status);
  }

  Outlet<wire::RouteAnnouncementPubSubType> announcements_;
  Outlet<wire::SegmentBatchPubSubType> segments_;
  Outlet<wire::AgentStatusPubSubType> statuses_;
  Inlet<wire::SegmentRequestPubSubType> requests_;
  Inlet<wire::ReceiptPubSubType> receipts_;
  wire::CatalogRoute route_;
  std::vector<wire::SegmentPiece> pieces_;
  bool receipted_ = false;
  std::uint64_t instance_ = std::random_device()();
};

}  // namespace

wire::CatalogRoute Publish(Bus& bus, const Fetched& fetched, const std::string& name) {
  const wire::CatalogRoute route = Relabelled(fetched.route, name);
  Scout scout(bus, route, fetched.pieces);
  Until(
      bus, "a receipt for '" + name + "'", [&] { scout.Announce(); },
      [&] { return scout.IsDone(); });
  return route;
}

}  // namespace peer
