#include "services/exchange/route_fetcher.h"

#include <algorithm>
#include <utility>

#include "services/exchange/bounds.h"
#include "services/route/labels.h"

namespace trailcast::exchange {

using route::RouteState;

RouteFetcher::RouteFetcher(AgentId self, route::RouteKey key, const std::vector<Held>& held,
                           Integrity integrity, Time now, RouteFetcherOptions options)
    : self_(std::move(self)),
      key_(std::move(key)),
      integrity_(std::move(integrity)),
      options_(std::move(options)),
      want_(options_.want),
      heard_at_(now),
      inquire_at_(now + options_.fresh_grace) {
  for (const Held& piece : held) held_.emplace(piece.index, piece.digest);
}

void RouteFetcher::Learn(const route::RouteInfo& info, Time now) {
  if (info.key != key_) return;
  if (info.standing == route::Standing::kDeleted) {
    deleted_ = true;
    return;
  }
  if (info_ && info.edition > info_->edition) route::TakeLabels(*info_, info);
  const bool complete = info_ && info_->state == RouteState::kComplete;
  if (complete) {
    // Complete routes never change. A holder that has less of one is no contradiction.
    const bool less = info.state == RouteState::kTeaching;
    if (!less && (info.manifest_digest != info_->manifest_digest ||
                  info.segment_count != info_->segment_count)) {
      ++counts_.conflicting;
      return;
    }
  } else if (!info_ || info.state == RouteState::kComplete ||
             info.segment_count > info_->segment_count) {
    const bool fresh = info_ || info.state == RouteState::kTeaching;
    route::RouteInfo grown = info;
    if (info_ && info_->edition > info.edition) route::TakeLabels(grown, *info_);
    info_ = std::move(grown);
    WantMissing(fresh ? now + options_.fresh_grace : now);
    Judge(now);
  }
  heard_at_ = now;
}

void RouteFetcher::Handle(Message message, Time now) {
  if (const auto* announcement = std::get_if<RouteAnnouncement>(&message)) {
    const bool known_before = info_.has_value();
    Learn(announcement->info, now);
    if (known_before && announcement->info.key == key_) {
      want_.Hurry(now);
      // The holder may be new.
      const bool in_vain = knocking_since_ && now >= *knocking_since_ + options_.knock_for;
      if (in_vain) knocking_since_.reset();
    }
  }
  if (auto* batch = std::get_if<SegmentBatch>(&message)) HandleBatch(*batch, now);
}

void RouteFetcher::HandleBatch(SegmentBatch& batch, Time now) {
  for (route::SegmentPiece& piece : batch.pieces) {
    if (piece.key != key_) continue;
    const std::size_t before = held_.size() + borrowed_.size();
    came_at_ = now;
    if (batch.IsLent(info_ ? std::optional(info_->scout) : std::nullopt)) {
      Borrow(std::move(piece), now);
    } else if (piece.bytes.empty()) {
      TakeFromOwn(piece, now);
    } else {
      Accept(std::move(piece), now);
    }
    if (held_.size() + borrowed_.size() > before) senders_.insert(batch.sender);
  }
}

void RouteFetcher::TakeFromOwn(const route::SegmentPiece& named, Time now) {
  if (!options_.own_content || held_.contains(named.index)) return;
  if (auto content = options_.own_content(named.digest)) {
    Accept({named.key, named.index, named.digest, std::move(*content)}, now);
  } else {
    want_.AskAgain(named.index, now);
  }
}

void RouteFetcher::Accept(route::SegmentPiece piece, Time now) {
  if (const auto held = held_.find(piece.index); held != held_.end()) {
    ++(held->second == piece.digest ? counts_.duplicate_pieces : counts_.conflicting);
    return;
  }
  const bool complete = info_ && info_->state == RouteState::kComplete;
  if (complete && piece.index.value() >= info_->segment_count) {
    ++counts_.conflicting;
    return;
  }
  if (!integrity_.check_piece(piece)) {
    ++counts_.bad_pieces;
    want_.AskAgain(piece.index, now);
    return;
  }
  heard_at_ = now;
  held_.emplace(piece.index, piece.digest);
  if (const auto lent = borrowed_.extract(piece.index)) {
    borrowed_bytes_ -= lent.mapped().bytes.size();
  }
  want_.Arrived(piece.index, now);
  arrived_.push_back(std::move(piece));
  Judge(now);
}

void RouteFetcher::Borrow(route::SegmentPiece piece, Time now) {
  const bool complete = info_ && info_->state == RouteState::kComplete;
  const bool wanted = borrows_ && complete && piece.index.value() < info_->segment_count &&
                      !held_.contains(piece.index) && !borrowed_.contains(piece.index);
  if (!wanted || piece.bytes.empty()) return;
  if (borrowed_bytes_ + piece.bytes.size() > options_.most_borrowed_bytes) return;
  if (!integrity_.check_piece(piece)) {
    ++counts_.bad_pieces;
    return;
  }
  heard_at_ = now;
  want_.Arrived(piece.index, now);
  borrowed_bytes_ += piece.bytes.size();
  borrowed_.emplace(piece.index, std::move(piece));
  Judge(now);
}

void RouteFetcher::ReturnBorrowed(Time now) {
  counts_.bad_pieces += borrowed_.size();
  for (const auto& [index, piece] : borrowed_) want_.Want(index, now);
  borrowed_.clear();
  borrowed_bytes_ = 0;
  borrows_ = false;
}

// A complete route's count is final, so segments wanted beyond it are forgotten.
void RouteFetcher::WantMissing(Time ask_at) {
  if (info_->state == RouteState::kComplete) want_.Truncate(info_->segment_count);
  for (std::uint32_t i = 0; i < info_->segment_count; ++i) {
    if (!held_.contains(SegmentIndex(i))) want_.Want(SegmentIndex(i), ask_at);
  }
}

void RouteFetcher::Judge(Time now) {
  if (verdict_ || !info_ || info_->state != RouteState::kComplete || !want_.empty()) return;
  std::vector<route::Digest> digests;
  for (std::uint32_t i = 0; i < info_->segment_count; ++i) {
    const auto held = held_.find(SegmentIndex(i));
    const auto borrowed = borrowed_.find(SegmentIndex(i));
    if (held != held_.end()) {
      digests.push_back(held->second);
    } else if (borrowed != borrowed_.end()) {
      digests.push_back(borrowed->second.digest);
    }
  }
  const bool right = integrity_.manifest(digests) == info_->manifest_digest;
  if (!right && !borrowed_.empty()) {
    ReturnBorrowed(now);
    return;
  }
  for (auto& [index, piece] : std::exchange(borrowed_, {})) {
    held_.emplace(index, piece.digest);
    arrived_.push_back(std::move(piece));
  }
  verdict_ = right ? FetchState::kComplete : FetchState::kWrong;
}

std::vector<Message> RouteFetcher::Tick(Time now) {
  std::vector<Message> messages;
  if (IsInquiryDue(now)) {
    messages.emplace_back(SegmentRequest{.requester = self_, .key = key_, .lacking = {}});
  }
  if (Knocks(now, messages)) return messages;
  std::vector<SegmentIndex> bytes = want_.Due(now);
  std::vector<SegmentIndex> digests;
  if (options_.own_content) {
    const auto first_asked = std::stable_partition(
        bytes.begin(), bytes.end(), [this](SegmentIndex i) { return asked_digest_.contains(i); });
    digests.assign(first_asked, bytes.end());
    bytes.erase(first_asked, bytes.end());
    asked_digest_.insert(digests.begin(), digests.end());
  }
  Ask(digests, true, messages);
  Ask(bytes, false, messages);
  return messages;
}

bool RouteFetcher::Knocks(Time now, std::vector<Message>& messages) {
  const auto first = want_.first();
  if (!first || (came_at_ && now < *came_at_ + options_.silent_after)) {
    knocking_since_.reset();
    return false;
  }
  if (!knocking_since_) knocking_since_ = knock_at_ = now;
  if (now >= *knocking_since_ + options_.knock_for) return false;
  if (now >= knock_at_) {
    Ask({*first}, true, messages);
    asked_digest_.insert(*first);
    knock_at_ = now + options_.knock_every;
  }
  return true;
}

void RouteFetcher::Ask(const std::vector<SegmentIndex>& lacking, bool digests_only,
                       std::vector<Message>& messages) const {
  for (std::size_t at = 0; at < lacking.size(); at += kMaxIndicesPerRequest) {
    const std::size_t end = std::min(lacking.size(), at + kMaxIndicesPerRequest);
    messages.emplace_back(
        SegmentRequest{.requester = self_,
                       .key = key_,
                       .lacking = {lacking.begin() + static_cast<std::ptrdiff_t>(at),
                                   lacking.begin() + static_cast<std::ptrdiff_t>(end)},
                       .digests_only = digests_only});
  }
}

// Either an announcement was missed or no holder is there. It asks soon at first, then after each
// silence.
bool RouteFetcher::IsInquiryDue(Time now) {
  const bool known = info_.has_value();
  if (verdict_ || now < inquire_at_ || (known && now < heard_at_ + options_.quiet_after)) {
    return false;
  }
  inquire_at_ = now + options_.quiet_after;
  return true;
}

std::vector<route::SegmentPiece> RouteFetcher::TakeArrived() { return std::exchange(arrived_, {}); }

FetchProgress RouteFetcher::Progress(Time now) const {
  FetchProgress progress = counts_;
  progress.held = static_cast<std::uint32_t>(held_.size());
  progress.known = info_ ? info_->segment_count : 0;
  const bool quiet = now - heard_at_ >= options_.quiet_after;
  if (verdict_) {
    progress.state = *verdict_;
  } else if (info_ && want_.empty()) {
    progress.state = FetchState::kUpToDate;
  } else if (info_ && !quiet) {
    progress.state = FetchState::kFetching;
  } else {
    progress.state = FetchState::kWaiting;
    progress.waiting_since = heard_at_;
  }
  return progress;
}

}  // namespace trailcast::exchange
