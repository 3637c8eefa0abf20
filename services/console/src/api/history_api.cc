#include "services/console/src/api/history_api.h"

#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/base/unix_time.h"
#include "services/console/network_watch.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/exchange/bounds.h"
#include "services/fleet/history_figures.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/network_client.h"
#include "services/network/changes.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::OneLine;

// A server answers with 100 at a time, so this limits an answer's cost.
constexpr std::size_t kMostInFigures = 5000;

void Missions(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadMissionQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Missions(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200,
         OneLine({{"missions", fleet::MissionsJson(reply->missions)}, {"next", reply->next}}));
}

void Commands(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadCommandQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Commands(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200,
         OneLine({{"commands", fleet::CommandsJson(reply->commands)}, {"next", reply->next}}));
}

// Asks for page after page, up to as many records as one answer may cost.
template <typename Record, typename Ask>
Result<std::vector<Record>> AskForAll(mission::Query query,
                                      std::vector<Record> exchange::MissionReply::*records,
                                      const Ask& ask) {
  std::vector<Record> all;
  query.page_size = exchange::kMaxMissionsPerReply;
  do {
    auto reply = ask(query);
    if (!reply) return tl::unexpected(reply.error());
    auto& page = (*reply).*records;
    std::move(page.begin(), page.end(), std::back_inserter(all));
    query.before = reply->next;
  } while (query.before != 0 && all.size() < kMostInFigures);
  if (query.before == 0) return all;
  return Fail(ErrorCode::kUnavailable,
              "more than {} are kept since then: say a later from_unix_ms, or ask 'trailcast "
              "missions --by'",
              kMostInFigures);
}

Result<std::map<std::string, double>> Measure(Desk& desk, const std::set<std::string>& routes) {
  std::map<std::string, double> lengths_m;
  for (const std::string& route : routes) {
    route::RouteQuery query;
    query.name = route;
    const auto reply = desk.Routes(query);
    if (!reply) return tl::unexpected(reply.error());
    for (const route::RouteInfo& info : reply->page.routes) {
      if (info.standing == route::Standing::kActive) lengths_m[route] = info.length_m;
    }
  }
  return lengths_m;
}

void Figures(Desk& desk, const Request& request, Response& response) {
  auto parameters = request.params;
  const auto take = [&](const char* name) {
    const std::string text = request.get_param_value(name);
    parameters.erase(name);
    return text;
  };
  const std::string word = take("group");
  const std::string format = take("format");
  const auto by = fleet::ReadFiguresBy(word.empty() ? "robot" : word);
  if (!by) return Refuse(response, 400, "'group' is to be robot, route or week");
  if (!format.empty() && format != "csv" && format != "json") {
    return Refuse(response, 400, "'format' is to be csv or json");
  }
  const auto query = ReadMissionQuery(parameters);
  if (!query) return Refuse(response, query.error());
  const auto missions = AskForAll(*query, &exchange::MissionReply::missions,
                                  [&](const auto& page) { return desk.Missions(page); });
  if (!missions) return Refuse(response, missions.error());
  mission::Query of_commands;
  of_commands.from_unix_ms = query->from_unix_ms;
  of_commands.until_unix_ms = query->until_unix_ms;
  const auto commands = AskForAll(of_commands, &exchange::MissionReply::commands,
                                  [&](const auto& page) { return desk.Commands(page); });
  if (!commands) return Refuse(response, commands.error());
  const auto lengths_m = Measure(desk, fleet::RoutesToMeasure(*missions));
  if (!lengths_m) return Refuse(response, lengths_m.error());
  const auto figures = fleet::FiguresOf(*missions, *commands, *lengths_m, *by);
  if (format == "csv") return response.set_content(fleet::FiguresCsv(figures, *by), "text/csv");
  Answer(response, 200, OneLine({{"figures", fleet::FiguresJson(figures)}}));
}

// Answers with changes of routes and of how they are joined.
void Changes(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadChangesQuery(request.params, NowUnixMs());
  if (!query) return Refuse(response, query.error());
  const auto answer = AskForNetwork(desk, network::ChangesSince(query->since_unix_ms));
  if (!answer) return Refuse(response, answer.error());
  if (!answer->whole) {
    return Refuse(response, 503, "more was changed since then than is taken in: say a later time");
  }
  const network::History history = network::ParseHistory(answer->lines);
  Answer(response, 200,
         OneLine({{"since_unix_ms", query->since_unix_ms},
                  {"history", fleet::ChangesJson(history, query->limit, query->routes)}}));
}

}  // namespace

void ServeHistory(http::Server& server, Desk& desk) {
  server.Get("/api/missions", [&desk](const Request& request, Response& response) {
    Missions(desk, request, response);
  });
  server.Get("/api/figures", [&desk](const Request& request, Response& response) {
    Figures(desk, request, response);
  });
  server.Get("/api/commands", [&desk](const Request& request, Response& response) {
    Commands(desk, request, response);
  });
  server.Get("/api/changes", [&desk](const Request& request, Response& response) {
    Changes(desk, request, response);
  });
}

}  // namespace trailcast::console
