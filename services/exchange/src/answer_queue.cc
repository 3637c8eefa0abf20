#include "services/exchange/answer_queue.h"

#include <algorithm>

namespace trailcast::exchange {

void AnswerQueue::Ask(const route::RouteKey& key, std::span<const SegmentIndex> indices, Time now) {
  if (indices.empty()) return;
  auto [at, is_new] = asked_.try_emplace(key);
  Asked& asked = at->second;
  if (is_new) asked.due_at = now + options_.window;
  for (const SegmentIndex index : indices) {
    const auto sent = asked.sent.find(index);
    if (sent != asked.sent.end() && IsOnItsWay(sent->second, now)) continue;
    if (!HasRoom(now)) return;
    remembered_ += asked.indices.insert(index).second ? 1U : 0U;
  }
}

// Segments that are no longer on their way make room.
bool AnswerQueue::HasRoom(Time now) {
  if (remembered_ < options_.most) return true;
  if (now < cleared_at_ + options_.on_its_way) return false;
  cleared_at_ = now;
  remembered_ = 0;
  for (auto& [key, asked] : asked_) {
    std::erase_if(asked.sent, [&](const auto& sent) { return !IsOnItsWay(sent.second, now); });
    remembered_ += asked.sent.size() + asked.indices.size();
  }
  return remembered_ < options_.most;
}

void AnswerQueue::PutBack(const route::RouteKey& key, SegmentIndex index, Time now) {
  Asked& asked = asked_[key];
  remembered_ -= asked.sent.erase(index);
  remembered_ += asked.indices.insert(index).second ? 1U : 0U;
  asked.due_at = now + options_.again_after;
}

AnswerQueue::Answers AnswerQueue::Due(Time now, std::size_t max_bytes, const ReadPiece& read) {
  Answers due;
  std::size_t bytes = 0;
  // Routes take turns: the route that was served last is now the last one.
  std::vector<route::RouteKey> turn;
  for (const auto& [key, asked] : asked_) turn.push_back(key);
  std::rotate(turn.begin(), std::upper_bound(turn.begin(), turn.end(), served_last_), turn.end());
  for (const route::RouteKey& key : turn) {
    if (bytes >= max_bytes) break;
    Asked& asked = asked_.at(key);
    if (now < asked.due_at) continue;
    if (!asked.indices.empty()) served_last_ = key;
    while (!asked.indices.empty() && bytes < max_bytes) {
      const SegmentIndex index = *asked.indices.begin();
      asked.indices.erase(asked.indices.begin());
      --remembered_;
      auto piece = read(key, index);
      if (piece) {
        bytes += piece->bytes.size();
        remembered_ += asked.sent.insert_or_assign(index, now).second ? 1U : 0U;
        asked.sent_last = now;
        due.pieces.push_back(*std::move(piece));
      } else {
        due.unreadable.push_back({key, index, piece.error()});
      }
    }
    if (!asked.indices.empty() || IsOnItsWay(asked.sent_last, now)) continue;
    remembered_ -= asked.sent.size();
    asked_.erase(key);
  }
  return due;
}

bool AnswerQueue::IsDue(Time now) const {
  return std::any_of(asked_.begin(), asked_.end(), [now](const auto& entry) {
    return !entry.second.indices.empty() && now >= entry.second.due_at;
  });
}

bool AnswerQueue::empty() const {
  return std::all_of(asked_.begin(), asked_.end(),
                     [](const auto& entry) { return entry.second.indices.empty(); });
}

}  // namespace trailcast::exchange
