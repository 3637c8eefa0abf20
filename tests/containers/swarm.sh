#!/usr/bin/env bash
# The swarm in containers: a server, a scout and followers with other cameras, each robot in a
# container with an address of its own, and what may happen to them. Needs root, Podman (the packages
# of group "containers") and ./run build.
#   tests/containers/swarm.sh                  the quick ones: follow killed broken missions
#                                              stop_under_load who_may_send
#   tests/containers/swarm.sh --all            all of them
#   tests/containers/swarm.sh SCENARIO...      follow late lossy cut killed broken missions
#                                              queue strangers crowd compose
#                                              stop_under_load who_may_send console
#                                              network
# With --from-source in front, the images are built from the repository alone, as a user would.
# shellcheck disable=SC2034  # what the sourced files use
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
# shellcheck source=tests/containers/lab.sh
source "$here/lab.sh"
# shellcheck source=tests/containers/fleet.sh
source "$here/fleet.sh"
# shellcheck source=tests/containers/expect.sh
source "$here/expect.sh"
# shellcheck source=tests/containers/faults.sh
source "$here/faults.sh"

all=(follow late lossy cut killed broken missions stop_under_load who_may_send queue console
  network strangers crowd compose)
quick=(follow killed broken missions stop_under_load who_may_send)

die() {
  printf 'swarm.sh: %s\n' "$*" >&2
  exit 1
}

usage() { sed -n "2,/^# shellcheck/s/^# \{0,1\}//p" "${BASH_SOURCE[0]}" | sed \$d; }

# Small enough for robots (200 MB) and for a server anywhere (60 MB).
check_images() {
  local server agent
  server=$(lab_image_mb server)
  agent=$(lab_image_mb agent)
  note "images above Debian: server $server MB, agent $agent MB, robot $(lab_image_mb robot) MB, console $(lab_image_mb console) MB"
  ((server <= 60 && agent <= 200)) || fail 'an image is too large: server at most 60 MB, agent 200'
}

run_scenario() {
  scenario=$1
  local began=$SECONDS
  printf '== %s\n' "$scenario"
  "scenario_$scenario"
  clear_fleet
  printf -- '-- %s: %d s\n' "$scenario" $((SECONDS - began))
}

main() {
  local wanted=() argument obstacle
  for argument in "$@"; do
    case $argument in
      --all) wanted=("${all[@]}") ;;
      --from-source) from_source=yes ;;
      -h | --help)
        usage
        return
        ;;
      *)
        [[ " ${all[*]} " == *" $argument "* ]] || die "there is no scenario '$argument': ${all[*]}"
        wanted+=("$argument")
        ;;
    esac
  done
  ((${#wanted[@]})) || wanted=("${quick[@]}")
  obstacle=$(lab_obstacle)
  if [[ -n $obstacle ]]; then
    printf 'containers: SKIPPED: %s\n' "$obstacle"
    return
  fi
  lab_enter "$@"
  # A few metres are enough, and every robot takes them.
  path=$LAB_WORK/path.csv
  printf 'x_m,y_m\n1.0,1.5\n4.5,1.5\n6.0,2.0\n' >"$path"
  check_images
  for argument in "${wanted[@]}"; do
    # shellcheck source=/dev/null
    source "$here/scenarios/$argument.sh"
    run_scenario "$argument"
  done
  printf 'containers: %d scenarios passed in %d s\n' "${#wanted[@]}" "$SECONDS"
}

main "$@"
