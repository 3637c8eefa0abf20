#include "services/console/driving.h"

#include <utility>

namespace trailcast::console {

using mission::DriverSeat;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

void Driving::Note(const exchange::AgentStatus& status, Time now) {
  const bool is_robot =
      status.role == exchange::AgentRole::kFollower || status.role == exchange::AgentRole::kScout;
  if (!is_robot) return;
  const std::scoped_lock lock(mutex_);
  robots_.Touch(status.agent) = {status.mode == exchange::AgentMode::kTeaching, now};
}

Driving::Verdict Driving::Hear(const AgentId& robot, const Word& word, Time now) {
  const std::scoped_lock lock(mutex_);
  const Robot* heard = robots_.Find(robot);
  if (heard == nullptr || now > heard->heard_at + kHeardWithin) return Verdict::kUnknown;
  if (!heard->teaches) return Verdict::kTeachesNothing;
  DriverSeat& seat = seats_.Touch(robot);
  switch (seat.Hear(word.driver, word.said_ms, now)) {
    case DriverSeat::Verdict::kLate:
      return Verdict::kLate;
    case DriverSeat::Verdict::kTaken:
      return Verdict::kTaken;
    case DriverSeat::Verdict::kGood:
      break;
  }
  // The command is as old to the robot as it is here.
  const auto said = now - seat.late();
  const auto said_ms = duration_cast<milliseconds>(said.time_since_epoch()).count();
  waiting_[robot] = {.agent = robot,
                     .client = {},
                     .linear_mps = word.linear_mps,
                     .turn_radps = word.turn_radps,
                     .sent_ms = static_cast<std::uint64_t>(said_ms)};
  return Verdict::kGood;
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
