#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/route_exchange.h"
#include "services/schedule/listed.h"

namespace trailcast::fleet {

// This is a schedule, and the server that keeps it.
struct KnownSchedule {
  AgentId server{};
  schedule::Listed listed{};
};

struct KnownSchedules {
  std::vector<AgentId> servers{};  // those that keep any, or would, by name
  std::vector<KnownSchedule> schedules{};
};

// Returns the schedules of all servers that answer within a second after the first. Fails with
// kUnavailable if none answers within `timeout`, or if those that do keep no schedules.
[[nodiscard]] Result<KnownSchedules> AskForSchedules(exchange::RouteExchange& exchange,
                                                     const AgentId& client,
                                                     std::chrono::milliseconds timeout);

// Returns the server that an edit is for: the one that keeps the schedule or, for one that is
// added, the first. Fails with kNotFound if there is no such schedule, and with kConflict if
// another one has the name.
[[nodiscard]] Result<AgentId> ServerFor(const KnownSchedules& known, const schedule::Edit& edit);

// This is a time at which a schedule is due.
struct Firing {
  std::int64_t unix_ms = 0;
  std::string text{};  // in its own time zone
  std::string schedule{};
};
inline constexpr std::size_t kMostFirings = 1000;
inline constexpr int kCalendarDays = 28;
// Returns when schedules that are not paused are due next, the first first, in as many days, and at
// most kMostFirings.
[[nodiscard]] std::vector<Firing> CalendarOf(const std::vector<KnownSchedule>& schedules,
                                             std::int64_t now_unix_ms, int days);
[[nodiscard]] std::string CalendarText(const std::vector<Firing>& firings);
[[nodiscard]] nlohmann::ordered_json CalendarJson(const std::vector<Firing>& firings);
// Returns a schedule that nobody keeps yet, and when it would be due.
[[nodiscard]] nlohmann::ordered_json PreviewJson(const schedule::Schedule& schedule,
                                                 std::int64_t now_unix_ms);

// Returns a table for people, and an array of objects for programs.
[[nodiscard]] std::string SchedulesText(const std::vector<KnownSchedule>& schedules);
[[nodiscard]] nlohmann::ordered_json SchedulesJson(const std::vector<KnownSchedule>& schedules);

}  // namespace trailcast::fleet
