#include "services/fleet/schedule_client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "services/base/time.h"
#include "services/fleet/draw.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using program::Json;
using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

// Other servers answer within this time of the first.
constexpr milliseconds kOthersAnswer{1000};
constexpr milliseconds kAskAllAgain{500};
constexpr milliseconds kListen{100};

using Replies = std::map<AgentId, exchange::NetworkReply>;

// Returns the page from that line on of each server that answers.
Replies AskForPage(exchange::RouteExchange& exchange, const AgentId& client, std::uint32_t first,
                   std::size_t servers, milliseconds timeout) {
  const exchange::NetworkRequest question{.client = client,
                                          .request = DrawNumber(),
                                          .words = std::string(schedule::kQuestion),
                                          .first = first};
  Replies replies;
  auto until = SteadyClock::now() + timeout;
  auto ask_at = SteadyClock::now();
  while (SteadyClock::now() < until && replies.size() < servers) {
    if (SteadyClock::now() >= ask_at) {
      ask_at = SteadyClock::now() + kAskAllAgain;
      (void)exchange.Publish(question);  // repeated if it could not be sent
    }
    for (exchange::Message& message : exchange.Take(kListen)) {
      auto* reply = std::get_if<exchange::NetworkReply>(&message);
      if (reply == nullptr || reply->client != client || reply->request != question.request) {
        continue;
      }
      if (replies.empty()) until = std::min(until, SteadyClock::now() + kOthersAnswer);
      replies.try_emplace(reply->server, std::move(*reply));
    }
  }
  return replies;
}

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

Json WhenJson(const schedule::Schedule& schedule) {
  Json at = Json::array();
  for (const int minutes : schedule.at_min) at.push_back(schedule::ClockText(minutes));
  Json days = Json::array();
  for (const int day : schedule.days) days.push_back(schedule::DayText(day));
  const bool is_whole_day = schedule.from_min == 0 && schedule.until_min == schedule::kMinutesADay;
  const bool has_period = schedule.every_min > 0 && !is_whole_day;
  const auto clock_or_null = [&](int minutes) {
    return has_period ? Json(schedule::ClockText(minutes)) : Json(nullptr);
  };
  return {{"at", std::move(at)},
          {"every_min", schedule.every_min > 0 ? Json(schedule.every_min) : Json(nullptr)},
          {"from", clock_or_null(schedule.from_min)},
          {"until", clock_or_null(schedule.until_min)},
          {"days", std::move(days)},
          {"once", schedule.once ? Json(fmt::format("{:04}-{:02}-{:02}", schedule.once->year,
                                                    schedule.once->month, schedule.once->day))
                                 : Json(nullptr)}};
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
          {"times", WhenJson(schedule)},
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
  KnownSchedules known;
  std::map<AgentId, std::vector<std::string>> lines;
  std::string refused;
  std::uint32_t first = 0;
  std::size_t servers = std::size_t{1} << 16U;  // nobody knows how many there are
  while (servers > 0) {
    Replies replies = AskForPage(exchange, client, first, servers, timeout);
    std::size_t with_more = 0;
    std::uint32_t next = 0;
    for (auto& [server, reply] : replies) {
      if (!reply.error.empty()) {
        refused = fmt::format("server '{}' {}", server.value(), reply.error);
        continue;
      }
      std::move(reply.lines.begin(), reply.lines.end(), std::back_inserter(lines[server]));
      if (reply.next <= first) continue;
      ++with_more;
      next = std::max(next, reply.next);
    }
    servers = with_more;
    first = next;
  }
  if (lines.empty() && !refused.empty()) return Fail(ErrorCode::kUnavailable, "{}", refused);
  if (lines.empty()) {
    return Fail(ErrorCode::kUnavailable,
                "no route server answered within {:.1f} s: is trailcast-server running, with the "
                "same domain, tag and network interface?",
                Seconds(timeout));
  }
  for (const auto& [server, told] : lines) {
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

std::vector<Firing> CalendarOf(const std::vector<KnownSchedule>& schedules,
                               std::int64_t now_unix_ms, int days) {
  constexpr std::int64_t kDay_ms = 86'400'000;
  std::vector<Firing> firings;
  for (const KnownSchedule& known : schedules) {
    const schedule::Schedule& schedule = known.listed.schedule;
    if (!known.listed.paused_by.empty()) continue;
    for (const std::int64_t unix_ms :
         Upcoming(schedule, now_unix_ms, now_unix_ms + days * kDay_ms, kMostFirings)) {
      firings.push_back({unix_ms, schedule::TextIn(schedule.zone, unix_ms), schedule.name});
    }
  }
  std::sort(firings.begin(), firings.end(), [](const Firing& one, const Firing& other) {
    return std::tie(one.unix_ms, one.schedule) < std::tie(other.unix_ms, other.schedule);
  });
  firings.resize(std::min(firings.size(), kMostFirings));
  return firings;
}

std::string CalendarText(const std::vector<Firing>& firings) {
  if (firings.empty()) return "nothing is due in that time\n";
  std::string text;
  for (const Firing& each : firings) text += fmt::format("{}  {}\n", each.text, each.schedule);
  return text;
}

Json CalendarJson(const std::vector<Firing>& firings) {
  Json all = Json::array();
  for (const Firing& each : firings) {
    all.push_back({{"unix_ms", each.unix_ms}, {"text", each.text}, {"schedule", each.schedule}});
  }
  return all;
}

Json PreviewJson(const schedule::Schedule& schedule, std::int64_t now_unix_ms) {
  constexpr std::size_t kMostShown = 10;
  constexpr std::int64_t kYear_ms = 366 * 86'400'000LL;
  std::vector<Firing> firings;
  for (const std::int64_t unix_ms :
       Upcoming(schedule, now_unix_ms, now_unix_ms + kYear_ms, kMostShown)) {
    firings.push_back({unix_ms, schedule::TextIn(schedule.zone, unix_ms), schedule.name});
  }
  return {{"when", WhenText(schedule)},
          {"words", ToText(schedule)},
          {"firings", CalendarJson(firings)}};
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
