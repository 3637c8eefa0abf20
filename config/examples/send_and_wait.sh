#!/usr/bin/env bash
# Sends a robot, and waits until it has arrived: send_and_wait.sh robot2 follow hall laps 2
set -euo pipefail
api=${CONSOLE:-http://localhost:8080}/api robot=$1 orders=${*:2}
ask() { curl -sS ${TOKEN:+-H "Authorization: Bearer $TOKEN"} -H 'Content-Type: application/json' "$@"; }
mission=$(ask -d "$(jq -n --arg orders "$orders" '{$orders}')" "$api/robots/$robot/missions" |
  jq -r '.mission // error(.error)')
until [[ ${state:-} =~ arrived|refused|failed|cancelled|expired ]]; do
  sleep 1
  state=$(ask "$api/missions?mission=$mission" | jq -r '.missions[0] | "\(.state) \(.detail)"') || true
done
echo "$robot: $state" && [[ $state == arrived* ]]
