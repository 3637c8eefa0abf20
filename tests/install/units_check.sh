#!/usr/bin/env bash
# What units_test.sh wants to know, asked inside, as a service among the others.
#   units_check.sh FOLDER
set -euo pipefail
folder=$1
units=(trailcast-agent trailcast-console trailcast-server)
exec >"$folder/told" 2>&1

fail() {
  echo "FAILED: $*"
  systemctl --no-pager status "${units[@]}" || true
  journalctl --no-pager -n 80 || true
  exit 1
}
# await SECONDS WHAT COMMAND...
await() {
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < until)) || fail "waited in vain for: $what"
    sleep 0.2
  done
}
operate() { trailcast "$@" --network-interface lo --security /root/fleet/members/operator; }
is_shown() { curl -sf http://localhost:8080/api/state | grep -q '"robot1"'; }
pid_of() { systemctl show --value --property MainPID "$1"; }
is_another() { [[ $(pid_of trailcast-agent) != 0 && $(pid_of trailcast-agent) != "$1" ]]; }

check() {
  local before unit
  for unit in "${units[@]}"; do await 60 "$unit" systemctl is-active "$unit"; done
  await 60 'robot1 in the console' is_shown
  await 60 'a mission' operate send robot1 wait 0.1 --wait
  operate missions --robot robot1 | grep arrived || fail 'the server keeps no missions'
  for unit in "${units[@]}"; do
    [[ $(stat -c %u "/proc/$(pid_of "$unit")") != 0 ]] || fail "$unit runs as root"
  done
  before=$(pid_of trailcast-agent)
  kill -KILL "$before"
  await 60 'the agent to be started again' is_another "$before"
  await 60 'a mission after that' operate send robot1 wait 0.1 --wait
  for unit in "${units[@]}"; do
    systemctl stop "$unit"
    [[ $(systemctl show --value --property Result "$unit") == success ]] || fail "$unit ended badly"
  done
  echo 'server, agent and console ran as users of their own; the agent was killed, and started again'
}

status=0
(check) || status=$?
echo "$status" >"$folder/ended.part"
mv "$folder/ended.part" "$folder/ended"
