#include "services/exchange/want_list.h"

#include <algorithm>
#include <iterator>

namespace trailcast::exchange {

using std::chrono::milliseconds;

void WantList::Want(SegmentIndex index, Time ask_at) {
  if (contains(index)) return;
  const std::uint32_t number = index.value();
  const auto after = waiting_.upper_bound(number);
  if (after != waiting_.begin()) {
    Waiting& before = std::prev(after)->second;
    if (before.end == number && before.ask_at == ask_at) {
      ++before.end;
      return;
    }
  }
  waiting_.emplace_hint(after, number, Waiting{.end = number + 1, .ask_at = ask_at});
}

void WantList::Arrived(SegmentIndex index, Time now) {
  if (const auto asked = asked_.find(index); asked != asked_.end()) {
    // With several requests, nobody can tell which one was answered.
    if (asked->second.times == 1) AdjustWindow(now - asked->second.at);
    answered_at_ = now;
    overtaken_before_ = std::max(overtaken_before_, asked->second.at);
    asked_.erase(asked);
  } else {
    StopWaiting(index.value());
  }
}

bool WantList::StopWaiting(std::uint32_t index) {
  const auto found = FindWaiting(index);
  if (found == waiting_.end()) return false;
  const auto [first, waiting] = *found;
  waiting_.erase(found);
  if (first < index) waiting_.insert({first, {index, waiting.ask_at}});
  if (index + 1 < waiting.end) waiting_.insert({index + 1, waiting});
  return true;
}

void WantList::Truncate(std::uint32_t end) {
  asked_.erase(asked_.lower_bound(SegmentIndex(end)), asked_.end());
  waiting_.erase(waiting_.lower_bound(end), waiting_.end());
  if (waiting_.empty()) return;
  Waiting& last = waiting_.rbegin()->second;
  last.end = std::min(last.end, end);
}

void WantList::AskAgain(SegmentIndex index, Time now) {
  const auto asked = asked_.find(index);
  if (asked != asked_.end()) {
    if (asked->second.times == 1) asked->second.again_now = true;
  } else if (StopWaiting(index.value())) {
    Want(index, now);
  }
}

void WantList::Hurry(Time now) {
  for (auto& [index, asked] : asked_) {
    if (IsUnderWay(asked, now)) continue;
    asked.again_now = true;
    asked.times = 0;
  }
}

void WantList::Clear() {
  asked_.clear();
  waiting_.clear();
}

std::vector<SegmentIndex> WantList::Due(Time now) {
  // Requests that were not answered take no part of the window, but are bounded too.
  const std::size_t most_asked = 4 * options_.most_under_way;
  auto under_way =
      static_cast<std::size_t>(std::count_if(asked_.begin(), asked_.end(), [&](const auto& entry) {
        return IsUnderWay(entry.second, now);
      }));
  std::vector<SegmentIndex> due;
  const bool few = under_way < window_ && 4 * (window_ - under_way) < window_;
  if (few) return due;
  bool in_vain = false;
  for (auto at = asked_.begin(); at != asked_.end() && under_way < window_; ++at) {
    auto& [index, asked] = *at;
    if (!IsDueAgain(asked, now)) continue;
    in_vain |= !asked.again_now;
    asked = {.at = now, .times = asked.times + 1};
    due.push_back(index);
    ++under_way;
  }
  if (in_vain) window_ = std::max(window_ / 2, options_.least_under_way);
  for (auto at = waiting_.begin(); at != waiting_.end() && under_way < window_;) {
    std::uint32_t next = at->first;
    const Waiting waiting = at->second;
    if (now < waiting.ask_at) {
      ++at;
      continue;
    }
    for (; next < waiting.end && under_way < window_ && asked_.size() < most_asked; ++next) {
      asked_.emplace(SegmentIndex(next), Asked{.at = now});
      due.emplace_back(next);
      ++under_way;
    }
    at = waiting_.erase(at);
    if (next < waiting.end) {
      waiting_.insert({next, waiting});
      break;
    }
  }
  std::sort(due.begin(), due.end());
  return due;
}

bool WantList::contains(SegmentIndex index) const {
  return asked_.contains(index) || FindWaiting(index.value()) != waiting_.end();
}

std::size_t WantList::size() const {
  std::size_t wanted = asked_.size();
  for (const auto& [first, waiting] : waiting_) wanted += waiting.end - first;
  return wanted;
}

std::optional<SegmentIndex> WantList::first() const {
  if (empty()) return std::nullopt;
  if (waiting_.empty()) return asked_.begin()->first;
  const SegmentIndex waiting(waiting_.begin()->first);
  return asked_.empty() ? waiting : std::min(waiting, asked_.begin()->first);
}

WantList::Waitings::const_iterator WantList::FindWaiting(std::uint32_t index) const {
  const auto after = waiting_.upper_bound(index);
  if (after == waiting_.begin()) return waiting_.end();
  const auto found = std::prev(after);
  return index < found->second.end ? found : waiting_.end();
}

bool WantList::IsPatient(Time asked_at, milliseconds wait, Time now) const {
  if (now < asked_at + wait) return true;
  const bool answers_come = answered_at_ && now < *answered_at_ + options_.retry_after;
  return answers_come && asked_at >= overtaken_before_ && now < asked_at + options_.retry_at_most;
}

bool WantList::IsUnderWay(const Asked& asked, Time now) const {
  return !asked.again_now && IsPatient(asked.at, options_.retry_after, now);
}

bool WantList::IsDueAgain(const Asked& asked, Time now) const {
  if (asked.again_now) return true;
  const auto wait = options_.retry_after * (1LL << std::clamp(asked.times - 1, 0, 10));
  return !IsPatient(asked.at, std::min<milliseconds>(wait, options_.retry_at_most), now);
}

void WantList::AdjustWindow(std::chrono::nanoseconds round_trip) {
  if (round_trip < options_.quick_answer) {
    window_ = std::min(window_ + 1, options_.most_under_way);
  } else if (round_trip > options_.slow_answer) {
    window_ = std::max(window_ - 1, options_.least_under_way);
  }
}

}  // namespace trailcast::exchange
