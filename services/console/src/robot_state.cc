#include "services/console/src/robot_state.h"

namespace trailcast::console {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentRole;

RobotState RobotStateOf(const exchange::AgentStatus& status, bool silent, bool on_mission) {
  if (silent) return RobotState::kSilent;
  const bool drives = status.mode == AgentMode::kReplaying;  // yet, for a moment
  const bool held = !drives && status.mode != AgentMode::kStopped;
  if (held && status.hold == AgentHold::kStopped) return RobotState::kStopped;
  if (held && status.hold == AgentHold::kPaused) return RobotState::kPaused;
  const bool free = status.on_duty && !on_mission && status.segments == 0;
  switch (status.mode) {
    case AgentMode::kStarting:
      return RobotState::kStarting;
    case AgentMode::kWaiting:
      return free ? RobotState::kFree : RobotState::kWaiting;
    case AgentMode::kTeaching:
      return RobotState::kTeaching;
    case AgentMode::kReplaying:
      return RobotState::kDriving;
    case AgentMode::kArrived:
      return RobotState::kArrived;
    case AgentMode::kStopped:
      return RobotState::kEnded;
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

}  // namespace trailcast::console
