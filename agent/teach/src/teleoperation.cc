#include "agent/teach/teleoperation.h"

#include <utility>

namespace trailcast::agent {

void Teleoperation::Hear(const exchange::DriveCommand& command, Time now) {
  (void)words_.TryPut({command, now});
}

void Teleoperation::Tell(const Hold& hold) {
  if (hold == told_) return;
  // If the queue is full, the next call repeats it.
  if (holds_.TryPut(Hold(hold))) told_ = hold;
}

void Teleoperation::Take() {
  while (auto hold = holds_.TryGet()) hold_ = *std::move(hold);
  while (const auto word = words_.TryGet()) {
    const exchange::DriveCommand& said = word->command;
    if (seat_.Hear(said.client.value(), said.sent_ms, word->at) !=
        mission::DriverSeat::Verdict::kGood) {
      continue;
    }
    command_ = {said.linear_mps, said.turn_radps};
  }
}

std::optional<motion::VelocityCommand> Teleoperation::Wanted(Time now) const {
  const bool held = hold_.kind != Hold::Kind::kNone;
  if (!held && !seat_.IsTaken(now)) return std::nullopt;
  return !held && seat_.Holds(now) ? command_ : motion::VelocityCommand{};
}

}  // namespace trailcast::agent
