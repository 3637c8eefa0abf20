#include "services/fleet/schedule_client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "services/fleet/src/ask_all.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using program::Json;
using std::chrono::milliseconds;

std::string WhatBecame(const schedule::Listed& listed) {
  if (!listed.outcome.empty()) return "nobody was sent: " + listed.outcome;
  std::vector<std::string> each;
  for (const schedule::Listed::Sent& sent : listed.sent) {
    each.push_back(fmt::format("{} {}", sent.robot, sent.outcome));
  }
  return each.empty() ? "-" : fmt::format("{}", fmt::join(each, "; "));
}

std::string NextText(const schedule::Listed& listed) {
  if (!listed.paused_by.empty()) return "paused by " + listed.paused_by;
  return listed.next_unix_ms ? schedule::TextIn(listed.schedule.zone, *listed.next_unix_ms)
                             : "never again";
}

Json MomentJson(const std::string& zone, const std::optional<std::int64_t>& unix_ms) {
  if (!unix_ms) return nullptr;
  return {{"unix_ms", *unix_ms}, {"text", schedule::TextIn(zone, *unix_ms)}};
}

Json ScheduleJson(const KnownSchedule& known) {
  const schedule::Listed& listed = known.listed;
  const schedule::Schedule& schedule = listed.schedule;
  Json sent = Json::array();
  for (const schedule::Listed::Sent& each : listed.sent) {
    sent.push_back({{"robot", each.robot},
                    {"mission", each.mission.empty() ? Json(nullptr) : Json(each.mission)},
                    {"outcome", each.outcome}});
  }
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
  };
  return {{"name", schedule.name},
          {"server", known.server.value()},
          {"robots", schedule.robots},
          {"when", WhenText(schedule)},
          {"zone", schedule.zone},
          {"orders", schedule.orders},
          {"battery_percent",
           schedule.battery_percent ? Json(*schedule.battery_percent) : Json(nullptr)},
          {"unless_closed", schedule.unless_closed},
          {"if_arrived", schedule.if_arrived},
          {"missed", schedule.missed == schedule::Missed::kOnce ? "once" : "skip"},
          {"valid_s", schedule.valid_s},
          {"goes_on", schedule.goes_on},
          {"by", listed.by},
          {"paused_by", text_or_null(listed.paused_by)},
          {"next", MomentJson(schedule.zone, listed.next_unix_ms)},
          {"last", MomentJson(schedule.zone, listed.last_unix_ms)},
          {"outcome", text_or_null(listed.outcome)},
          {"sent", std::move(sent)},
          {"words", ToText(schedule)}};
}

}  // namespace

Result<KnownSchedules> AskForSchedules(exchange::RouteExchange& exchange, const AgentId& client,
                                       milliseconds timeout) {
  const auto lines = AskAllForLines(exchange, client, std::string(schedule::kQuestion), timeout);
  if (!lines) return tl::unexpected(lines.error());
  KnownSchedules known;
  for (const auto& [server, told] : *lines) {
    known.servers.push_back(server);
    for (schedule::Listed& listed : schedule::ParseLines(told)) {
      known.schedules.push_back({server, std::move(listed)});
    }
  }
  return known;
}

Result<AgentId> ServerFor(const KnownSchedules& known, const schedule::Edit& edit) {
  const std::string& name = edit.schedule.name;
  const auto kept =
      std::find_if(known.schedules.begin(), known.schedules.end(),
                   [&](const KnownSchedule& each) { return each.listed.schedule.name == name; });
  if (kept != known.schedules.end()) return kept->server;
  if (edit.kind == schedule::Edit::Kind::kAdd && !known.servers.empty()) {
    return known.servers.front();
  }
  std::vector<std::string> names;
  for (const KnownSchedule& each : known.schedules) names.push_back(each.listed.schedule.name);
  return Fail(
      ErrorCode::kNotFound, "no schedule is called '{}': {}", name,
      names.empty() ? "there are none" : fmt::format("there are {}", fmt::join(names, ", ")));
}

std::string SchedulesText(const std::vector<KnownSchedule>& schedules) {
  if (schedules.empty()) return "there are no schedules\n";
  std::string text;
  for (const auto& [server, listed] : schedules) {
    const schedule::Schedule& each = listed.schedule;
    text += fmt::format("{}  {}, {}: {}\n", each.name, WhenText(each), fmt::join(each.robots, ","),
                        each.orders);
    text += fmt::format("  next  {}\n", NextText(listed));
    if (!listed.last_unix_ms) continue;
    text += fmt::format("  last  {}  {}\n", schedule::TextIn(each.zone, *listed.last_unix_ms),
                        WhatBecame(listed));
  }
  return text;
}

Json SchedulesJson(const std::vector<KnownSchedule>& schedules) {
  Json all = Json::array();
  for (const KnownSchedule& each : schedules) all.push_back(ScheduleJson(each));
  return all;
}

}  // namespace trailcast::fleet
