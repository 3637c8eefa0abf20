#include "services/webhooks/event.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <random>
#include <string_view>
#include <utility>

#include "services/program/json.h"

namespace trailcast::webhooks {
namespace {

using program::Json;

// This key has no alert or mission, but when the first look was.
constexpr const char* kBegan = "began_unix_ms";

std::string DrawId() {
  std::random_device random;
  std::string id;
  for (int i = 0; i < 4; ++i) id += fmt::format("{:08x}", random());
  return id;
}

std::string KeyOf(std::string_view kind, const Json& each) {
  if (kind == "alert") return fmt::format("alert {}", each.at("alert").get<std::string>());
  return fmt::format("mission {} {}", each.at("robot").get<std::string>(),
                     each.at("mission").get<std::string>());
}

std::string StateOf(std::string_view kind, const Json& each) {
  if (kind == "mission") {
    std::string state = each.at("state").get<std::string>();
    std::replace(state.begin(), state.end(), ' ', '-');
    return state;
  }
  if (!each.at("ended_unix_ms").is_null()) return "ended";
  return each.at("acknowledged_by").is_null() ? "began" : "acknowledged";
}

std::int64_t TimeIn(const Json& json, const char* name) {
  return json.at(name).is_null() ? 0 : json.at(name).get<std::int64_t>();
}

std::int64_t ChangedAt(std::string_view kind, const Json& each) {
  if (kind == "mission") return TimeIn(each, "changed_unix_ms");
  return std::max({TimeIn(each, "since_unix_ms"), TimeIn(each, "acknowledged_unix_ms"),
                   TimeIn(each, "ended_unix_ms")});
}

}  // namespace

std::int64_t EventFinder::Began(std::int64_t unix_ms) {
  const auto [began, is_new] = seen_.try_emplace(kBegan, fmt::format("{}", unix_ms));
  std::int64_t ms = unix_ms;
  const std::string& text = began->second;
  std::from_chars(text.data(), text.data() + text.size(), ms);
  return ms;
}

void EventFinder::Compare(const char* kind, const Json& list, std::int64_t unix_ms,
                          std::vector<Event>& events) {
  const std::int64_t began_ms = Began(unix_ms);
  std::map<std::string, std::string> now;
  for (const Json& each : list) {
    const std::string key = KeyOf(kind, each);
    const std::string state = StateOf(kind, each);
    const auto before = seen_.find(key);
    const bool is_news =
        before == seen_.end() ? ChangedAt(kind, each) > began_ms : before->second != state;
    now.emplace(key, state);
    if (!is_news) continue;
    Event event{DrawId(), fmt::format("{}.{}", kind, state), {}};
    event.body = program::OneLine(
        Json{{"id", event.id}, {"event", event.name}, {"unix_ms", unix_ms}, {kind, each}});
    events.push_back(std::move(event));
  }
  // Alerts and missions that are not listed may be again, as after a restart.
  const bool forgets = seen_.size() > kMostSeen;
  std::erase_if(seen_, [&](const auto& entry) {
    return now.contains(entry.first) || (forgets && entry.first.starts_with(kind));
  });
  seen_.merge(now);
}

std::vector<Event> EventFinder::Look(const Json& alerts, const Json& missions,
                                     std::int64_t unix_ms) {
  std::vector<Event> events;
  if (alerts.is_array()) Compare("alert", alerts, unix_ms, events);
  if (missions.is_array()) Compare("mission", missions, unix_ms, events);
  return events;
}

}  // namespace trailcast::webhooks
