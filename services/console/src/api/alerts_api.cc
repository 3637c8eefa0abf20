#include "services/console/src/api/alerts_api.h"

#include <string>

#include "services/console/src/api/answers.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

void List(Desk& desk, Response& response) {
  const auto alerts = desk.AllAlerts();
  if (!alerts) return Refuse(response, alerts.error());
  Answer(response, 200, program::OneLine({{"alerts", *alerts}, {"kept", desk.keeps_alerts()}}));
}

void Acknowledge(Desk& desk, const Access& access, const Request& request, Response& response) {
  const std::string user = access.WhoIs(request).name;
  const std::string by = user.empty() ? "console" : user;
  const std::string alert = request.matches[1];
  const auto acknowledged = desk.Acknowledge(alert, by);
  if (!acknowledged) return Refuse(response, acknowledged.error());
  Answer(response, 200, program::OneLine({{"alert", alert}}));
}

}  // namespace

void ServeAlerts(http::Server& server, Desk& desk, const Access& access) {
  server.Get("/api/alerts",
             [&desk](const Request& /*request*/, Response& response) { List(desk, response); });
  server.Post("/api/alerts/([A-Za-z0-9_.-]{1,160})/acknowledge",
              [&desk, &access](const Request& request, Response& response) {
                Acknowledge(desk, access, request, response);
              });
}

}  // namespace trailcast::console
