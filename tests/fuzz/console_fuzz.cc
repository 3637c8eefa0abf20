// Requests to the console: their bodies, and what stands behind their question mark; its file of
// users, and the files of its site; what a server lists of its network.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "services/base/text.h"
#include "services/console/json.h"
#include "services/console/network_list.h"
#include "services/console/parameters.h"
#include "services/console/site.h"
#include "services/exchange/bounds.h"
#include "services/schedule/listed.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
using namespace trailcast;

namespace {

// Returns parameters as behind an address's question mark: "name=hall&tag=wet".
console::Parameters ParametersIn(const std::string& text) {
  console::Parameters parameters;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('&', at), text.size());
    const std::string one = text.substr(at, end - at);
    const std::size_t equals = std::min(one.find('='), one.size());
    parameters.emplace(one.substr(0, equals),
                       equals < one.size() ? one.substr(equals + 1) : std::string());
    at = end + 1;
  }
  return parameters;
}

// Returns lines as a server lists its network.
std::vector<std::string> LinesIn(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string body(reinterpret_cast<const char*>(data), size);
  if (const auto reason = console::ReadReason(body)) {
    Require(IsPlainText(*reason, exchange::kMaxLineBytes), "a reason is one line");
    exchange::NowCommand command;
    command.client = AgentId("desk");
    command.number = 1;
    command.reason = *reason;
    Require(exchange::CheckBounds(command).has_value(), "a command with it may be published");
  }
  Require(IsPlainText(console::ReasonIfAny(body), exchange::kMaxLineBytes), "so is a stop's");
  if (const auto send = console::ReadSend(body)) {
    mission::Mission mission;
    mission.agent = AgentId("robot1");
    mission.id = send->id.empty() ? "drawn" : send->id;
    mission.client = AgentId("desk");
    mission.orders = send->orders;
    mission.valid_for_s = send->valid_s;
    Require(exchange::CheckBounds(mission).has_value(), "a mission may be published");
  }
  (void)console::ReadLogIn(body);
  if (const auto word = console::ReadDrive(body)) {
    const exchange::DriveCommand command{.agent = AgentId("robot1"),
                                         .client = AgentId("desk"),
                                         .linear_mps = word->linear_mps,
                                         .turn_radps = word->turn_radps};
    Require(exchange::CheckBounds(command).has_value(), "a robot may be driven so");
    Require(IsValidName(word->driver), "a driver has a name");
  }
  if (const auto placement = console::ReadPlacement(body)) {
    Require(std::abs(placement->x_m) < 1e7 && placement->scale > 0.0, "it can be drawn there");
  }
  (void)console::ReadSiteFile(body);
  (void)console::ReadPlacements(body);
  if (const auto edit = console::ReadRouteEdit("hall", body)) {
    const exchange::RouteEditRequest request{AgentId("desk"), 1, *edit};
    Require(exchange::CheckBounds(request).has_value(), "an edit may be published");
  }
  if (const auto key = console::ReadFetch(body)) {
    Require(IsValidName(key->route.value()), "a route is asked for by its id");
  }
  const console::Parameters parameters = ParametersIn(body);
  if (const auto query = console::ReadRouteQuery(parameters)) {
    Require(exchange::CheckQuery(*query).has_value(), "a query is as servers want it");
    const exchange::CatalogRequest request{AgentId("desk"), 1, *query};
    Require(exchange::CheckBounds(request).has_value(), "a query may be published");
  }
  for (const auto read : {console::ReadMissionQuery, console::ReadCommandQuery}) {
    const auto query = read(parameters);
    if (!query) continue;
    const exchange::MissionRequest request{
        .client = AgentId("desk"), .request = 1, .query = *query};
    Require(exchange::CheckBounds(request).has_value(), "a question may be published");
  }
  (void)console::ReadRunsQuery(parameters);
  (void)console::ReadChangesQuery(parameters, 1'795'647'600'000);
  const auto part = console::ReadNetworkQuery(parameters);
  (void)console::NetworkList(LinesIn(body), true).Body(part.value_or(console::NetworkQuery{}));
  if (const auto question = console::ReadWayQuestion(parameters)) {
    const exchange::NetworkRequest request{AgentId("desk"), 1, *question, 0};
    Require(exchange::CheckBounds(request).has_value(), "a way may be asked for");
  }
  if (const auto photos = console::ReadPhotosQuery(parameters)) {
    const auto again = photos::ParsePhotoQuery(ToText(photos->of));
    Require(again.has_value(), "a question about photos is understood by servers");
  }
  if (const auto photo = photos::ParsePhoto(body)) {
    const auto again = photos::ParsePhoto(ToText(*photo));
    Require(again && ToText(*again) == ToText(*photo), "a photo is read as it is written");
  }
  if (const auto words = console::ReadNetworkEdit(body)) {
    const exchange::NetworkEdit change{AgentId("desk"), 1, *words};
    Require(exchange::CheckBounds(change).has_value(), "a change may be published");
  }
  if (const auto read = console::ReadSchedule(body)) {
    const auto again = schedule::ParseSchedule(ToText(read->schedule));
    Require(again && *again == read->schedule, "a schedule is read as it is written");
  }
  (void)schedule::ParseLines(LinesIn(body));
  (void)console::ErrorBody(body);
  if (const auto users = users::ParseUsers(body)) {
    const auto again = users::ParseUsers(users::TextOf(*users));
    Require(again && *again == *users, "users are read as they were written");
  }
  return 0;
}
