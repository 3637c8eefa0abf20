#include "services/console/src/api/snapshots_api.h"

#include <atomic>
#include <memory>
#include <string>

#include "services/console/src/api/answers.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

// Makes a robot's text fit for a header.
std::string Printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

void Look(Desk& desk, const std::string& robot, Response& response) {
  const auto seen = desk.Look(AgentId(robot));
  if (!seen) return Refuse(response, seen.error());
  if (*seen == nullptr) {
    return Refuse(response, 504,
                  robot + " shows no picture: it is out of reach, or does not let others look");
  }
  const exchange::Snapshot& snapshot = **seen;
  if (snapshot.picture.empty()) return Refuse(response, 404, snapshot.detail);
  response.set_header("Cache-Control", "no-store");
  response.set_header("Trailcast-Seen", Printable(snapshot.detail));
  response.set_header("Trailcast-Marked", snapshot.marked ? "1" : "0");
  response.set_content(reinterpret_cast<const char*>(snapshot.picture.data()),
                       snapshot.picture.size(), "image/jpeg");
}

}  // namespace

void ServeSnapshots(http::Server& server, Desk& desk) {
  const auto lookers = std::make_shared<std::atomic<int>>(0);
  server.Get("/api/robots/([A-Za-z0-9_.-]{1,64})/snapshot",
             [lookers, &desk](const Request& request, Response& response) {
               const std::shared_ptr<void> seat(nullptr, [&](void*) { --*lookers; });
               if (++*lookers > kMostLookers) {
                 return Refuse(response, 503, "too many look through robots' cameras: wait");
               }
               Look(desk, request.matches[1], response);
             });
}

}  // namespace trailcast::console
