// The bodies of requests to the console, its file of users, and the files of its site.
#include <cmath>

#include "services/base/text.h"
#include "services/console/json.h"
#include "services/console/site.h"
#include "services/exchange/bounds.h"
#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
using namespace trailcast;

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
  if (const auto placement = console::ReadPlacement(body)) {
    Require(std::abs(placement->x_m) < 1e7 && placement->scale > 0.0, "it can be drawn there");
  }
  (void)console::ReadSiteFile(body);
  (void)console::ReadPlacements(body);
  (void)console::ErrorBody(body);
  if (const auto users = users::ParseUsers(body)) {
    const auto again = users::ParseUsers(users::TextOf(*users));
    Require(again && *again == *users, "users are read as they were written");
  }
  return 0;
}
