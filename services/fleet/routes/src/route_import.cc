#include "services/fleet/routes/route_import.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "services/exchange/publish.h"
#include "services/exchange/revision_numbers.h"
#include "services/exchange/route_sender.h"
#include "services/fleet/routes/catalog_client.h"

namespace trailcast::fleet {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kImportWait{20};
constexpr std::chrono::milliseconds kInquireEvery{1000};
constexpr std::size_t kBatchBytes = 1U << 20U;  // in one commit

std::string NameOf(const route::RouteInfo& info) {
  return fmt::format("route '{}' ({}) revision {}", info.name, info.key.route.value(),
                     info.revision.value());
}

bool IsComplete(const route::RouteInfo& info) { return info.state == route::RouteState::kComplete; }

// Names and tags can differ; what was taught cannot.
bool IsSameTeaching(const route::RouteInfo& a, const route::RouteInfo& b) {
  return a.segment_count == b.segment_count && a.manifest_digest == b.manifest_digest;
}

tl::unexpected<Error> Conflict(const route::RouteInfo& info, const std::string& holder) {
  return Fail(ErrorCode::kConflict,
              "{} has other segments under the identity of {}: they cannot both be there, "
              "and nothing was changed",
              holder, NameOf(info));
}

std::string ServerName(const AgentId& server) { return fmt::format("server '{}'", server.value()); }

tl::unexpected<Error> Refused(const route::RouteInfo& info, const exchange::Receipt& refusal) {
  const bool deleted = refusal.refusal == exchange::Refusal::kDeleted;
  return Fail(deleted ? ErrorCode::kConflict : ErrorCode::kUnavailable,
              "{} takes nothing of {}: {}", ServerName(refusal.server), NameOf(info),
              refusal.reason);
}

Result<void> AppendAll(const archive::RouteFile& file, store::RouteStore& store) {
  std::vector<route::SegmentPiece> batch;
  std::size_t bytes = 0;
  for (std::uint32_t i = 0; i < file.info().segment_count; ++i) {
    auto piece = file.ReadSegment(SegmentIndex(i));
    if (!piece) return tl::unexpected(piece.error());
    bytes += piece->bytes.size();
    batch.push_back(std::move(*piece));
    if (bytes < kBatchBytes && i + 1 < file.info().segment_count) continue;
    if (auto appended = store.AppendSegments(batch); !appended) return appended;
    batch.clear();
    bytes = 0;
  }
  return {};
}

// This delivers a route from a file to a server, as a scout does. A server that has a complete
// route announces it when it is asked, and its acknowledgements say that it has these bytes.
class Delivery {
 public:
  Delivery(const archive::RouteFile& file, OperatorPeer& peer, AgentId server)
      : info_(file.info()),
        peer_(peer),
        servers_{std::move(server)},
        sender_(peer.self, info_, [&file](SegmentIndex index) { return file.ReadSegment(index); },
                exchange::SegmentDigests(file.digests()), {}) {}

  // This is one turn of the loop.
  Result<void> Step() {
    for (const exchange::Message& message : peer_.exchange->Take(kImportWait)) {
      Handle(message);
    }
    if (conflicting_) return Conflict(info_, fmt::format("'{}'", conflicting_->value()));
    if (sender_.refused()) return Refused(info_, *sender_.refused());
    if (sender_.contradicted_by()) return Conflict(info_, ServerName(*sender_.contradicted_by()));
    const auto now = Clock::now();
    std::vector<exchange::Message> messages = sender_.Tick(now);
    if (now >= inquire_at_) {
      inquire_at_ = now + kInquireEvery;
      messages.emplace_back(exchange::SegmentRequest{peer_.self, info_.key, {}});
    }
    std::ignore = exchange::PublishAll(*peer_.exchange, messages,
                                       [&](const exchange::Message& message, bool sent) {
                                         if (!sent) sender_.NotSent(message, now);
                                       });
    for (const Error& error : sender_.TakeReadErrors()) return tl::unexpected(error);
    return {};
  }

  // Returns the server that has all of it, once there is one.
  [[nodiscard]] const std::optional<AgentId>& holder() const {
    static const std::optional<AgentId> kNobody;
    return asked_for_ && !sender_.AllReceipted() ? kNobody : holder_;
  }
  [[nodiscard]] bool asked_for() const { return asked_for_; }
  [[nodiscard]] std::size_t receipted() const {
    return info_.segment_count - sender_.Unreceipted().size();
  }

