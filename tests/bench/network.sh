#!/usr/bin/env bash
# Measures how routes are shared over networks staged on this machine, and the rivals beside it.
# Needs root, the packages of group "bench" (config/setup/install.sh bench), and ./run build.
#   tests/bench/network.sh followers|idle|stall|loss|wire|bulk|ingest|latency|security [RUNS]
#   tests/bench/network.sh memory [MINUTES]
#   tests/bench/network.sh stop [SAMPLES]
#   tests/bench/network.sh swarm [AGENTS [star|mesh]]
#   tests/bench/network.sh fleet [AGENTS [MINUTES]]
#   tests/bench/network.sh neighbours [FOLLOWERS [SECONDS]]
#   tests/bench/network.sh sizes FOLDER [AGENTS...]
#   tests/bench/network.sh sites [SEGMENTS]
# LIGHT_HOSTS (20) says at how many hosts the agents of `fleet`, `neighbours` and `sizes` are.
# What each is, is in a file of its own in network/: fetching.sh, wire, server, fleet, words, sites.
# shellcheck disable=SC2034  # what the sourced files use
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$(cd "$here/../../build/release/bin" && pwd)
# shellcheck source=tests/bench/network/lab.sh
source "$here/network/lab.sh"
for part in fetching wire server fleet words sites; do
  # shellcheck source=/dev/null
  source "$here/network/$part.sh"
done

fetch_timeout=120
lights=()  # processes of light agents
fleet=  # folder of the fleet's authority; empty: no security

# await SECONDS WHAT COMMAND...: until the command succeeds.
await() {
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    if ((SECONDS >= until)); then
      tail -n 5 "$work"/*.log >&2 || true
      die "waited in vain for $what"
    fi
    sleep 0.05
  done
}
# NAME's log says WORD.
says() { grep -q "$2" "$work/$1.log"; }

median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# start_server NUMBER STORE FLAGS...: the route server, running; before its agents where processors
# are short: elsewhere it does not share them.
start_server() {
  local log="$work/server.log"
  : >"$log"
  on "$1" nice -n -15 "$bin/trailcast-server" --store "$2" --network-interface eth0 --log-level debug \
    --security "${fleet:+$fleet/members/server}" "${@:3}" >"$log" 2>&1 &
  server=$!
  await 30 'the server' says server ready
}

# fetch NUMBER: the robot's, into a store of its own.
fetch() {
  on "$1" timeout "$fetch_timeout" "$bin/trailcast-agent" --name "robot$1" --network-interface eth0 \
    --log-level debug --security "${fleet:+$fleet/members/robot$1}" \
    --store "$work/robot$1.db" fetch --route hall >"$work/robot$1.log" 2>&1
}

# Seconds from the first request for a segment to the last segment.
fetch_time() {
  awk '
    function at(clock, part) { split(clock, part, ":"); return part[1] * 3600 + part[2] * 60 + part[3] }
    /segments so far/ { from = at($1) }
    / all [0-9]+ segments of .* are here$/ { whole = 1; exit }
    /segments of .* are here$/ { to = at($1) }
    END { if (whole) printf "%.2f\n", to - from; else print "failed" }' "$work/robot$1.log"
}

make_route() {
  local made
  made=$("$bin/network_bench" store "$work/server.db" --segments "$1")
  route_bytes=$(awk '{ print $3 }' <<<"$made")
  printf '# %s\n' "$made"
}

# medians COMMAND...: of each column of what it prints, over all runs.
medians() {
  local run
  for ((run = 0; run < runs; ++run)); do "$@"; done >"$work/runs"
  local columns column
  columns=$(head -1 "$work/runs" | wc -w)
  for ((column = 1; column <= columns; ++column)); do
    cut -d' ' -f"$column" "$work/runs" | median
  done | paste -sd' '
}

die() {
  printf 'network.sh: %s\n' "$*" >&2
  exit 1
}

main() {
  case ${1:-} in
    followers | idle | stall | loss | wire | bulk | ingest | latency | memory | security | stop | swarm | fleet | neighbours | sizes | sites) ;;
    *)
      die 'say what to measure: followers, idle, stall, loss, wire, bulk, ingest, latency, memory, security, stop, swarm, fleet, neighbours, sizes or sites'
      ;;
  esac
  [[ $(id -u) == 0 ]] || die 'needs root, to stage networks'
  lab_enter "$@"
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  runs=${2:-5}
  "$@"
}

main "$@"
