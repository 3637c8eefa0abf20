#include "route_server/fleet/kept_mission.h"

#include <fmt/format.h>

#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"

namespace trailcast::server {

std::string Describe(const mission::Mission& mission) {
  return fmt::format("mission {} of '{}': {}", mission.id, mission.agent.value(),
                     PlainText(mission.orders, 200));
}

std::string OrdersWithoutWay(std::string_view goal) {
  return fmt::format("goto {} wait way", goal);
}

bool SendsHome(const mission::Record& record) {
  return record.mission.id.starts_with(kHomePrefix) &&
         record.mission.orders == OrdersWithoutWay(mission::kHomeWord);
}

bool SendsToCharge(const mission::Record& record) {
  return record.mission.id.starts_with(kChargePrefix) &&
         mission::GoingIn(record.mission.orders).has_value();
}

bool EndsHere(const mission::Record& record, mission::State state) {
  return state == mission::State::kArrived ||
         (state == mission::State::kCancelled && SendsToCharge(record));
}

std::string NotArrived(const mission::Report& end) {
  return fmt::format("mission {} did not arrive ({}): resume the robot to go on, or cancel",
                     end.mission, mission::ToString(end.state));
}

std::uint32_t EndedStates() {
  std::uint32_t states = 0;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    if (mission::HasEnded(static_cast<mission::State>(i))) states |= 1U << i;
  }
  return states;
}

mission::Report OwnReport(const mission::Mission& mission, mission::State state,
                          const std::string& why) {
  return {.agent = mission.agent,
          .mission = mission.id,
          .state = state,
          .detail = PlainText(why, exchange::kMaxLineBytes),
          .relayed = true};
}

}  // namespace trailcast::server
