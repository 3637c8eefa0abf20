#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/mission/mission.h"
#include "services/mission/now.h"

namespace trailcast::fleet {

enum class FiguresBy : std::uint8_t { kRobot, kRoute, kWeek };
[[nodiscard]] std::optional<FiguresBy> ReadFiguresBy(std::string_view word);  // "robot"

// Figures of the missions of a robot, on a route or in a week. They count missions that a robot has
// taken and that have ended. By route, a mission counts for each route that its orders name.
struct HistoryFigures {
  std::size_t missions = 0;
  std::size_t arrived = 0;
  // The metres of the orders that were done to their end. An order that was broken off counts as
  // nothing, because no server knows how far the robot came.
  double metres = 0.0;
  // How often a person had to see to a robot: missions that failed, and commands to pause, stop or
  // cancel that a robot obeyed during a mission. A command counts for the mission that ended next.
  std::size_t interventions = 0;
};

// Returns the routes whose length the figures need, because orders lead to their ends.
[[nodiscard]] std::set<std::string> RoutesToMeasure(const std::vector<mission::Record>& missions);
// Returns figures by the name of the robot or route, or by the week in which missions were sent
// ("2026-W48", by ISO 8601, in this machine's time zone). `lengths_m` are the routes' lengths; a
// route that is not in it counts as nothing.
[[nodiscard]] std::map<std::string, HistoryFigures> FiguresOf(
    const std::vector<mission::Record>& missions,
    const std::vector<mission::GivenCommand>& commands,
    const std::map<std::string, double>& lengths_m, FiguresBy by);

// These make a table for people, lines for spreadsheets, and an array of objects for programs.
[[nodiscard]] std::string FiguresTable(const std::map<std::string, HistoryFigures>& figures,
                                       FiguresBy by);
[[nodiscard]] std::string FiguresCsv(const std::map<std::string, HistoryFigures>& figures,
                                     FiguresBy by);
[[nodiscard]] nlohmann::ordered_json FiguresJson(
    const std::map<std::string, HistoryFigures>& figures);

}  // namespace trailcast::fleet
