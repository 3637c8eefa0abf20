#!/usr/bin/env bash
# A virtual robot and, beside it as on the robot's own computer, the agent that drives it.
#   robot.sh teach|replay|serve [options of trailcast-agent]
# The container's hostname is the robot's name, and with it camera, errors and topics are drawn, so
# that every replica is another robot. What decides otherwise:
#   ROBOT_WORLD   a built-in world (indoor)     ROBOT_PATH   CSV x_m,y_m (the world's own)
#   ROBOT_SEED    of its errors and noise       ROBOT_CARRY  as 'trailcast robot --sim-carry'
#   ROBOT_CAMERA  a built-in camera             ROBOT_FAULT  as 'trailcast robot --fail'; in real
#   ROBOT_TRUTH   file for its true poses                    time then, and with serve, otherwise
#                                                            in lockstep
#   ROBOT_PICTURE_RATE  a second, in real time (30)
#   ROBOT_PATIENCE_S  seconds that its agent waits for a robot that fell silent (60)
set -euo pipefail

command=${1:-}
case $command in
  teach | replay | serve) shift ;;
  *)
    printf "robot.sh: '%s' is not understood; give teach, replay or serve, and the agent's options\n" \
      "$command" >&2
    exit 2
    ;;
esac
export TRAILCAST_NAME=${TRAILCAST_NAME:-$HOSTNAME}
draw=$(cksum <<<"$TRAILCAST_NAME")
draw=${draw%% *}
# Robots have a ROS domain each, and it does not leave the container: their pictures concern nobody
# else.
export ROS_DOMAIN_ID=${ROS_DOMAIN_ID:-$((1 + draw % 200))}
cameras=(webcam firewire wide hd)
topics=/robot_${TRAILCAST_NAME//[^A-Za-z0-9]/_}

robot=(--sim "${ROBOT_WORLD:-indoor}" --seed "${ROBOT_SEED:-$draw}" --ros2 "$topics"
  --ros-interface lo --camera "${ROBOT_CAMERA:-${cameras[draw % ${#cameras[@]}]}}")
agent=(--ros2 "$topics" --ros-interface lo
  --sensor-patience "${ROBOT_PATIENCE_S:-60}")
[[ -z ${ROBOT_PATH:-} ]] || robot+=(--path "$ROBOT_PATH")
[[ -z ${ROBOT_CARRY:-} ]] || robot+=(--sim-carry "$ROBOT_CARRY")
[[ -z ${ROBOT_TRUTH:-} ]] || robot+=(--sim-truth "$ROBOT_TRUTH")
# On duty, nobody answers a robot in lockstep for most of the time.
if [[ -z ${ROBOT_FAULT:-} && $command != serve ]]; then
  robot+=(--lockstep)
  agent+=(--lockstep)
else
  robot+=(--picture-rate "${ROBOT_PICTURE_RATE:-30}")
  [[ -z ${ROBOT_FAULT:-} ]] || robot+=(--fail "$ROBOT_FAULT")
fi
if [[ $command == teach ]]; then
  robot+=(--scout)
  agent+=(--end-when-still 2)
fi

# run_agent [OPTION...]: its exit status; a signal to this script interrupts the waiting, not the agent.
run_agent() {
  local ended=0
  trailcast-agent "$command" "${agent[@]}" "$@" &
  agent_pid=$!
  wait "$agent_pid" || ended=$?
  while kill -0 "$agent_pid" 2>/dev/null; do
    ended=0
    wait "$agent_pid" || ended=$?
  done
  return "$ended"
}

stopped='' agent_pid=''
trap 'stopped=1; [[ -z $agent_pid ]] || kill "$agent_pid" 2>/dev/null || true' TERM INT HUP
trailcast robot "${robot[@]}" &
robot_pid=$!
# An agent that was killed is started again, as the robot's service manager would.
status=137
while ((status == 137)) && [[ -z $stopped ]]; do
  [[ -z $agent_pid ]] || printf 'robot.sh: the agent was killed: starting it again\n' >&2
  status=0
  run_agent "$@" || status=$?
done
kill "$robot_pid" 2>/dev/null || true
wait "$robot_pid" || true
exit "$status"
