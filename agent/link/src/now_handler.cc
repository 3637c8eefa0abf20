#include "agent/link/now_handler.h"

#include <variant>

#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"

namespace trailcast::agent {

bool NowHandler::IsMeant(const exchange::NowCommand& command, const std::string& route) const {
  switch (command.whom) {
    case exchange::NowWhom::kRobot:
      return command.name == self_.value();
    case exchange::NowWhom::kOnRoute:
      return command.name == route;
    case exchange::NowWhom::kAll:
      return true;
  }
  return false;
}

exchange::AgentHold NowHandler::shown_hold() const {
  switch (hold().kind) {
    case Hold::Kind::kNone:
      return exchange::AgentHold::kNone;
    case Hold::Kind::kPaused:
      return exchange::AgentHold::kPaused;
    case Hold::Kind::kStopped:
      break;
  }
  return exchange::AgentHold::kStopped;
}

void NowHandler::Handle(const exchange::Message& message, const std::string& route,
                        std::int64_t unix_ms) {
  const auto* command = std::get_if<exchange::NowCommand>(&message);
  if (command == nullptr || !IsMeant(*command, route)) return;
  exchange::NowAnswer& answer = given_.Touch({command->client, command->number});
  if (answer.number == 0) {
    const auto obeyed = hold_.Obey(*command, WithoutProcess(command->client.value()), unix_ms);
    answer = {.agent = self_,
              .client = command->client,
              .number = command->number,
              .refused = obeyed.refused,
              .detail = PlainText(obeyed.detail, exchange::kMaxLineBytes)};
    news_.push_back((obeyed.refused ? "does not obey " : "obeys ") + command->client.value() +
                    ": " + obeyed.detail);
  }
  answers_.emplace_back(answer);
}

}  // namespace trailcast::agent
