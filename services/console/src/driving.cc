#include "services/console/driving.h"

#include <utility>

namespace trailcast::console {

using mission::DriverSeat;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

DriverSeat::Verdict Driving::Hear(const AgentId& robot, const Word& word, Time now) {
  const std::scoped_lock lock(mutex_);
  DriverSeat& seat = seats_.Touch(robot);
  const auto verdict = seat.Hear(word.driver, word.said_ms, now);
  if (verdict != DriverSeat::Verdict::kGood) return verdict;
  // To the robot it is as old as it is here.
  const auto said = now - seat.late();
  const auto said_ms = duration_cast<milliseconds>(said.time_since_epoch()).count();
  waiting_[robot] = {.agent = robot,
                     .client = {},
                     .linear_mps = word.linear_mps,
                     .turn_radps = word.turn_radps,
                     .sent_ms = static_cast<std::uint64_t>(said_ms)};
  return verdict;
}

std::vector<exchange::DriveCommand> Driving::Take(const AgentId& self) {
  const std::scoped_lock lock(mutex_);
  std::vector<exchange::DriveCommand> commands;
  for (auto& [robot, command] : std::exchange(waiting_, {})) {
    command.client = self;
    commands.push_back(std::move(command));
  }
  return commands;
}

}  // namespace trailcast::console
