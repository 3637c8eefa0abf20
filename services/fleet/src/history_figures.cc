#include "services/fleet/history_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <set>
#include <utility>

#include "services/base/csv_line.h"
#include "services/mission/orders.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using mission::Task;
using program::Json;

const char* NameOf(FiguresBy by) {
  return by == FiguresBy::kRobot ? "robot" : by == FiguresBy::kRoute ? "route" : "week";
}

bool Counts(const mission::Record& record) {
  return record.last.change > 0 && mission::HasEnded(record.last.state) &&
         record.last.state != mission::State::kRefused;
}

// Returns the tasks of following that were done to their end.
std::vector<Task> TasksDone(const mission::Record& record) {
  auto tasks = mission::ParseOrders(record.mission.orders).value_or(std::vector<Task>{});
  if (record.last.state != mission::State::kArrived) {
    tasks.resize(std::min<std::size_t>(tasks.size(), record.last.task));
  }
  std::erase_if(tasks, [](const Task& task) { return task.kind != Task::Kind::kFollow; });
  return tasks;
}

bool EndsWithItsRoute(const Task& task) {
  return task.backwards ? task.from_m == 0.0 : task.to_m == 0.0;
}

double MetresOf(const Task& task, const std::map<std::string, double>& lengths_m) {
  const auto length_m = lengths_m.find(task.route.route);
  if (EndsWithItsRoute(task) && length_m == lengths_m.end()) return 0.0;
  const double end_m = EndsWithItsRoute(task) ? length_m->second : std::max(task.from_m, task.to_m);
  return task.laps * std::max(0.0, end_m - (task.backwards ? task.to_m : task.from_m));
}

std::string WeekOf(std::int64_t unix_ms) {
  const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
  std::tm local{};
  std::array<char, 32> text{};
  if (localtime_r(&seconds, &local) == nullptr) return "unknown";
  return {text.data(), std::strftime(text.data(), text.size(), "%G-W%V", &local)};
}

bool MakesStand(mission::NowOrder order) {
  using mission::NowOrder;
  return order == NowOrder::kPause || order == NowOrder::kStop || order == NowOrder::kCancel;
}

// Counts for each mission how often its robot was told to stand. Missions wait in queues, so a
// command is for the one that ended first after it.
std::map<const mission::Record*, std::size_t> StopsIn(
    const std::vector<mission::Record>& missions,
    const std::vector<mission::GivenCommand>& commands) {
  std::map<AgentId, std::multimap<std::int64_t, const mission::Record*>> by_end;
  for (const mission::Record& record : missions) {
    if (Counts(record)) by_end[record.mission.agent].emplace(record.changed_unix_ms, &record);
  }
  std::map<const mission::Record*, std::size_t> stops;
  for (const mission::GivenCommand& given : commands) {
    if (!MakesStand(given.command.order)) continue;
    for (const mission::NowAnswer& answer : given.answers) {
      const auto of_robot = by_end.find(answer.agent);
      if (answer.refused || of_robot == by_end.end()) continue;
      const auto ends_next = of_robot->second.lower_bound(given.given_unix_ms);
      if (ends_next == of_robot->second.end()) continue;
      if (ends_next->second->sent_unix_ms <= given.given_unix_ms) ++stops[ends_next->second];
    }
  }
  return stops;
}

// Returns nothing if nobody had to see to a robot.
std::optional<double> MetresEach(const HistoryFigures& figures) {
  if (figures.interventions == 0) return std::nullopt;
  return figures.metres / static_cast<double>(figures.interventions);
}

double ShareArrived(const HistoryFigures& figures) {
  return static_cast<double>(figures.arrived) / static_cast<double>(figures.missions);
}

}  // namespace

std::optional<FiguresBy> ReadFiguresBy(std::string_view word) {
  for (const FiguresBy by : {FiguresBy::kRobot, FiguresBy::kRoute, FiguresBy::kWeek}) {
    if (word == NameOf(by)) return by;
  }
  return std::nullopt;
}

