#include "services/console/src/api/routes/routes_api.h"

#include <utility>

#include "services/console/json.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

std::string PageBody(const exchange::CatalogReply& reply) {
  return program::OneLine({{"routes", fleet::RoutesJson(reply)},
                           {"total", reply.page.total},
                           {"next", reply.page.next},
                           {"similar", reply.similar_names}});
}

void Search(Desk& desk, const Request& request, Response& response) {
  const auto query = ReadRouteQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto reply = desk.Routes(*query);
  if (!reply) return Refuse(response, reply.error());
  Answer(response, 200, PageBody(*reply));
}

void Edit(Desk& desk, const Request& request, Response& response) {
  const auto edit = ReadRouteEdit(request.matches[1], request.body);
  if (!edit) return Refuse(response, edit.error());
  const auto reply = desk.Edit(*edit);
  if (!reply) return Refuse(response, reply.error());
  auto changed = program::Json::array();
  for (const route::RouteInfo& info : reply->page.routes) changed.push_back(fleet::RouteJson(info));
  Answer(response, 200, program::OneLine({{"changed", std::move(changed)}}));
}

}  // namespace

void ServeRoutes(http::Server& server, Desk& desk) {
  server.Get("/api/routes", [&desk](const Request& request, Response& response) {
    Search(desk, request, response);
  });
  server.Post(
      "/api/routes/([A-Za-z0-9_.-]{1,64})/edits",
      [&desk](const Request& request, Response& response) { Edit(desk, request, response); });
}

}  // namespace trailcast::console
