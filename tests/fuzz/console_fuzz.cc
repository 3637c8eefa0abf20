// The bodies of requests to the console, and its file of users.
#include "services/base/text.h"
#include "services/console/json.h"
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
  (void)console::ErrorBody(body);
  if (const auto users = users::ParseUsers(body)) {
    const auto again = users::ParseUsers(users::TextOf(*users));
    Require(again && *again == *users, "users are read as they were written");
  }
  return 0;
}