 private:
  void Handle(const exchange::Message& message) {
    sender_.Handle(message, Clock::now());
    if (const auto* receipt = std::get_if<exchange::Receipt>(&message)) {
      if (receipt->key == info_.key) servers_.insert(receipt->server);
    } else if (const auto* request = std::get_if<exchange::SegmentRequest>(&message)) {
      asked_for_ |= request->key == info_.key && !request->lacking.empty();
    } else if (const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message)) {
      Handle(*announced);
    }
  }
  void Handle(const exchange::RouteAnnouncement& announced) {
    if (announced.info.key != info_.key || !IsComplete(announced.info)) return;
    // A server that announces a tombstone says the same in an acknowledgement, which comes before
    // or after.
    if (announced.info.standing == route::Standing::kDeleted) return;
    if (!IsSameTeaching(announced.info, info_)) conflicting_ = announced.holder;
    // The scout may announce the route, too, but acknowledges nothing.
    if (servers_.contains(announced.holder)) holder_ = announced.holder;
  }

  const route::RouteInfo& info_;
  OperatorPeer& peer_;
  std::set<AgentId> servers_;
  exchange::RouteSender sender_;
  Clock::time_point inquire_at_{};
  std::optional<AgentId> holder_;
  std::optional<AgentId> conflicting_;
  bool asked_for_ = false;  // a server lacked some of it
};

tl::unexpected<Error> FellSilent(const route::RouteInfo& info, const Delivery& delivery,
                                 const AgentId& server, std::chrono::milliseconds timeout) {
  const double seconds = std::chrono::duration<double>(timeout).count();
  if (delivery.receipted() == info.segment_count) {
    return Fail(ErrorCode::kConflict,
                "{} has all {} segments of {}, but not confirmed that they are these for {:.1f} s: "
                "it probably has other ones under the same identity; its log tells",
                ServerName(server), info.segment_count, NameOf(info), seconds);
  }
  return Fail(ErrorCode::kUnavailable,
              "{} has confirmed {} of {} segments of {}, and nothing new for {:.1f} s: is it still "
              "running, and room on its disk? Its log tells; --timeout waits longer",
              ServerName(server), delivery.receipted(), info.segment_count, NameOf(info), seconds);
}

}  // namespace

exchange::TopicUse ImporterTopics() {
  using exchange::Topic;
  return {
      .write = {Topic::kRoutes, Topic::kSegments, Topic::kSegmentRequests, Topic::kCatalogRequests},
      .read = {Topic::kRoutes, Topic::kSegmentRequests, Topic::kReceipts, Topic::kCatalogReplies}};
}

Result<Imported> ImportIntoStore(const archive::RouteFile& file, store::RouteStore& store,
                                 const std::string& name) {
  const route::RouteInfo& info = file.info();
  const auto known = store.FindRoute(info.key);
  if (!known) return tl::unexpected(known.error());
  const auto held = store.HeldSegments(info.key);
  if (!held) return tl::unexpected(held.error());
  const bool complete = *known && IsComplete(**known);
  if (complete && !IsSameTeaching(**known, info)) return Conflict(info, name);
  // Segments that it holds are appended, too, because the store repairs damaged ones.
  if (auto appended = AppendAll(file, store); !appended) return tl::unexpected(appended.error());
  if (complete) return Imported{held->size() >= info.segment_count, name};
  // The route is put last, so that no route is there without its segments.
  std::vector<route::RouteInfo> numbered{info};
  if (auto given = exchange::GiveNumbers(store, numbered); !given)
    return tl::unexpected(given.error());
  if (auto put = store.PutRoutes(numbered); !put) return tl::unexpected(put.error());
  return Imported{false, name};
}

Result<Imported> ImportToServer(const archive::RouteFile& file, OperatorPeer& peer,
                                const TransferWatch& watch) {
  const route::RouteInfo& info = file.info();
  const auto reply = AskCatalog(*peer.exchange, peer.self, {.name = info.name}, watch.timeout);
  if (!reply) return tl::unexpected(reply.error());
  const auto known = std::find_if(reply->page.routes.begin(), reply->page.routes.end(),
                                  [&](const auto& other) { return other.key == info.key; });
  if (known != reply->page.routes.end() && IsComplete(*known)) {
    if (!IsSameTeaching(*known, info)) return Conflict(info, ServerName(reply->server));
    return Imported{true, ServerName(reply->server)};
  }
  Delivery delivery(file, peer, reply->server);
  std::size_t receipted = 0;
  auto deadline = Clock::now() + watch.timeout;
  while (!delivery.holder()) {
    if (auto stepped = delivery.Step(); !stepped) return tl::unexpected(stepped.error());
    if (delivery.receipted() > receipted) {
      receipted = delivery.receipted();
      deadline = Clock::now() + watch.timeout;
    }
    if (watch.stop()) {
      return Fail(ErrorCode::kUnavailable, "interrupted: {} of {} segments are delivered",
                  receipted, info.segment_count);
    }
    if (Clock::now() > deadline) return FellSilent(info, delivery, reply->server, watch.timeout);
    watch.progress(info.bytes * receipted / info.segment_count);
  }
  return Imported{!delivery.asked_for(), ServerName(*delivery.holder())};
}

}  // namespace trailcast::fleet
