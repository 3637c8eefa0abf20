#include "services/exchange/backup_responder.h"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;

// As in AnswerQueue, segments that were sent are on their way to all who ask for them for this
// long.
constexpr milliseconds kOnItsWay{800};

// FNV-1a gives the same weight in every build.
std::uint64_t Weight(const AgentId& server, const route::RouteKey& key) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  };
  add(server.value());
  add(key.route.value());
  add(std::to_string(key.teaching.value()));
  // Names that differ only in their last letter must not come in the same order for every route.
  hash ^= hash >> 32U;
  return hash * 0x9E3779B97F4A7C15ULL;
}

}  // namespace

void BackupResponder::Handle(const Message& message, Time now) {
  if (const auto* batch = std::get_if<SegmentBatch>(&message)) {
    if (servers_.Contains(batch->sender)) HandleBatch(*batch, now);
    return;
  }
  const auto* status = std::get_if<AgentStatus>(&message);
  const bool of_own_name = status != nullptr && status->agent == self_;
  if (!of_own_name) servers_.Handle(message);
}

void BackupResponder::HandleBatch(const SegmentBatch& batch, Time now) {
  for (const route::SegmentPiece& piece : batch.pieces) {
    if (piece.bytes.empty()) continue;
    sent_.Touch({piece.key, piece.index}) = now;
    const auto left = left_.find(piece.key);
    if (left == left_.end()) continue;
    left->second.heard_at = now;
    remembered_ -= left->second.due.erase(piece.index);
  }
}

std::vector<AgentId> BackupResponder::Before(const AgentId& requester, const route::RouteKey& key,
                                             Time now) const {
  std::vector<std::pair<std::uint64_t, AgentId>> before;
  const std::uint64_t own = Weight(self_, key);
  for (const AgentId& server : servers_.Names()) {
    const Time* silent_until = silent_until_.Find({server, key});
    const bool silent = silent_until != nullptr && now < *silent_until;
    const std::uint64_t weight = Weight(server, key);
    if (server != requester && !silent && weight > own) before.emplace_back(weight, server);
  }
  std::sort(before.begin(), before.end(), std::greater<>());
  std::vector<AgentId> names;
  for (auto& [weight, server] : before) names.push_back(std::move(server));
  return names;
}

std::vector<SegmentIndex> BackupResponder::Mine(const AgentId& requester,
                                                const route::RouteKey& key,
                                                const std::vector<SegmentIndex>& asked, Time now) {
  if (asked.empty()) return {};
  const std::vector<AgentId> before = Before(requester, key, now);
  if (before.empty()) return asked;
  const Time due = now + options_.patience * static_cast<int>(before.size());
  std::vector<SegmentIndex> mine;
  for (const SegmentIndex index : asked) {
    const Place place{key, index};
    const std::pair who{requester, place};
    const Time* asked_at = asked_once_.Find(who);
    const bool again = asked_at != nullptr && now < *asked_at + options_.asked_again;
    if (again || remembered_ >= kMostRemembered) {
      asked_once_.Erase(who);
      mine.push_back(index);
      continue;
    }
    asked_once_.Touch(who) = now;
    const Time* sent_at = sent_.Find(place);
    if (sent_at != nullptr && now < *sent_at + kOnItsWay) continue;
    Left& left = left_[key];
    left.owner = before.front();
    remembered_ += left.due.try_emplace(index, due).second ? 1U : 0U;
  }
  return mine;
}

std::map<route::RouteKey, std::vector<SegmentIndex>> BackupResponder::Due(Time now) {
  std::map<route::RouteKey, std::vector<SegmentIndex>> due;
  for (auto at = left_.begin(); at != left_.end();) {
    auto& [key, left] = *at;
    const bool others_send = now < left.heard_at + options_.patience;
    for (auto each = left.due.begin(); !others_send && each != left.due.end();) {
      if (now < each->second) {
        ++each;
        continue;
      }
      due[key].push_back(each->first);
      each = left.due.erase(each);
      --remembered_;
    }
    if (due.contains(key) && left.heard_at == Time{}) {
      silent_until_.Touch({left.owner, key}) = now + options_.silent_for;
    }
    at = left.due.empty() ? left_.erase(at) : std::next(at);
  }
  return due;
}

}  // namespace trailcast::exchange