std::set<std::string> RoutesToMeasure(const std::vector<mission::Record>& missions) {
  std::set<std::string> routes;
  for (const mission::Record& record : missions) {
    if (!Counts(record)) continue;
    for (const Task& task : TasksDone(record)) {
      if (EndsWithItsRoute(task)) routes.insert(task.route.route);
    }
  }
  return routes;
}

std::map<std::string, HistoryFigures> FiguresOf(const std::vector<mission::Record>& missions,
                                                const std::vector<mission::GivenCommand>& commands,
                                                const std::map<std::string, double>& lengths_m,
                                                FiguresBy by) {
  std::map<std::string, HistoryFigures> figures;
  const auto stops = StopsIn(missions, commands);
  for (const mission::Record& record : missions) {
    if (!Counts(record)) continue;
    const bool failed = record.last.state == mission::State::kFailed;
    const auto stopped = stops.find(&record);
    std::set<std::string> keys = mission::RoutesIn(record.mission.orders);
    if (by == FiguresBy::kRobot) keys = {record.mission.agent.value()};
    if (by == FiguresBy::kWeek) keys = {WeekOf(record.sent_unix_ms)};
    for (const std::string& key : keys) {
      HistoryFigures& of_key = figures[key];
      ++of_key.missions;
      of_key.arrived += record.last.state == mission::State::kArrived ? 1 : 0;
      of_key.interventions += (failed ? 1 : 0) + (stopped == stops.end() ? 0 : stopped->second);
      for (const Task& task : TasksDone(record)) {
        if (by == FiguresBy::kRoute && task.route.route != key) continue;
        of_key.metres += MetresOf(task, lengths_m);
      }
    }
  }
  return figures;
}

std::string FiguresTable(const std::map<std::string, HistoryFigures>& figures, FiguresBy by) {
  if (figures.empty()) return "no missions have ended\n";
  std::size_t width = 5;
  for (const auto& [key, each] : figures) width = std::max(width, key.size());
  std::string text =
      fmt::format("{:<{}}  {:>8}  {:>7}  {:>8}  {:>13}  {:>18}\n", NameOf(by), width, "missions",
                  "arrived", "km", "interventions", "m per intervention");
  for (const auto& [key, each] : figures) {
    const auto metres = MetresEach(each);
    text += fmt::format("{:<{}}  {:>8}  {:>5.0f} %  {:>8.3f}  {:>13}  {:>18}\n", key, width,
                        each.missions, 100.0 * ShareArrived(each), each.metres / 1000.0,
                        each.interventions, metres ? fmt::format("{:.0f}", *metres) : "-");
  }
  return text;
}

std::string FiguresCsv(const std::map<std::string, HistoryFigures>& figures, FiguresBy by) {
  std::string text = fmt::format(
      "{},missions,arrived,share_arrived,kilometres,interventions,metres_per_intervention\n",
      NameOf(by));
  for (const auto& [key, each] : figures) {
    const auto metres = MetresEach(each);
    text += fmt::format("{},{},{},{:.4f},{:.3f},{},{}\n", CsvText(key), each.missions, each.arrived,
                        ShareArrived(each), each.metres / 1000.0, each.interventions,
                        metres ? fmt::format("{:.1f}", *metres) : "");
  }
  return text;
}

Json FiguresJson(const std::map<std::string, HistoryFigures>& figures) {
  Json list = Json::array();
  for (const auto& [key, each] : figures) {
    list.push_back({{"name", key},
                    {"missions", each.missions},
                    {"arrived", each.arrived},
                    {"share_arrived", program::Rounded(ShareArrived(each), 1e4)},
                    {"kilometres", program::Rounded(each.metres / 1000.0, 1000.0)},
                    {"interventions", each.interventions},
                    {"metres_per_intervention", program::RoundedOrNull(MetresEach(each), 10.0)}});
  }
  return list;
}

}  // namespace trailcast::fleet
