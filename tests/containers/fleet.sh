# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh and the scenarios
# A fleet in containers on the lab's network, for the scenarios: how to start it, what to wait for,
# and what must hold of it in the end. Every wait is bounded, and says what it waited for.

# fail WHY: with what everybody said last.
fail() {
  local name
  for name in $(podman ps --all --format '{{.Names}}' | sort); do
    printf -- '--- %s (%s)\n' "$name" "$(podman inspect --format '{{.State.Status}} {{.State.ExitCode}}' "$name")"
    tail -n 15 "${log_of[$name]:-/dev/null}"
  done >&2
  printf 'FAILED: %s: %s\n' "${scenario:-containers}" "$*" >&2
  exit 1
}

# await SECONDS WHAT COMMAND...: until the command succeeds.
await() {
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    ((SECONDS < until)) || fail "waited in vain for: $what"
    sleep 0.2
  done
}

# NAME's log, each line with its time in front, since the container was made; says NAME WORDS.
declare -A log_of
says() { grep -q -- "$2" "${log_of[$1]}"; }
ended() { [[ $(podman inspect --format '{{.State.Status}}' "$1") == exited ]]; }
status_of() { podman inspect --format '{{.State.ExitCode}}' "$1"; }
address_of() { podman inspect --format '{{.NetworkSettings.Networks.fleet.IPAddress}}' "$1"; }
pid_of() { podman inspect --format '{{.State.Pid}}' "$1"; }
files_of() { echo "$LAB_WORK/storage/volumes/$1/_data"; }
# value_of NAME KEY: out of the summary that its agent ended with.
value_of() { sed -n "s/.* $2=//p" "${log_of[$1]}" | tail -n 1; }

# use_keys_of NAME: Podman's options for a container with the keys of that member of the fleet's
# authority, if there are any (scenarios/strangers.sh).
keys_options=()
use_keys_of() {
  local keys=$LAB_WORK/authority/members/$1
  keys_options=()
  [[ ! -d $keys ]] || keys_options=(--env TRAILCAST_SECURITY=/keys --volume "$keys:/keys:ro")
}

# contain NAME IMAGE [OPTION...] -- [ARGUMENT...]: as a fleet's images are meant to run.
contain() {
  local name=$1 image=$2 options=() told
  shift 2
  use_keys_of "$name"
  while [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  shift
  told=$(podman run --detach --quiet --name "$name" --hostname "$name" --network fleet --read-only \
    --tmpfs /tmp --volume "$name:/data" "${keys_options[@]}" "${options[@]}" "trailcast-$image" "$@" 2>&1) ||
    fail "cannot start $name: $told"
  log_of[$name]=$(podman inspect --format '{{.HostConfig.LogConfig.Path}}' "$name")
}

# An operator's command, in a container of its own; operate_as NAME, with the keys of that member.
operate() { operate_as operator "$@"; }
operate_as() {
  use_keys_of "$1"
  shift
  podman run --rm --network fleet --read-only "${keys_options[@]}" --entrypoint trailcast \
    trailcast-robot "$@"
}

# Where a robot is by its true poses: seconds of its own clock, x, y; nothing before it has a row that
# is written whole.
place_of() { tail -n 2 "$(files_of "$1")/truth.csv" 2>/dev/null | sed -n "1{/^[0-9]/s/,/ /gp}" | cut -d" " -f1-3; }
# Farther than any noise, in a fifth of a second.
drives() {
  local before
  before=$(place_of "$1")
  sleep 0.2
  awk -v before="$before" -v after="$(place_of "$1")" 'BEGIN {
    split(before, a, " "); split(after, b, " ")
    exit !(sqrt((a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2) > 0.01) }'
}
stands() { ! drives "$1"; }

start_server() {
  contain server server --
  await 30 'the server' says server ready
}

# A server that has the route, taught once for all scenarios.
start_server_with_route() {
  local kept=$LAB_WORK/taught
  if [[ ! -d $kept ]]; then
    start_server
    start_scout
    expect_taught
    podman stop --time 20 server >/dev/null
    cp -a "$(files_of server)" "$kept"
    clear_fleet
  fi
  podman volume create server >/dev/null
  cp -a "$kept/." "$(files_of server)"
  start_server
}

# start_robot NAME CAMERA teach|replay|serve [OPTION...]: over the path; robot_options are more of
# Podman's. Its agent bears with a robot that a scenario holds still.
robot_options=()
start_robot() {
  local name=$1 camera=$2 command=$3
  shift 3
  contain "$name" robot --env ROBOT_CAMERA="$camera" --env ROBOT_PATH=/path.csv \
    --env ROBOT_TRUTH=/data/truth.csv --env ROBOT_PATIENCE_S=600 --volume "$path:/path.csv:ro" "${robot_options[@]}" -- \
    "$command" "$@"
}
start_scout() { start_robot scout webcam teach --route hall --delivery-timeout 120; }
# Its world is its own: nobody is in its way.
start_follower() { start_robot "$1" "$2" replay --route hall --wait-for-route --wait 300 --keep-distance 0; }

# progress_of NAME: percent of the route, by its heartbeat; is_beyond NAME PERCENT.
progress_of() { sed -n 's/.*: \([0-9]*\) % of .*/\1/p' "$(files_of "$1")/heartbeat" 2>/dev/null; }
is_beyond() { (($(progress_of "$1") + 0 >= $2)); }

# is_well NAME: by its image's check of health.
is_well() { podman healthcheck run "$1" >/dev/null 2>&1; }

# signal_to SIGNAL NAME PROGRAM: the program that the container's entry point started.
signal_to() {
  local process
  for process in /proc/[0-9]*; do
    [[ $(cat "$process/comm" 2>/dev/null) == "$3" ]] || continue
    [[ $(awk '/^PPid:/ { print $2 }' "$process/status") == "$(pid_of "$2")" ]] || continue
    kill -"$1" "${process#/proc/}"
    return
  done
  fail "no $3 runs in $2"
}

await_end() { await "$1" "the end of $2" ended "$2"; }

note() { printf '  %s\n' "$*"; }

# All containers of a scenario, and what they kept.
clear_fleet() {
  podman rm --all --force --time 0 >/dev/null
  podman volume rm --all --force >/dev/null
  rm -rf "$LAB_WORK"/{authority,strangers,other}
  log_of=()
}
