#include "services/fleet/robot_state.h"

namespace trailcast::fleet {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentRole;

RobotState RobotStateOf(const exchange::AgentStatus& status, bool offline,
                        const mission::Report* last) {
  // A robot that has announced its end is not offline.
  if (offline && status.mode != AgentMode::kStopped) return RobotState::kOffline;
  const bool drives =
      status.mode == AgentMode::kReplaying;  // a held robot may still drive for a moment
  const bool held = !drives && status.mode != AgentMode::kStopped;
  if (held && status.hold == AgentHold::kStopped) return RobotState::kStopped;
  if (held && status.hold == AgentHold::kPaused) return RobotState::kPaused;
  const bool on_mission = last != nullptr && !mission::HasEnded(last->state);
  const bool available = status.on_duty && !on_mission && status.segments == 0;
  const bool failed = last != nullptr && last->state == mission::State::kFailed;
  switch (status.mode) {
    case AgentMode::kStarting:
      return RobotState::kStarting;
    case AgentMode::kWaiting:
      if (!available) return RobotState::kWaiting;
      return failed ? RobotState::kFailed : RobotState::kAvailable;
    case AgentMode::kTeaching:
      return RobotState::kTeaching;
    case AgentMode::kReplaying:
      return RobotState::kDriving;
    case AgentMode::kArrived:
      return RobotState::kArrived;
    case AgentMode::kStopped:
      return RobotState::kShutDown;
    case AgentMode::kFault:
      break;
  }
  return RobotState::kFault;
}

const char* ToText(RobotState state) { return kRobotStates.at(static_cast<std::size_t>(state)); }

const char* ToText(AgentRole role) {
  switch (role) {
    case AgentRole::kServer:
      return "server";
    case AgentRole::kScout:
      return "scout";
    case AgentRole::kFollower:
      return "follower";
    case AgentRole::kOperator:
      return "operator";
  }
  return "unknown";
}

}  // namespace trailcast::fleet
