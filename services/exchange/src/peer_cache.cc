#include "services/exchange/peer_cache.h"

#include <string_view>

#include "services/exchange/batches.h"

namespace trailcast::exchange {
namespace {

// It remembers so many requests that were not answered. Beyond that, every request counts as the
// first one.
constexpr std::size_t kMostRemembered = 100'000;
// Strangers can make up names of servers, and segments to ask for.
constexpr std::size_t kMostToAnswer = 16'384;
// A link that took nothing is tried again after this.
constexpr std::chrono::milliseconds kAgainAfter{50};

}  // namespace

PeerCache::PeerCache(AgentId self, ReadPiece read, ReadInfo read_info, PeerCacheOptions options)
    : self_(std::move(self)),
      read_(std::move(read)),
      read_info_(std::move(read_info)),
      options_(options) {
  const std::size_t share = std::hash<std::string_view>()(self_.value()) % 1024;
  patience_ = options_.patience + options_.patience * static_cast<int>(share) / 1024;
}

void PeerCache::Hold(const std::vector<route::RouteKey>& revisions) {
  held_ = {revisions.begin(), revisions.end()};
}

void PeerCache::Handle(const Message& message, Time now) {
  if (const auto* request = std::get_if<SegmentRequest>(&message)) HandleRequest(*request, now);
  if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
    for (const route::SegmentPiece& piece : batch->pieces) {
      const auto due = to_answer_.find({piece.key, piece.index});
      if (due == to_answer_.end()) continue;
      if (due->second.digest_only || !piece.bytes.empty()) to_answer_.erase(due);
    }
  }
  if (const auto* news = std::get_if<RouteAnnouncement>(&message)) {
    if (news->info.state == route::RouteState::kComplete) to_announce_.erase(news->info.key);
  }
  servers_.Handle(message);
}

void PeerCache::HandleRequest(const SegmentRequest& request, Time now) {
  if (!held_.contains(request.key)) return;
  const bool of_server = servers_.Contains(request.requester);
  if (!servers_.empty() && !of_server) return;
  if (request.lacking.empty() && of_server && read_info_) {
    to_announce_.try_emplace(request.key, now + patience_);
  }
  if (asked_once_.size() > kMostRemembered) asked_once_.clear();
  for (const SegmentIndex index : request.lacking) {
    const Place place{request.key, index};
    if (asked_once_.emplace(request.requester, place).second) continue;
    asked_once_.erase({request.requester, place});
    if (to_answer_.size() >= kMostToAnswer) return;  // an agent that lacks it asks again
    const Due due{.at = now + patience_, .digest_only = request.digests_only};
    to_answer_.try_emplace(place, due).first->second.digest_only &= request.digests_only;
    listens_until_[request.key] = now + options_.listen_for;
  }
}

std::set<route::RouteKey> PeerCache::ListensTo(Time now) const {
  std::set<route::RouteKey> routes;
  for (const auto& [key, until] : listens_until_) {
    if (now < until) routes.insert(key);
  }
  return routes;
}

std::vector<Message> PeerCache::Tick(Time now) {
  std::erase_if(listens_until_, [now](const auto& entry) { return now >= entry.second; });
  SegmentBatch batch{.sender = self_, .pieces = {}};
  std::size_t bytes = 0;
  for (auto at = to_answer_.begin();
       at != to_answer_.end() && bytes < options_.answer_bytes_per_tick;) {
    if (now < at->second.at) {
      ++at;
      continue;
    }
    if (auto piece = read_(at->first.first, at->first.second)) {
      if (at->second.digest_only) piece->bytes.clear();
      bytes += piece->bytes.size();
      batch.pieces.push_back(*std::move(piece));
    }
    at = to_answer_.erase(at);
  }
  std::vector<Message> messages;
  for (auto at = to_announce_.begin(); at != to_announce_.end();) {
    if (now < at->second) {
      ++at;
      continue;
    }
    if (const auto info = read_info_(at->first); info && *info) {
      messages.emplace_back(RouteAnnouncement{.holder = self_, .info = **info});
    }
    at = to_announce_.erase(at);
  }
  if (batch.pieces.empty()) return messages;
  for (SegmentBatch& part : SplitBatch(std::move(batch))) messages.emplace_back(std::move(part));
  return messages;
}

void PeerCache::NotSent(const Message& message, Time now) {
  if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
    for (const route::SegmentPiece& piece : batch->pieces) {
      to_answer_.try_emplace({piece.key, piece.index},
                             Due{.at = now + kAgainAfter, .digest_only = piece.bytes.empty()});
    }
  } else if (const auto* announced = std::get_if<RouteAnnouncement>(&message)) {
    to_announce_.try_emplace(announced->info.key, now + kAgainAfter);
  }
}

}  // namespace trailcast::exchange
