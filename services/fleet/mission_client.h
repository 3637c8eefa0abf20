#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

struct SendWatch {
  std::chrono::milliseconds timeout{5000};  // for the first answer
  bool to_its_end = false;                  // watches the mission to its end, however long it takes
  std::function<bool()> stop = [] { return false; };
  std::function<void(const mission::Report&)> news = [](const mission::Report&) {};
};

// Sends the mission repeatedly until its robots have answered or, while one is out of reach, a
// server keeps it. Returns what is known of it then, of each robot or group that it is for. Fails
// with kUnavailable if nobody is heard, or if servers put it off.
[[nodiscard]] Result<std::vector<mission::Report>> SendMission(exchange::RouteExchange& exchange,
                                                               const mission::Mission& mission,
                                                               const SendWatch& watch);

// Returns at most `limit` missions, the newest first. Fails with kUnavailable if no server answers,
// or one that keeps no missions.
[[nodiscard]] Result<std::vector<mission::Record>> AskForMissions(
    exchange::RouteExchange& exchange, const AgentId& client, mission::Query query,
    std::size_t limit, std::chrono::milliseconds timeout);

// Returns commands to robots in the same way.
[[nodiscard]] Result<std::vector<mission::GivenCommand>> AskForCommands(
    exchange::RouteExchange& exchange, const AgentId& client, mission::Query query,
    std::size_t limit, std::chrono::milliseconds timeout);

// Sorts missions, the newest first, by robot: its present mission, and then those that wait for it,
// in the order of its queue.
void SortAsQueues(std::vector<mission::Record>& missions);

// Returns "robot1: under way: ..", without parts that are empty.
[[nodiscard]] std::string ReportText(const mission::Report& report);
// These return objects for programs, without line breaks.
[[nodiscard]] nlohmann::ordered_json ReportJson(const mission::Report& report);
[[nodiscard]] nlohmann::ordered_json MissionJson(const mission::Record& record);
// These return tables for people, and arrays of objects for programs.
[[nodiscard]] std::string MissionsTable(const std::vector<mission::Record>& missions,
                                        std::int64_t now_unix_ms);
[[nodiscard]] std::string CommandsTable(const std::vector<mission::GivenCommand>& commands,
                                        std::int64_t now_unix_ms);
[[nodiscard]] nlohmann::ordered_json CommandsJson(
    const std::vector<mission::GivenCommand>& commands);
[[nodiscard]] nlohmann::ordered_json MissionsJson(const std::vector<mission::Record>& missions);

}  // namespace trailcast::fleet
