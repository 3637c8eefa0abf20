#pragma once

#include <chrono>
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

// Returns a table for people, and an array of objects for programs.
[[nodiscard]] std::string SchedulesText(const std::vector<KnownSchedule>& schedules);
[[nodiscard]] nlohmann::ordered_json SchedulesJson(const std::vector<KnownSchedule>& schedules);

}  // namespace trailcast::fleet
