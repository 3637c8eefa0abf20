#include "services/console/src/robot_state.h"

namespace trailcast::console {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentRole;

const char* RobotState(const exchange::AgentStatus& status, bool silent, bool on_mission) {
  if (silent) return "silent";
  const bool drives = status.mode == AgentMode::kReplaying;  // yet, for a moment
  const bool held = !drives && status.mode != AgentMode::kStopped;
  if (held && status.hold == AgentHold::kStopped) return "stopped";
  if (held && status.hold == AgentHold::kPaused) return "paused";
  switch (status.mode) {
    case AgentMode::kStarting:
      return "starting";
    case AgentMode::kWaiting:
      return status.on_duty && !on_mission && status.segments == 0 ? "free" : "waiting";
    case AgentMode::kTeaching:
      return "teaching";
    case AgentMode::kReplaying:
      return "driving";
    case AgentMode::kArrived:
      return "arrived";
    case AgentMode::kStopped:
      return "ended";
    case AgentMode::kFault:
      return "fault";
  }
  return "waiting";
}

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
