#include "services/console/src/api/history_api.h"

#include "services/base/unix_time.h"
#include "services/console/network_watch.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/network_client.h"
#include "services/network/changes.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::OneLine;

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

// Of routes and of how they are joined.
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
  server.Get("/api/commands", [&desk](const Request& request, Response& response) {
    Commands(desk, request, response);
  });
  server.Get("/api/changes", [&desk](const Request& request, Response& response) {
    Changes(desk, request, response);
  });
}

}  // namespace trailcast::console
