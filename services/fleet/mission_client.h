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
  bool to_its_end = false;                  // after that, however long it takes
  std::function<bool()> stop = [] { return false; };
  std::function<void(const mission::Report&)> news = [](const mission::Report&) {};
};

// Says it again until the robot has answered, or, as long as that is out of reach, a server keeps
// it; returns what is known of it then. kUnavailable where neither is heard, or servers put it off.
[[nodiscard]] Result<mission::Report> SendMission(exchange::RouteExchange& exchange,
                                                  const mission::Mission& mission,
                                                  const SendWatch& watch);

// At most `limit`, the newest first. kUnavailable where no server answers, or one that keeps none.
[[nodiscard]] Result<std::vector<mission::Record>> AskForMissions(
    exchange::RouteExchange& exchange, const AgentId& client, mission::Query query,
    std::size_t limit, std::chrono::milliseconds timeout);

// The same of what robots were told to do now.
[[nodiscard]] Result<std::vector<mission::GivenCommand>> AskForCommands(
    exchange::RouteExchange& exchange, const AgentId& client, mission::Query query,
    std::size_t limit, std::chrono::milliseconds timeout);

// Sorts missions, the newest first, by robot: its present mission, and then those that wait for it,
// in the order of its queue.
void SortAsQueues(std::vector<mission::Record>& missions);

// "robot1: under way: ..", without what there is not to say.
[[nodiscard]] std::string ReportText(const mission::Report& report);
// Objects for programs, without line breaks.
[[nodiscard]] nlohmann::ordered_json ReportJson(const mission::Report& report);
[[nodiscard]] nlohmann::ordered_json MissionJson(const mission::Record& record);
// A table for people, and an array of objects for programs.
[[nodiscard]] std::string MissionsTable(const std::vector<mission::Record>& missions,
                                        std::int64_t now_unix_ms);
[[nodiscard]] std::string CommandsTable(const std::vector<mission::GivenCommand>& commands,
                                        std::int64_t now_unix_ms);
[[nodiscard]] nlohmann::ordered_json CommandsJson(
    const std::vector<mission::GivenCommand>& commands);
[[nodiscard]] nlohmann::ordered_json MissionsJson(const std::vector<mission::Record>& missions);

}  // namespace trailcast::fleet
