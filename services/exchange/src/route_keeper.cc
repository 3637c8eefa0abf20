#include "services/exchange/route_keeper.h"

#include <algorithm>
#include <utility>

#include "services/exchange/batches.h"
#include "services/route/labels.h"
#include "services/store/lacking.h"

namespace trailcast::exchange {
using route::RouteInfo;
using route::SegmentPiece;

RouteKeeper::RouteKeeper(AgentId self, store::RouteStore& store, Catalog catalog,
                         Integrity integrity, RouteKeeperOptions options)
    : self_(std::move(self)),
      store_(store),
      catalog_(std::move(catalog)),
      integrity_(std::move(integrity)),
      options_(options),
      answers_(options.answers),
      backup_responder_(self_) {}

Result<std::unique_ptr<RouteKeeper>> RouteKeeper::Open(AgentId self, store::RouteStore& store,
                                                       Catalog catalog, Integrity integrity,
                                                       RouteKeeperOptions options) {
  std::unique_ptr<RouteKeeper> keeper(
      new RouteKeeper(std::move(self), store, std::move(catalog), std::move(integrity), options));
  if (options.announced_at_start == 0) return keeper;
  const auto newest = store.QueryRoutes({.page_size = options.announced_at_start});
  if (!newest) return Wrap(newest.error(), "listing the stored routes");
  for (const RouteInfo& info : newest->routes) {
    const auto held = store.SegmentDigests(info.key);
    if (!held) return Wrap(held.error(), "listing the segments of " + Describe(info.key));
    auto [at, added] = keeper->routes_.try_emplace(info.key, info, *held, options.want);
    at->second.announce_due = at->second.resend_due = at->second.receipt_due = true;
  }
  return keeper;
}

void RouteKeeper::Handle(Message message, Time now) {
  backup_responder_.Handle(message, now);
  servers_.Handle(message);
  if (const auto* announcement = std::get_if<RouteAnnouncement>(&message)) {
    HandleAnnouncement(*announcement, now);
  } else if (auto* batch = std::get_if<SegmentBatch>(&message)) {
    HandleBatch(*batch, now);
  } else if (const auto* segment_request = std::get_if<SegmentRequest>(&message)) {
    HandleRequest(*segment_request, now);
  } else if (const auto* catalog_request = std::get_if<CatalogRequest>(&message)) {
    HandleCatalogRequest(*catalog_request);
  } else if (const auto* edit = std::get_if<RouteEditRequest>(&message)) {
    HandleEdit(*edit, now);
  } else if (const auto* status = std::get_if<AgentStatus>(&message)) {
    missing_.Hear(*status);
  }
}

bool RouteKeeper::IsSettled(const route::RouteKey& key) {
  const auto info = store_.FindRoute(key);
  if (!info) return true;  // the store's trouble is reported elsewhere
  if (!*info) return false;
  if ((*info)->standing == route::Standing::kDeleted) return true;
  if ((*info)->state != route::RouteState::kComplete) return false;
  const auto kept = routes_.find(key);
  if (kept != routes_.end() && !kept->second.Damaged().empty()) return false;
  const auto lacking = store::FindLacking(store_, **info);
  return !lacking || lacking->empty();
}

void RouteKeeper::HandleAnnouncement(const RouteAnnouncement& announcement, Time now) {
  const RouteInfo& info = announcement.info;
  KeptRoute* kept = Find(info.key, now);
  if (kept == nullptr) return;
  if (servers_.Contains(announcement.holder)) {
    kept->numbered_elsewhere = info.revision.value() != 0;
    kept->completed_elsewhere = info.state == route::RouteState::kComplete;
  }
  const auto grace = kept->heard() ? options_.grown_grace : options_.fresh_grace;
  switch (kept->Claim(info, now + grace)) {
    case KeptRoute::ClaimResult::kNews:
      kept->announce_due = true;
      break;
    case KeptRoute::ClaimResult::kConflict:
      ++counters_.conflicting;
      AddNote(Note::Severity::kWarning, "claim/" + Describe(info.key),
              fmt::format("{} announces another {} than the one held here: ignored",
                          announcement.holder.value(), Describe(info.key)),
              now);
      return;
    case KeptRoute::ClaimResult::kDeleted:
      kept->receipt_due = true;
      // Another server reads no receipts.
      if (info.standing != route::Standing::kDeleted) kept->announce_due = kept->resend_due = true;
      return;
    case KeptRoute::ClaimResult::kOldNews:
      break;
  }
  kept->want.Hurry(now);
  // The scout is back and perhaps missed the last receipt.
  if (announcement.holder == info.scout) kept->receipt_due = true;
}

void RouteKeeper::HandleBatch(SegmentBatch& batch, Time now) {
  for (SegmentPiece& piece : batch.pieces) {
    if (IsLent(batch, piece.key, now) && !IsKnown(piece, now)) {
      ++counters_.unproven;
      AddNote(Note::Severity::kWarning, "unproven/" + batch.sender.value(),
              fmt::format("{} lends segment {} of {}, and what that must be is not known here: not "
                          "taken",
                          batch.sender.value(), piece.index.value(), Describe(piece.key)),
              now);
    } else if (piece.bytes.empty()) {
      TakeFromOthers(piece, now);
    } else if (const auto intact = integrity_.check_piece(piece); intact) {
      arrived_.push_back(std::move(piece));
    } else {
      ++counters_.corrupt;
      AddNote(Note::Severity::kWarning, "corrupt/" + batch.sender.value(),
              fmt::format("from {}: {}", batch.sender.value(), intact.error().message), now);
      if (KeptRoute* kept = Find(piece.key, now)) kept->want.AskAgain(piece.index, now);
    }
  }
}

bool RouteKeeper::IsLent(const SegmentBatch& batch, const route::RouteKey& key, Time now) {
  if (batch.trust == SegmentBatch::Trust::kAll) return false;
  const KeptRoute* kept = Find(key, now, Which::kStored);
  return batch.IsLent(kept == nullptr ? std::nullopt : kept->scout());
}

// The segment was here once, so its digest is known.
bool RouteKeeper::IsKnown(const SegmentPiece& piece, Time now) {
  const KeptRoute* kept = Find(piece.key, now, Which::kStored);
  return kept != nullptr && kept->DigestOf(piece.index) == piece.digest;
}

// Looks for the bytes of a piece without bytes in other revisions.
void RouteKeeper::TakeFromOthers(const SegmentPiece& named, Time now) {
  KeptRoute* kept = Find(named.key, now);
  if (kept == nullptr) return;
  if (kept->Holds(named.index)) {
    kept->receipt_due = true;
    return;
  }
  auto content = store_.FindContent(named.digest);
  if (content && *content) {
    arrived_.push_back({named.key, named.index, named.digest, std::move(**content)});
  } else {
    kept->want.AskAgain(named.index, now);
  }
}

void RouteKeeper::HandleRequest(const SegmentRequest& request, Time now) {
  // Requests for routes that no server has must not fill the memory.
  KeptRoute* kept = Find(request.key, now, Which::kStored);
  if (kept == nullptr) return;
  const auto holds = [&](SegmentIndex index) { return kept->Holds(index); };
  if (request.lacking.empty()) kept->announce_due = kept->resend_due = true;
  if (!std::all_of(request.lacking.begin(), request.lacking.end(), holds)) {
    Refresh(request.key, *kept, now);
  }
  std::vector<SegmentIndex> held;
  std::copy_if(request.lacking.begin(), request.lacking.end(), std::back_inserter(held), holds);
  if (request.digests_only) {
    TellDigests(request.key, *kept, held);
  } else {
    answers_.Ask(request.key, backup_responder_.Mine(request.requester, request.key, held, now),
                 now);
  }
}

void RouteKeeper::TellDigests(const route::RouteKey& key, const KeptRoute& kept,
                              const std::vector<SegmentIndex>& indices) {
  SegmentBatch batch{.sender = self_, .pieces = {}};
  for (const SegmentIndex index : indices) {
    batch.pieces.push_back({key, index, kept.DigestOf(index).value_or(route::Digest{}), {}});
  }
  if (batch.pieces.empty()) return;
  constexpr std::size_t kMostReplies = 256;  // 12 MB; a client that hears nothing asks again
  for (SegmentBatch& part : SplitBatch(std::move(batch))) {
    if (replies_.size() < kMostReplies) replies_.emplace_back(std::move(part));
  }
}

void RouteKeeper::HandleCatalogRequest(const CatalogRequest& request) {
  CatalogReply reply = catalog_.answer(request);
  reply.server = self_;
  reply.client = request.client;
  reply.request = request.request;
  replies_.emplace_back(std::move(reply));
}

std::vector<Message> RouteKeeper::Tick(Time now) {
  Commit(now);
  std::vector<Message> out = std::exchange(replies_, {});
  Announce(now, out);
  for (auto& [key, kept] : routes_) {
    kept.LapseOver(now);
    const bool due =
        kept.receipt_due && (!kept.receipt_at || now >= *kept.receipt_at + options_.receipt_again);
    if (due && kept.can_receipt()) {
      Receipt receipt = kept.MakeReceipt(self_, key);
      if (kept.complete()) receipt.followed = Followed(*kept.stored());
      out.emplace_back(std::move(receipt));
      ++counters_.receipts;
      kept.receipt_at = now;
      kept.receipt_due = false;
    }
    if (std::vector<SegmentIndex> lacking = Lacking(key, kept, now); !lacking.empty()) {
      out.emplace_back(
          SegmentRequest{.requester = self_, .key = key, .lacking = std::move(lacking)});
    }
  }
  for (const route::RouteKey& key :
       missing_.Due(now, [&](const route::RouteKey& held) { return IsSettled(held); })) {
    out.emplace_back(SegmentRequest{.requester = self_, .key = key});
  }
  SendAnswers(now, out);
  return out;
}

// Nothing is known while the store is unavailable.
RevisionNumber RouteKeeper::Followed(const RouteInfo& info) {
  const auto is_active = [](const RouteInfo& each) {
    return each.standing == route::Standing::kActive;
  };
  if (is_active(info)) return info.revision;
  const auto revisions = store_.FindRevisions(info.key.route);
  if (!revisions) return {};
  const auto active = std::find_if(revisions->begin(), revisions->end(), is_active);
  return active == revisions->end() ? RevisionNumber() : active->revision;
}

std::vector<SegmentPiece> RouteKeeper::TakeAppended() { return std::exchange(appended_, {}); }

std::vector<std::pair<route::RouteKey, SegmentIndex>> RouteKeeper::TakeDamaged() {
  return std::exchange(damaged_, {});
}

std::size_t RouteKeeper::backlog() const {
  std::size_t wanted = 0;
  for (const auto& [key, kept] : routes_) wanted += kept.want.size();
  return wanted;
}

std::vector<Note> RouteKeeper::TakeNotes() { return std::exchange(notes_, {}); }

}  // namespace trailcast::exchange
