#include "services/console/src/robot_state.h"

#include "services/fleet/robots_there.h"

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
  const bool free = status.mode == AgentMode::kWaiting && status.on_duty && !on_mission;
  return free && status.segments == 0 ? "free" : fleet::ToText(status.mode);
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
