#include "services/console/src/history_api.h"

#include <fmt/format.h>

#include "services/console/parameters.h"
#include "services/console/src/answers.h"
#include "services/fleet/mission_client.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

void Missions(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadMissionQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Missions(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200,
         fmt::format("{{\"missions\": {}, \"next\": {}}}", fleet::MissionsJson(reply->missions),
                     reply->next));
}

void Commands(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadCommandQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Commands(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200,
         fmt::format("{{\"commands\": {}, \"next\": {}}}", fleet::CommandsJson(reply->commands),
                     reply->next));
}

}  // namespace

void ServeHistory(http::Server& server, Desk& desk) {
  server.Get("/api/missions", [&desk](const Request& request, Response& response) {
    Missions(desk, request, response);
  });
  server.Get("/api/commands", [&desk](const Request& request, Response& response) {
    Commands(desk, request, response);
  });
}

}  // namespace trailcast::console
