#include "services/fleet/routes/route_export.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "services/exchange/publish.h"
#include "services/exchange/route_fetcher.h"
#include "services/exchange/route_finder.h"
#include "services/route/digest.h"
#include "services/route/no_route.h"
#include "services/route/route_ref.h"

namespace trailcast::fleet {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kExportWait{20};

using Take = std::function<Result<void>(const route::SegmentPiece&)>;

// Fetched pieces come in any order and are passed on in order. Pieces that came early wait here.
// The fetcher asks for the lowest first, so they are few.
class InOrder {
 public:
  explicit InOrder(const Take& take) : take_(take) {}

  Result<void> Add(route::SegmentPiece piece) {
    bytes_ += piece.bytes.size();
    early_.emplace(piece.index, std::move(piece));
    while (!early_.empty() && early_.begin()->first.value() == next_) {
      if (auto taken = take_(early_.begin()->second); !taken) return taken;
      early_.erase(early_.begin());
      ++next_;
    }
    return {};
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  const Take& take_;
  std::map<SegmentIndex, route::SegmentPiece> early_;
  std::uint32_t next_ = 0;
  std::uint64_t bytes_ = 0;
};

tl::unexpected<Error> NotThere(const exchange::CatalogReply& reply, const std::string& name,
                               std::optional<std::uint32_t> revision, const std::string& holder) {
  std::set<std::uint32_t> revisions;
  for (const route::RouteInfo& info : reply.page.routes) {
    revisions.insert(info.revision.value());
  }
  if (revision && !revisions.empty()) {
    return Fail(ErrorCode::kNotFound, "{} has no revision {} of route '{}'; it has {}", holder,
                *revision, name, fmt::join(revisions, ", "));
  }
  return Fail(ErrorCode::kNotFound, "{}", route::NoRouteText(holder, name, reply.similar_names));
}

}  // namespace

Result<route::RouteInfo> ChooseForExport(const exchange::CatalogReply& reply,
                                         const std::string& name_or_id,
                                         const exchange::RevisionChoice& which,
                                         const std::string& holder) {
  std::vector<route::RouteInfo> fitting = route::OnlyMeant(reply.page.routes, name_or_id);
  std::erase_if(fitting, [&](const route::RouteInfo& info) {
    return which.number != 0 && info.revision.value() != which.number;
  });
  if (fitting.empty()) {
    return NotThere(reply, name_or_id,
                    which.number == 0 ? std::nullopt : std::optional(which.number), holder);
  }
  auto found = exchange::ChooseMeant(name_or_id, fitting, which);
  if (!found) return tl::unexpected(found.error());
  auto& chosen = *found;
  if (!chosen) {
    return Fail(ErrorCode::kInvalidArgument, "{}: say which with --revision",
                exchange::NotMeantText(holder, name_or_id, fitting, which));
  }
  if (chosen->state == route::RouteState::kComplete) return std::move(*chosen);
  return Fail(
      ErrorCode::kInvalidArgument,
      "route '{}' revision {} is still being taught ({} segments so far), and only complete "
      "routes are exported: wait until its scout has delivered all of it",
      chosen->name, chosen->revision.value(), chosen->segment_count);
}

exchange::TopicUse ExporterTopics() {
  using exchange::Topic;
  return {.write = {Topic::kSegmentRequests, Topic::kCatalogRequests},
          .read = {Topic::kCatalogReplies},
          .listen = {Topic::kSegments}};
}

Result<std::uint64_t> ExportFromStore(store::RouteStore& store, const route::RouteInfo& info,
                                      archive::RouteFileWriter writer) {
  for (std::uint32_t i = 0; i < info.segment_count; ++i) {
    const auto piece = store.ReadSegment(info.key, SegmentIndex(i));
    if (!piece) return tl::unexpected(piece.error());
    if (auto added = writer.Add(*piece); !added) return tl::unexpected(added.error());
  }
  return writer.Finish();
}

Result<void> FetchInOrder(OperatorPeer& peer, const route::RouteInfo& info,
                          const TransferWatch& watch, const Take& take) {
  const exchange::Integrity integrity{route::CheckDigest, route::ManifestDigest};
  exchange::RouteFetcher fetcher(peer.self, info.key, {}, integrity, Clock::now());
  fetcher.Learn(info, Clock::now());
  if (auto listening = peer.exchange->Listen(exchange::Topic::kSegments, {info.key}); !listening)
    return listening;
  InOrder pieces(take);
  auto deadline = Clock::now() + watch.timeout;
  while (!fetcher.Complete()) {
    for (const exchange::Message& message : peer.exchange->Take(kExportWait)) {
      fetcher.Handle(message, Clock::now());
    }
    const auto now = Clock::now();
    // A request that cannot be sent is repeated.
    std::ignore = exchange::PublishAll(*peer.exchange, fetcher.Tick(now));
    for (route::SegmentPiece& piece : fetcher.TakeArrived()) {
      if (auto added = pieces.Add(std::move(piece)); !added) return added;
      deadline = now + watch.timeout;
    }
    const exchange::FetchProgress progress = fetcher.Progress(now);
    if (progress.state == exchange::FetchState::kWrong) {
      return Fail(ErrorCode::kCorrupt,
                  "the segments that came are not those of route '{}' revision {}: two holders may "
                  "have different ones",
                  info.name, info.revision.value());
    }
    if (watch.stop()) return Fail(ErrorCode::kUnavailable, "interrupted; nothing was written");
    if (now > deadline) {
      return Fail(ErrorCode::kUnavailable,
                  "{} of {} segments of route '{}' came, then none for {:.1f} s: is the server "
                  "still running? --timeout waits longer",
                  progress.held, info.segment_count, info.name,
                  std::chrono::duration<double>(watch.timeout).count());
    }
    watch.progress(pieces.bytes());
  }
  return {};
}

Result<std::uint64_t> ExportFromServer(OperatorPeer& peer, const route::RouteInfo& info,
                                       archive::RouteFileWriter writer,
                                       const TransferWatch& watch) {
  const auto fetched = FetchInOrder(
      peer, info, watch, [&](const route::SegmentPiece& piece) { return writer.Add(piece); });
  if (!fetched) return tl::unexpected(fetched.error());
  return writer.Finish();
}

}  // namespace trailcast::fleet
