#include "services/exchange/want_list.h"

#include <algorithm>

namespace trailcast::exchange {

void WantList::Want(SegmentIndex index, Time ask_at) {
  wanted_.try_emplace(index, Entry{.ask_at = ask_at, .asked_at = std::nullopt, .times_asked = 0});
}

void WantList::AskAgain(SegmentIndex index, Time now) {
  const auto found = wanted_.find(index);
  if (found == wanted_.end() || found->second.times_asked > 1) return;
  found->second.ask_at = now;
  found->second.asked_at.reset();
}

void WantList::Hurry(Time now) {
  for (auto& [index, entry] : wanted_) {
    if (!entry.asked_at || IsUnderWay(entry, now)) continue;
    entry.ask_at = std::min(entry.ask_at, now);
    entry.times_asked = 0;
  }
}

std::vector<SegmentIndex> WantList::Due(Time now) {
  auto under_way = static_cast<std::size_t>(
      std::count_if(wanted_.begin(), wanted_.end(),
                    [&](const auto& wanted) { return IsUnderWay(wanted.second, now); }));
  std::vector<SegmentIndex> due;
  for (auto& [index, entry] : wanted_) {
    if (under_way >= options_.max_under_way) break;
    if (now < entry.ask_at) continue;
    if (!IsUnderWay(entry, now)) ++under_way;
    const auto wait = options_.retry_after * (1LL << std::min(entry.times_asked, 10));
    entry.ask_at = now + std::min<std::chrono::milliseconds>(wait, options_.retry_at_most);
    entry.asked_at = now;
    ++entry.times_asked;
    due.push_back(index);
  }
  return due;
}

std::optional<SegmentIndex> WantList::first() const {
  if (wanted_.empty()) return std::nullopt;
  return wanted_.begin()->first;
}

std::optional<SegmentIndex> WantList::last() const {
  if (wanted_.empty()) return std::nullopt;
  return wanted_.rbegin()->first;
}

// Asked for so recently that an answer may still come.
bool WantList::IsUnderWay(const Entry& entry, Time now) const {
  return entry.asked_at && now < *entry.asked_at + options_.retry_after;
}

}  // namespace trailcast::exchange
