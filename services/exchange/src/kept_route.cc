#include "services/exchange/kept_route.h"

#include <algorithm>

#include "services/base/result.h"
#include "services/exchange/bounds.h"
#include "services/route/digest.h"
#include "services/route/labels.h"

namespace trailcast::exchange {

using route::RouteInfo;
using route::RouteState;

KeptRoute::KeptRoute(std::optional<RouteInfo> stored, const std::vector<store::HeldSegment>& held,
                     WantList::Options want_options)
    : want(want_options), stored_(std::move(stored)), claim_(stored_) {
  for (const store::HeldSegment& segment : held) held_.Put(segment.index, segment.digest);
  AdvancePrefix();
  if (!stored_ || deleted()) return;
  // A store that lost segments which its info counts has to get them again.
  WantMissing(stored_->segment_count, Time{});
}

KeptRoute::ClaimResult KeptRoute::Claim(const RouteInfo& info, Time ask_at) {
  heard_ = true;
  if (deleted()) return ClaimResult::kDeleted;
  if (complete()) {
    auto after = route::AfterNews(*stored_, info);
    if (!after) return ClaimResult::kConflict;
    claim_ = std::move(*after);
    return claim_ == stored_ ? ClaimResult::kOldNews : ClaimResult::kNews;
  }
  // The held segments would lie beyond its end, and the store would take it for old news.
  const bool too_short = stored_ && info.segment_count < stored_->segment_count;
  if (info.state == RouteState::kComplete && too_short) return ClaimResult::kConflict;
  const bool was_complete = claim_ && claim_->state == RouteState::kComplete;
  const bool completes = info.state == RouteState::kComplete && !was_complete;
  const bool grows = !was_complete && (!claim_ || info.segment_count > claim_->segment_count);
  const bool relabels = claim_ && route::HasLaterLabels(info, *claim_);
  if (!completes && !grows) {
    if (relabels) route::TakeLabels(*claim_, info);
    return relabels ? ClaimResult::kNews : ClaimResult::kOldNews;
  }
  RouteInfo claim = info;
  if (claim_ && route::HasLaterLabels(*claim_, info)) route::TakeLabels(claim, *claim_);
  claim_ = std::move(claim);
  WantMissing(info.segment_count, ask_at);
  return ClaimResult::kNews;
}

void KeptRoute::MarkHeld(SegmentIndex index, const route::Digest& digest, Time now) {
  held_.Put(index, digest);
  damaged_.Remove(index);
  want.Arrived(index, now);
  AdvancePrefix();
}

void KeptRoute::MarkDamaged(SegmentIndex index, Time now) {
  if (const auto digest = held_.Remove(index)) {
    damaged_.Put(index, *digest);
    prefix_ = std::min(prefix_, index.value());
    want.Want(index, now);
  }
}

std::vector<SegmentIndex> KeptRoute::Damaged() const {
  std::vector<SegmentIndex> indices;
  for (const auto& [index, digest] : damaged_.entries()) indices.push_back(index);
  return indices;
}

std::optional<route::Digest> KeptRoute::DigestOf(SegmentIndex index) const {
  for (const auto* segments : {&held_, &damaged_}) {
    if (const auto* found = segments->Find(index)) return *found;
  }
  return std::nullopt;
}

std::optional<RouteInfo> KeptRoute::DurableInfo() const {
  if (!claim_) return std::nullopt;
  const bool tombstone = claim_->standing == route::Standing::kDeleted;
  if (tombstone || prefix_ >= claim_->segment_count) return claim_;
  if (prefix_ == 0) return std::nullopt;
  RouteInfo durable = *claim_;
  const double share = static_cast<double>(prefix_) / claim_->segment_count;
  durable.state = RouteState::kTeaching;
  durable.segment_count = prefix_;
  durable.length_m *= share;
  durable.bytes = static_cast<std::uint64_t>(static_cast<double>(claim_->bytes) * share);
  durable.manifest_digest = {};
  return durable;
}

void KeptRoute::MarkStored(const RouteInfo& info) {
  stored_ = info;
  if (claim_) route::TakeLabels(*claim_, info);
  if (!claim_ || complete() || claim_->segment_count < info.segment_count) claim_ = stored_;
  if (!deleted()) return;
  claim_ = stored_;
  held_.clear();
  damaged_.clear();
  prefix_ = 0;
  want.Clear();
  receipt_due = true;
}

bool KeptRoute::TakeUp(const std::optional<RouteInfo>& stored,
                       const std::vector<store::HeldSegment>& held, Time now, Time ask_at) {
  bool is_new = false;
  if (stored && stored != stored_) {
    MarkStored(*stored);
    is_new = true;
  }
  if (deleted()) return is_new;
  for (const store::HeldSegment& segment : held) {
    if (Holds(segment.index) || IsDamaged(segment.index)) continue;
    MarkHeld(segment.index, segment.digest, now);
    is_new = true;
  }
  if (is_new) MarkRoom();  // some pieces were taken
  if (stored_) WantMissing(stored_->segment_count, ask_at);
  return is_new;
}

void KeptRoute::MarkOver(const std::string& reason, Time until) {
  full_ = reason;
  over_until_ = until;
  receipt_due = true;
}

void KeptRoute::LapseOver(Time now) {
  if (!over_until_ || now < *over_until_) return;
  over_until_.reset();
  full_.clear();
  receipt_due = true;
}

std::optional<AgentId> KeptRoute::scout() const {
  const std::optional<route::RouteInfo>& info = stored_ ? stored_ : claim_;
  return info ? std::optional(info->scout) : std::nullopt;
}

void KeptRoute::ForgetClaim() {
  claim_ = stored_;
  want.Clear();
}

const route::Digest& KeptRoute::PrefixDigest() {
  if (chained_ > prefix_) {
    chained_ = 0;
    chain_ = {};
  }
  for (; chained_ < prefix_; ++chained_) {
    chain_ = route::ChainDigest(chain_, *held_.Find(SegmentIndex(chained_)));
  }
  return chain_;
}

Receipt KeptRoute::MakeReceipt(const AgentId& server, const route::RouteKey& key) {
  Receipt receipt{.server = server,
                  .key = key,
                  .durable_prefix = prefix_,
                  .prefix_digest = PrefixDigest(),
                  .durable_beyond = {},
                  .durable_state = complete() ? RouteState::kComplete : RouteState::kTeaching,
                  .revision = stored_ ? stored_->revision : RevisionNumber(),
                  .standing = stored_ ? stored_->standing : route::Standing::kStaged,
                  .refusal = Refusal::kNone,
                  .reason = full_.empty() ? remark_ : full_};
  if (deleted()) {
    receipt.durable_state = RouteState::kTeaching;
    receipt.refusal = Refusal::kDeleted;
    receipt.reason = "an operator deleted it";
  } else if (!full_.empty()) {
    receipt.refusal = Refusal::kFull;
  }
  const auto& held = held_.entries();
  for (auto at = held_.From(SegmentIndex(prefix_)); at != held.end(); ++at) {
    if (receipt.durable_beyond.size() == kMaxSegmentsPerReceipt) break;
    receipt.durable_beyond.push_back({at->index, at->digest});
  }
  return receipt;
}

void KeptRoute::WantMissing(std::uint32_t count, Time ask_at) {
  for (std::uint32_t i = prefix_; i < count; ++i) {
    if (!Holds(SegmentIndex(i))) want.Want(SegmentIndex(i), ask_at);
  }
}

void KeptRoute::AdvancePrefix() {
  while (held_.contains(SegmentIndex(prefix_))) ++prefix_;
}

}  // namespace trailcast::exchange
