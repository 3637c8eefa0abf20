// This is how RouteKeeper uses its store: what is durable, and what follows from that.
#include <algorithm>
#include <map>
#include <utility>

#include "services/base/text.h"
#include "services/exchange/batches.h"
#include "services/exchange/bounds.h"
#include "services/exchange/route_keeper.h"
#include "services/route/labels.h"

namespace trailcast::exchange {

using route::RouteKey;
using route::SegmentPiece;

KeptRoute* RouteKeeper::Find(const RouteKey& key, Time now, Which which) {
  if (const auto found = routes_.find(key); found != routes_.end()) {
    found->second.spoken_of_at = now;
    return &found->second;
  }
  const auto info = store_.FindRoute(key);
  const auto held = store_.SegmentDigests(key);
  if (!info || !held) {
    Refuse(info ? held.error() : info.error(), key, now);
    return nullptr;
  }
  if (which == Which::kStored && !*info && held->empty()) return nullptr;
  if (!MakeRoom(now)) {
    AddNote(Note::Severity::kError, "most_at_hand",
            fmt::format("{} refused: {} routes are being taught or fetched, the most this server "
                        "attends to at a time",
                        Describe(key), routes_.size()),
            now);
    return nullptr;
  }
  KeptRoute& kept = routes_.try_emplace(key, *info, *held, options_.want).first->second;
  kept.spoken_of_at = kept.refreshed_at = now;
  return &kept;
}

void RouteKeeper::Refresh(const RouteKey& key, KeptRoute& kept, Time now) {
  if (now < kept.refreshed_at + options_.refresh_again) return;
  kept.refreshed_at = now;
  for (const SegmentIndex index : kept.Damaged()) {
    if (const auto mended = store_.ReadSegment(key, index))
      kept.MarkHeld(index, mended->digest, now);
  }
  if (!store_.shared()) return;
  const auto info = store_.FindRoute(key);
  const auto held = store_.SegmentDigests(key);
  if (!info || !held) {
    Refuse(info ? held.error() : info.error(), key, now);
    return;
  }
  if (kept.TakeUp(*info, *held, now, now + options_.fresh_grace)) {
    kept.receipt_due = kept.announce_due = kept.resend_due = true;
  }
}

std::vector<SegmentIndex> RouteKeeper::Lacking(const RouteKey& key, KeptRoute& kept, Time now) {
  std::vector<SegmentIndex> lacking = kept.want.Due(now);
  if (lacking.empty()) return lacking;
  Refresh(key, kept, now);
  std::erase_if(lacking, [&](SegmentIndex index) { return !kept.want.contains(index); });
  return lacking;
}

// Removes the route from memory that was not mentioned for longest.
bool RouteKeeper::MakeRoom(Time now) {
  if (routes_.size() < options_.most_at_hand) return true;
  // Among equals it takes an idle one: missing segments are asked for as long as there is room.
  const auto rank = [](const auto& entry) {
    return std::pair(entry.second.spoken_of_at, !entry.second.idle());
  };
  const auto oldest =
      std::min_element(routes_.begin(), routes_.end(),
                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  if (oldest == routes_.end() || now < oldest->second.spoken_of_at + options_.laid_aside_after) {
    return false;
  }
  routes_.erase(oldest);
  return true;
}

// Counts and reports pieces that are not new: held already, or in conflict with what is held.
bool RouteKeeper::IsNew(const SegmentPiece& piece, Time now) {
  KeptRoute* kept = Find(piece.key, now);
  if (kept == nullptr) return false;
  if (kept->deleted()) {
    kept->receipt_due = true;  // the receipt says so
    return false;
  }
  const bool beyond = kept->complete() && piece.index.value() >= kept->stored()->segment_count;
  const auto digest = kept->DigestOf(piece.index);
  const bool fits = !beyond && (!digest || *digest == piece.digest);
  if (fits && !kept->Holds(piece.index)) return true;
  if (fits) {
    ++counters_.duplicates;
    kept->receipt_due = true;  // the agent that sent it again has missed the receipt
    return false;
  }
  Refuse({ErrorCode::kConflict, fmt::format("segment {} of {} contradicts what is held",
                                            piece.index.value(), Describe(piece.key))},
         piece.key, now);
  return false;
}

void RouteKeeper::Commit(Time now) {
  std::vector<SegmentPiece> fresh;
  std::map<std::pair<RouteKey, SegmentIndex>, route::Digest> seen;
  for (SegmentPiece& piece : std::exchange(arrived_, {})) {
    if (!IsNew(piece, now)) continue;
    const auto [first, is_first] = seen.try_emplace({piece.key, piece.index}, piece.digest);
    if (is_first) {
      fresh.push_back(std::move(piece));
    } else if (first->second == piece.digest) {
      ++counters_.duplicates;
    } else {
      ++counters_.conflicting;
    }
  }
  Append(fresh, now);
}

// This is one commit. If the store refuses the group because of one piece, halves are tried, so
// that the rest is kept all the same.
void RouteKeeper::Append(std::span<SegmentPiece> pieces, Time now) {
  if (pieces.empty()) return;
  if (const auto stored = store_.AppendSegments(pieces); !stored) {
    const ErrorCode code = stored.error().code;
    const bool one_is_bad = code == ErrorCode::kConflict || code == ErrorCode::kCorrupt;
    if (!one_is_bad || pieces.size() == 1) {
      Refuse(stored.error(), pieces.front().key, now);
      if (code == ErrorCode::kUnavailable) {
        segments_untaken_ = stored.error().message;
        TellFull(pieces, stored.error());
      }
      if (one_is_bad) Refresh(pieces.front().key, routes_.at(pieces.front().key), now);
      return;
    }
    const std::size_t half = pieces.size() / 2;
    Append(pieces.first(half), now);
    Append(pieces.subspan(half), now);
    return;
  }
  segments_untaken_.clear();
  counters_.appended += pieces.size();
  for (SegmentPiece& piece : pieces) {
    counters_.appended_bytes += piece.bytes.size();
    MarkAppended(piece, now);
  }
}

void RouteKeeper::MarkAppended(SegmentPiece& piece, Time now) {
  KeptRoute& kept = routes_.at(piece.key);
  if (kept.IsDamaged(piece.index)) {
    ++counters_.repaired;
    AddNote(
        Note::Severity::kInfo,
        fmt::format("repaired/{}/{}", Describe(piece.key), piece.index.value()),
        fmt::format("segment {} of {} is whole again", piece.index.value(), Describe(piece.key)),
        now);
  }
  kept.MarkHeld(piece.index, piece.digest, now);
  kept.MarkRoom();
  kept.announce_due = kept.receipt_due = true;
  kept.receipt_at.reset();  // something new is durable, so the receipt is not held back
  appended_.push_back(std::move(piece));
}

void RouteKeeper::NoteDamage(const RouteKey& key, SegmentIndex index, Time now) {
  KeptRoute* kept = Find(key, now, Which::kStored);
  if (kept == nullptr || !kept->Holds(index)) return;
  ++counters_.damaged;
  damaged_.emplace_back(key, index);
  kept->MarkDamaged(index, now);
  AddNote(
      Note::Severity::kWarning, fmt::format("damaged/{}/{}", Describe(key), index.value()),
      fmt::format("segment {} of {} is damaged on the disk: asking its scout, other servers and "
                  "followers for it",
                  index.value(), Describe(key)),
      now);
}

Result<bool> RouteKeeper::DropOrphan(const RouteKey& key) {
  const auto found = routes_.find(key);
  if (found != routes_.end() && found->second.scout()) return false;
  if (auto dropped = store_.DropSegments(key); !dropped) return tl::unexpected(dropped.error());
  if (found != routes_.end()) routes_.erase(found);
  return true;
}

// The scouts of these pieces learn that nothing is taken, and why.
void RouteKeeper::TellFull(std::span<const SegmentPiece> pieces, const Error& error) {
  for (const SegmentPiece& piece : pieces) {
    KeptRoute& kept = routes_.at(piece.key);
    kept.MarkFull(PlainText(error.message, kMaxLineBytes));
    kept.receipt_due = true;
  }
}

void RouteKeeper::TellOverQuota(const RouteKey& key, const std::string& why, Time now) {
  KeptRoute* kept = Find(key, now);
  if (kept == nullptr) return;
  kept->MarkOver(PlainText(why, kMaxLineBytes), now + options_.over_quota_told);
}

void RouteKeeper::Remark(const RouteKey& key, const std::string& text, Time now) {
  KeptRoute* kept = Find(key, now, Which::kStored);
  if (kept != nullptr) kept->Remark(PlainText(text, kMaxLineBytes));
}

void RouteKeeper::Refuse(const Error& error, const RouteKey& key, Time now) {
  const bool conflict = error.code == ErrorCode::kConflict;
  const bool corrupt = error.code == ErrorCode::kCorrupt;
  ++(conflict ? counters_.conflicting : corrupt ? counters_.corrupt : counters_.store_failures);
  // A store that is unavailable takes nothing of any route.
  const bool of_all = error.code == ErrorCode::kUnavailable;
  AddNote(conflict ? Note::Severity::kWarning : Note::Severity::kError,
          fmt::format("{}/{}", static_cast<int>(error.code), of_all ? "" : Describe(key)),
          conflict ? "refused: " + error.message : error.message, now);
}

void RouteKeeper::SendAnswers(Time now, std::vector<Message>& out) {
  for (const auto& [key, indices] : backup_responder_.Due(now)) answers_.Ask(key, indices, now);
  AnswerQueue::Answers answers = answers_.Due(
      now, options_.answer_bytes_per_tick,
      [this](const RouteKey& key, SegmentIndex index) { return store_.ReadSegment(key, index); });
  for (SegmentBatch& batch : SplitBatch({.sender = self_, .pieces = std::move(answers.pieces)})) {
    out.emplace_back(std::move(batch));
  }
  for (const auto& [key, index, error] : answers.unreadable) {
    if (error.code == ErrorCode::kCorrupt) {
      NoteDamage(key, index, now);
      continue;
    }
    ++counters_.store_failures;
    AddNote(Note::Severity::kError, "unreadable", error.message, now);
  }
}

void RouteKeeper::Sent(const Message& message) {
  const auto* batch = std::get_if<SegmentBatch>(&message);
  if (batch == nullptr) return;
  for (const SegmentPiece& piece : batch->pieces) {
    if (piece.bytes.empty()) continue;
    ++counters_.answered;
    counters_.answered_bytes += piece.bytes.size();
  }
}

void RouteKeeper::NotSent(const Message& message, Time now) {
  constexpr std::size_t kMostReplies = 32;  // an agent that waits for more asks again
  if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
    for (const SegmentPiece& piece : batch->pieces) {
      if (!piece.bytes.empty()) answers_.PutBack(piece.key, piece.index, now);
    }
  } else if (const auto* announced = std::get_if<RouteAnnouncement>(&message)) {
    const auto kept = routes_.find(announced->info.key);
    if (kept != routes_.end()) kept->second.announce_due = kept->second.resend_due = true;
  } else if (const auto* receipt = std::get_if<Receipt>(&message)) {
    const auto kept = routes_.find(receipt->key);
    if (kept != routes_.end()) kept->second.receipt_due = true;
  } else if (std::holds_alternative<CatalogReply>(message) && replies_.size() < kMostReplies) {
    replies_.push_back(message);
  }
}

void RouteKeeper::AddNote(Note::Severity severity, const std::string& about, std::string text,
                          Time now) {
  if (noted_.IsDue(about, now)) notes_.push_back({severity, std::move(text)});
}

}  // namespace trailcast::exchange
