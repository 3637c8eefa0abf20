#!/usr/bin/env bash
# Measures what a console costs, and how smooth its pages are in Chromium, beside a hundred robots
# that are only played and a route server with 5000 routes: each a host of a staged network. Needs
# root, the packages of groups "bench" and "check", and ./run build.
#   tests/bench/console.sh [OPTIONS of console_bench look]
# ROBOTS (100) and ROUTES (5000) say how many; FOLDER where pictures of the pages go; STILL=1: the
# robots tell the same again and again.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$(cd "$here/../../build/release/bin" && pwd)
# shellcheck source=tests/bench/network/lab.sh
source "$here/network/lab.sh"
robots=${ROBOTS:-100}
routes=${ROUTES:-5000}

lab_enter "$@"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
lab_open
for host in 1 2 3; do lab_host "$host"; done
lab_introduce
"$bin/console_bench" store "$work/server.db" --routes "$routes" --robots "$robots"
on 1 "$bin/trailcast-server" --store "$work/server.db" --network-interface eth0 >"$work/server.log" 2>&1 &
server=$!
on 2 "$bin/console_bench" play --robots "$robots" ${STILL:+--still} >"$work/play.log" 2>&1 &
until process=$(<"/proc/$server/task/$server/children") && [[ -n $process ]]; do sleep 0.05; done
on 3 "$bin/console_bench" look "$bin" "$work" --server "${process% }" --robots "$robots" --routes "$routes" "$@" || {
  tail -n 5 "$work"/*.log >&2
  exit 1
}
[[ -z ${FOLDER:-} ]] || cp "$work"/*.png "$FOLDER"
