#include "services/webhooks/outbox.h"

#include <algorithm>
#include <utility>

#include "services/program/json.h"

namespace trailcast::webhooks {

using program::Json;

Outbox::Outbox(const std::vector<Hook>& hooks) : hooks_(hooks), waiting_(hooks.size()) {}

std::vector<std::size_t> Outbox::Add(const Event& event, std::int64_t unix_ms) {
  std::vector<std::size_t> overflowing;
  for (std::size_t i = 0; i < hooks_.size(); ++i) {
    if (!hooks_[i].Wants(event.name)) continue;
    if (waiting_[i].size() >= kMostWaiting) {
      waiting_[i].pop_front();
      ++dropped_;
      overflowing.push_back(i);
    }
    waiting_[i].push_back({event, unix_ms, 0});
  }
  return overflowing;
}

bool Outbox::IsDue(const Waiting& waiting, std::int64_t unix_ms) {
  return waiting.due_ms <= unix_ms || waiting.due_ms - unix_ms > kLongestWait_ms;
}

std::optional<Outbox::Delivery> Outbox::Due(std::int64_t unix_ms) const {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    if (waiting_[i].empty() || !IsDue(waiting_[i].front(), unix_ms)) continue;
    if (!first || waiting_[i].front().due_ms < waiting_[*first].front().due_ms) first = i;
  }
  if (!first) return std::nullopt;
  const Waiting& next = waiting_[*first].front();
  return Delivery{*first, next.event, next.tries};
}

std::optional<std::int64_t> Outbox::NextDue() const {
  std::optional<std::int64_t> next;
  for (const auto& of_hook : waiting_) {
    if (of_hook.empty()) continue;
    next = std::min(next.value_or(of_hook.front().due_ms), of_hook.front().due_ms);
  }
  return next;
}

Outbox::Waiting* Outbox::Find(const Delivery& delivery) {
  auto& of_hook = waiting_.at(delivery.hook);
  // It may have been dropped meanwhile.
  const bool is_first = !of_hook.empty() && of_hook.front().event.id == delivery.event.id;
  return is_first ? &of_hook.front() : nullptr;
}

void Outbox::Arrived(const Delivery& delivery) {
  if (Find(delivery) != nullptr) waiting_[delivery.hook].pop_front();
}

bool Outbox::Failed(const Delivery& delivery, std::int64_t unix_ms) {
  Waiting* const waiting = Find(delivery);
  if (waiting == nullptr) return false;
  if (++waiting->tries >= kMostTries) {
    waiting_[delivery.hook].pop_front();
    ++dropped_;
    return false;
  }
  constexpr int kMostDoublings = 20;
  const std::int64_t wait_ms =
      std::min(kLongestWait_ms, kFirstWait_ms << std::min(waiting->tries - 1, kMostDoublings));
  waiting->due_ms = unix_ms + wait_ms;
  return true;
}

std::size_t Outbox::waiting() const {
  std::size_t sum = 0;
  for (const auto& of_hook : waiting_) sum += of_hook.size();
  return sum;
}

std::string Outbox::Text(const std::map<std::string, std::string>& seen) const {
  Json hooks = Json::object();
  for (std::size_t i = 0; i < hooks_.size(); ++i) {
    Json& list = hooks[hooks_[i].url] = Json::array();
    for (const Waiting& each : waiting_[i]) {
      list.push_back({{"id", each.event.id},
                      {"event", each.event.name},
                      {"body", each.event.body},
                      {"due_unix_ms", each.due_ms},
                      {"tries", each.tries}});
    }
  }
  return program::OneLine(Json{{"webhooks", 1}, {"waiting", hooks}, {"seen", seen}}) + "\n";
}

Result<Outbox::Kept> Outbox::Read(const std::vector<Hook>& hooks, const std::string& text) {
  Kept kept{Outbox(hooks), {}};
  try {
    const Json json = Json::parse(text);
    if (json.at("webhooks") != 1) throw std::out_of_range("another version");
    kept.seen = json.at("seen").get<std::map<std::string, std::string>>();
    for (std::size_t i = 0; i < hooks.size(); ++i) {
      const auto list = json.at("waiting").find(hooks[i].url);
      if (list == json.at("waiting").end()) continue;
      for (const Json& each : *list) {
        Waiting waiting;
        waiting.event = {each.at("id").get<std::string>(), each.at("event").get<std::string>(),
                         each.at("body").get<std::string>()};
        waiting.due_ms = each.at("due_unix_ms").get<std::int64_t>();
        waiting.tries = std::max(0, each.at("tries").get<int>());
        if (kept.outbox.waiting_[i].size() < kMostWaiting) {
          kept.outbox.waiting_[i].push_back(std::move(waiting));
        }
      }
    }
  } catch (const std::exception&) {
    return Fail(ErrorCode::kCorrupt,
                "expected what the console writes there: move the file away to begin anew");
  }
  return kept;
}

}  // namespace trailcast::webhooks
