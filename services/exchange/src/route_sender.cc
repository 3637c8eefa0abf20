#include "services/exchange/route_sender.h"

#include <algorithm>
#include <cassert>

#include "services/exchange/batches.h"
#include "services/exchange/bounds.h"
#include "services/route/digest.h"

namespace trailcast::exchange {

RouteSender::RouteSender(AgentId self, route::RouteInfo info, ReadPiece read, SegmentDigests held,
                         const std::vector<SegmentIndex>& receipted, RouteSenderOptions options)
    : self_(std::move(self)),
      info_(std::move(info)),
      read_(std::move(read)),
      options_(options),
      digests_(std::move(held)),
      answers_(options.answers) {
  for (std::uint32_t i = 0; i < info_.segment_count; ++i) unreceipted_.insert(SegmentIndex(i));
  for (const SegmentIndex index : receipted) unreceipted_.erase(index);
}

void RouteSender::Add(route::SegmentPiece piece, route::RouteInfo info) {
  assert(piece.key == info_.key && piece.index.value() < info.segment_count);
  unreceipted_.insert(piece.index);
  digests_.Put(piece.index, piece.digest);
  if (!deleted()) to_stream_.push_back(std::move(piece));
  Update(std::move(info));
}

void RouteSender::Update(route::RouteInfo info) {
  assert(info.key == info_.key && info.segment_count >= info_.segment_count);
  info.revision = std::max(info.revision, info_.revision);
  info_ = std::move(info);
  changed_ = true;
}

void RouteSender::Handle(const Message& message, Time now) {
  if (const auto* request = std::get_if<SegmentRequest>(&message)) HandleRequest(*request, now);
  if (const auto* receipt = std::get_if<Receipt>(&message)) HandleReceipt(*receipt);
}

std::optional<route::RouteInfo> RouteSender::TakeNumbered() {
  return std::exchange(numbered_, false) ? std::optional(info_) : std::nullopt;
}

void RouteSender::HandleRequest(const SegmentRequest& request, Time now) {
  if (request.key != info_.key) return;
  if (request.lacking.empty()) changed_ = true;
  constexpr std::size_t kMostRemembered = 16'384;  // strangers can make up names: 2 MB a route
  if (left_to_server_.size() > kMostRemembered) left_to_server_.clear();
  std::vector<SegmentIndex> wanted;
  for (const SegmentIndex index : request.lacking) {
    if (index.value() >= info_.segment_count) continue;
    const bool only_here = unreceipted_.contains(index);
    if (only_here || !left_to_server_.emplace(request.requester, index).second) {
      left_to_server_.erase({request.requester, index});
      wanted.push_back(index);
    }
  }
  if (request.digests_only) {
    TellDigests(wanted);
  } else {
    answers_.Ask(info_.key, wanted, now);
  }
}

void RouteSender::TellDigests(const std::vector<SegmentIndex>& indices) {
  for (const SegmentIndex index : indices) {
    // The link is blocked, and an agent that lacks it asks again.
    if (to_stream_.size() >= kMaxPiecesPerBatch) return;
    const route::Digest* digest = digests_.Find(index);
    if (digest != nullptr) to_stream_.push_back({info_.key, index, *digest, {}});
  }
}

void RouteSender::HandleReceipt(const Receipt& receipt) {
  if (receipt.key != info_.key || deleted()) return;
  standing_ = {receipt.standing, receipt.followed};
  refused_.reset();
  if (receipt.refusal != Refusal::kNone) {
    refused_ = receipt;
  } else {
    remark_ = receipt.reason;
  }
  if (deleted()) {
    to_stream_.clear();
    return;
  }
  const bool known_here = receipt.durable_prefix <= info_.segment_count;
  const auto prefix = known_here ? PrefixDigest(receipt.durable_prefix) : std::nullopt;
  if (prefix != receipt.prefix_digest) {
    contradicted_by_ = receipt.server;
    return;
  }
  contradicted_by_.reset();
  if (receipt.revision > info_.revision) {
    info_.revision = receipt.revision;
    numbered_ = true;
  }
  while (!unreceipted_.empty() && unreceipted_.begin()->value() < receipt.durable_prefix) {
    MarkReceipted(*unreceipted_.begin());
  }
  for (const NamedSegment& segment : receipt.durable_beyond) {
    const route::Digest* digest = digests_.Find(segment.index);
    if (digest != nullptr && *digest == segment.digest) MarkReceipted(segment.index);
  }
  const bool all = receipt.durable_prefix == info_.segment_count;
  if (all && receipt.durable_state == route::RouteState::kComplete) complete_receipted_ = true;
}

std::optional<route::Digest> RouteSender::PrefixDigest(std::uint32_t count) {
  while (chain_.size() <= count) {
    const route::Digest* next =
        digests_.Find(SegmentIndex(static_cast<std::uint32_t>(chain_.size() - 1)));
    if (next == nullptr) return std::nullopt;
    chain_.push_back(route::ChainDigest(chain_.back(), *next));
  }
  return chain_[count];
}

void RouteSender::MarkReceipted(SegmentIndex index) {
  if (unreceipted_.erase(index) > 0) newly_receipted_.push_back(index);
}

std::vector<Message> RouteSender::Tick(Time now) {
  AnswerQueue::Answers answers =
      answers_.Due(now, options_.answer_bytes_per_tick,
                   [this](const route::RouteKey&, SegmentIndex index) { return read_(index); });
  for (AnswerQueue::Unreadable& unreadable : answers.unreadable) {
    read_errors_.push_back(std::move(unreadable.error));
  }
  SegmentBatch batch{.sender = self_, .pieces = std::exchange(to_stream_, {})};
  std::move(answers.pieces.begin(), answers.pieces.end(), std::back_inserter(batch.pieces));

  // Segments go before the announcement that counts them, so that few are asked for needlessly.
  std::vector<Message> messages;
  for (SegmentBatch& part : SplitBatch(std::move(batch))) messages.emplace_back(std::move(part));
  const bool again = !Done() && announced_at_ && now >= *announced_at_ + options_.announce_every;
  if (changed_ || again) {
    messages.emplace_back(RouteAnnouncement{.holder = self_, .info = info_});
    changed_ = false;
    announced_at_ = now;
  }
  return messages;
}

void RouteSender::NotSent(const Message& message, Time now) {
  if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
    for (const route::SegmentPiece& piece : batch->pieces) {
      if (piece.key != info_.key || deleted()) continue;
      if (piece.bytes.empty()) {
        to_stream_.push_back(piece);
      } else {
        answers_.PutBack(piece.key, piece.index, now);
      }
    }
  } else if (const auto* announced = std::get_if<RouteAnnouncement>(&message)) {
    changed_ |= announced->info.key == info_.key;
  }
}

std::vector<SegmentIndex> RouteSender::TakeNewlyReceipted() {
  return std::exchange(newly_receipted_, {});
}

std::vector<Error> RouteSender::TakeReadErrors() { return std::exchange(read_errors_, {}); }

bool RouteSender::AllReceipted() const {
  return info_.state == route::RouteState::kComplete && complete_receipted_ && unreceipted_.empty();
}

}  // namespace trailcast::exchange
