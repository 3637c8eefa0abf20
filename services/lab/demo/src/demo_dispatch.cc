#include "services/lab/demo/demo_dispatch.h"

#include <fmt/format.h>

#include <variant>

#include "services/fleet/draw.h"
#include "services/mission/mission.h"

namespace trailcast::demo {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kAgain{500};
// This much of the route is enough to set out, because the rest is taught meanwhile.
constexpr std::uint32_t kSegments = 2;
constexpr int kLaps = 20;

}  // namespace

DemoDispatch::DemoDispatch(const AgentId& self, const std::vector<DemoRobot>& robots)
    : scout_(robots.front().name) {
  for (std::size_t i = 1; i + 1 < robots.size(); ++i) {
    sendings_.emplace_back(
        mission::Mission{.agent = AgentId(robots[i].name),
                         .id = fleet::DrawMissionId(),
                         .client = self,
                         .orders = fmt::format("follow {} laps {}", robots[i].route, kLaps)});
  }
}

void DemoDispatch::Hear(const std::vector<exchange::Message>& messages) {
  for (const exchange::Message& message : messages) {
    for (fleet::Sending& sending : sendings_) (void)sending.Hear(message);
    const auto* status = std::get_if<exchange::AgentStatus>(&message);
    if (status != nullptr && status->agent == scout_ && status->segment >= kSegments) {
      taught_ = true;
    }
  }
}

std::vector<exchange::Message> DemoDispatch::Due(steady_clock::time_point now) {
  std::vector<exchange::Message> due;
  if (!taught_ || now < next_) return due;
  next_ = now + kAgain;
  for (const fleet::Sending& sending : sendings_) {
    const auto& last = sending.last();
    if (!last || last->state == mission::State::kSent) due.emplace_back(sending.mission());
  }
  return due;
}

}  // namespace trailcast::demo
