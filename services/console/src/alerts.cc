#include "services/console/alerts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "services/base/ids.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using program::Json;

Json Shown(const Alert& alert) {
  const Cause& cause = alert.cause;
  const bool acknowledged = !alert.acknowledged_by.empty();
  return {{"alert", alert.id},
          {"kind", cause.kind},
          {"severity", cause.alarm ? "alarm" : "warning"},
          {"robot", cause.of_server ? Json(nullptr) : Json(cause.subject)},
          {"server", cause.of_server ? Json(cause.subject) : Json(nullptr)},
          {"reason", cause.reason},
          {"place", cause.place},
          {"action", cause.action},
          {"known", alert.known},
          {"since_unix_ms", alert.since_unix_ms},
          {"acknowledged_by", acknowledged ? Json(alert.acknowledged_by) : Json(nullptr)},
          {"acknowledged_unix_ms", acknowledged ? Json(alert.acknowledged_unix_ms) : Json(nullptr)},
          {"ended_unix_ms", alert.open() ? Json(nullptr) : Json(alert.ended_unix_ms)}};
}

// Returns an empty text if there is none of this name.
std::string TextIn(const Json& json, const char* name) {
  const auto text = json.find(name);
  return text != json.end() && text->is_string() ? text->get<std::string>() : "";
}

std::int64_t TimeIn(const Json& json, const char* name) {
  const auto time = json.find(name);
  if (time == json.end() || !time->is_number_unsigned()) return 0;
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(time->get<std::uint64_t>(), kMost));
}

Result<Alert> AlertIn(const Json& json) {
  const auto wrong = [] {
    return Fail(ErrorCode::kCorrupt, "expected alerts as the console writes them");
  };
  if (!json.is_object()) return wrong();
  Alert alert;
  const std::string server = TextIn(json, "server");
  alert.id = TextIn(json, "alert");
  alert.cause = {.kind = TextIn(json, "kind"),
                 .subject = server.empty() ? TextIn(json, "robot") : server,
                 .of_server = !server.empty(),
                 .alarm = TextIn(json, "severity") == "alarm",
                 .reason = TextIn(json, "reason"),
                 .place = TextIn(json, "place"),
                 .action = TextIn(json, "action")};
  alert.since_unix_ms = TimeIn(json, "since_unix_ms");
  alert.acknowledged_by = TextIn(json, "acknowledged_by");
  alert.acknowledged_unix_ms = TimeIn(json, "acknowledged_unix_ms");
  alert.ended_unix_ms = TimeIn(json, "ended_unix_ms");
  alert.known = !alert.open();
  if (alert.id.empty() || alert.cause.kind.empty() || !IsValidName(alert.cause.subject)) {
    return wrong();
  }
  return alert;
}

}  // namespace

void Alerts::Note(const std::vector<Cause>& causes, const std::set<std::string>& subjects,
                  const std::set<std::string>& unsure, std::int64_t unix_ms) {
  using Name = std::pair<std::string_view, std::string_view>;
  const auto name_of = [](const Cause& cause) { return Name{cause.subject, cause.kind}; };
  std::map<Name, const Cause*> fresh;
  for (const Cause& cause : causes) fresh.emplace(name_of(cause), &cause);
  std::size_t open = 0;
  for (Alert& alert : alerts_) {
    if (!alert.open()) continue;
    ++open;
    const auto cause = fresh.find(name_of(alert.cause));
    if (cause != fresh.end()) {
      alert.known = true;
      if (alert.cause != *cause->second) {
        alert.cause = *cause->second;
        ++changes_;
      }
      fresh.erase(cause);
    } else if (subjects.contains(alert.cause.subject) &&
               (alert.known || !unsure.contains(alert.cause.subject))) {
      EndOne(alert, unix_ms);
      --open;
    }
  }
  for (const auto& [name, cause] : fresh) {
    if (open++ >= kMostOpen) break;
    alerts_.push_back({.id = fmt::format("{}.{}.{:x}", cause->subject, cause->kind, unix_ms),
                       .cause = *cause,
                       .since_unix_ms = unix_ms});
    ++changes_;
  }
  DropOld();
}

void Alerts::EndOne(Alert& alert, std::int64_t unix_ms) {
  alert.ended_unix_ms = std::max<std::int64_t>(unix_ms, 1);
  alert.known = true;
  ++changes_;
}

bool Alerts::End(const std::string& subject, std::int64_t unix_ms) {
  const std::uint64_t before = changes_;
  for (Alert& alert : alerts_) {
    if (alert.open() && alert.cause.subject == subject) EndOne(alert, unix_ms);
  }
  return changes_ != before;
}

void Alerts::DropOld() {
  auto ended = static_cast<std::size_t>(std::count_if(
      alerts_.begin(), alerts_.end(), [](const Alert& alert) { return !alert.open(); }));
  std::erase_if(alerts_, [&](const Alert& alert) {
    if (alert.open() || ended <= kMostEnded) return false;
    --ended;
    return true;
  });
}

Result<void> Alerts::Acknowledge(const std::string& id, const std::string& by,
                                 std::int64_t unix_ms) {
  const auto alert = std::find_if(alerts_.begin(), alerts_.end(),
                                  [&](const Alert& each) { return each.open() && each.id == id; });
  if (alert == alerts_.end()) {
    return Fail(ErrorCode::kNotFound, "there is no such alert, or its cause has ended");
  }
  if (!alert->acknowledged_by.empty()) return {};
  alert->acknowledged_by = by;
  alert->acknowledged_unix_ms = unix_ms;
  ++changes_;
  return {};
}

bool Alerts::IsOpen(const std::string& subject, const std::string& kind) const {
  return std::any_of(alerts_.begin(), alerts_.end(), [&](const Alert& alert) {
    return alert.open() && alert.cause.subject == subject && alert.cause.kind == kind;
  });
}

Json Alerts::OpenShown() const {
  Json shown = Json::array();
  for (auto alert = alerts_.rbegin(); alert != alerts_.rend(); ++alert) {
    if (alert->open()) shown.push_back(Shown(*alert));
  }
  return shown;
}

Json Alerts::AllShown() const {
  Json shown = Json::array();
  for (auto alert = alerts_.rbegin(); alert != alerts_.rend(); ++alert) {
    shown.push_back(Shown(*alert));
  }
  return shown;
}

std::string Alerts::Text() const { return program::Indented({{"alerts", AllShown()}}); }

Result<Alerts> Alerts::Read(const std::string& text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  const auto list = json.is_object() ? json.find("alerts") : json.end();
  if (!json.is_object() || list == json.end() || !list->is_array() ||
      list->size() > kMostEnded + kMostOpen) {
    return Fail(ErrorCode::kCorrupt, "expected {{\"alerts\": [..]}}, as the console writes it");
  }
  Alerts alerts;
  for (const Json& each : *list) {
    auto alert = AlertIn(each);
    if (!alert) return tl::unexpected(alert.error());
    alerts.alerts_.push_front(*std::move(alert));
  }
  return alerts;
}

}  // namespace trailcast::console
