#include "services/exchange/answer_queue.h"

namespace trailcast::exchange {

void AnswerQueue::Ask(const route::RouteKey& key, std::span<const SegmentIndex> indices, Time now) {
  if (indices.empty()) return;
  Asked& asked = asked_.try_emplace(key, Asked{.since = now, .indices = {}}).first->second;
  asked.indices.insert(indices.begin(), indices.end());
}

AnswerQueue::Answers AnswerQueue::Due(Time now, std::size_t max_bytes, const ReadPiece& read) {
  Answers due;
  std::size_t bytes = 0;
  for (auto at = asked_.begin(); at != asked_.end() && bytes < max_bytes;) {
    auto& [key, asked] = *at;
    if (now < asked.since + window_) {
      ++at;
      continue;
    }
    while (!asked.indices.empty() && bytes < max_bytes) {
      const SegmentIndex index = *asked.indices.begin();
      asked.indices.erase(asked.indices.begin());
      auto piece = read(key, index);
      if (piece) {
        bytes += piece->bytes.size();
        due.pieces.push_back(*std::move(piece));
      } else {
        due.unreadable.push_back({key, index, piece.error()});
      }
    }
    at = asked.indices.empty() ? asked_.erase(at) : std::next(at);
  }
  return due;
}

}  // namespace trailcast::exchange
