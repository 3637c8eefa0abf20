#include "services/console/src/api/network_api.h"

#include <spdlog/spdlog.h>

#include "services/console/json.h"
#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/fleet/network_client.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;
using program::OneLine;

void List(NetworkWatch& watch, const Request& request, Response& response) {
  const auto query = ReadNetworkQuery(request.params);
  if (!query) return Refuse(response, query.error());
  const auto list = watch.Now();
  if (!list) return Refuse(response, list.error());
  Answer(response, 200, (*list)->Body(*query));
}

void FindWay(Desk& desk, const Request& request, Response& response) {
  const auto question = ReadWayQuestion(request.params);
  if (!question) return Refuse(response, question.error());
  const auto answer = AskForNetwork(desk, *question);
  if (!answer) return Refuse(response, answer.error());
  const auto orders = fleet::OrdersAlong(answer->lines, request.get_param_value("to"));
  if (!orders) return Refuse(response, 409, orders.error().message);
  Answer(response, 200, OneLine({{"way", fleet::WayJson(answer->lines)}, {"orders", *orders}}));
}

void Change(Desk& desk, NetworkWatch& watch, const std::string& who, const Request& request,
            Response& response) {
  const auto words = ReadNetworkEdit(request.body);
  if (!words) return Refuse(response, words.error());
  const auto reply = desk.Join(*words);
  watch.Changed();  // the answer to an edit that was made may be lost
  if (!reply) return Refuse(response, reply.error());
  spdlog::info("console: {}{}{}", who, who.empty() ? "" : ": ", *words);
  Answer(response, 200, OneLine({{"now", reply->lines}}));
}

}  // namespace

void ServeNetwork(http::Server& server, Desk& desk, NetworkWatch& watch, const Access& access) {
  server.Get("/api/network", [&watch](const Request& request, Response& response) {
    List(watch, request, response);
  });
  server.Get("/api/network/way", [&desk](const Request& request, Response& response) {
    FindWay(desk, request, response);
  });
  server.Post("/api/network/edits",
              [&desk, &watch, &access](const Request& request, Response& response) {
                Change(desk, watch, access.WhoIs(request).name, request, response);
              });
}

}  // namespace trailcast::console
