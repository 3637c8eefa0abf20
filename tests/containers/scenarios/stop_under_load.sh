# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# An available robot is stopped from the console, again and again, while the server's link is full of
# segments that others fetch: it stands soon, by its own clock and its true poses.
scenario_stop_under_load() {
  local loader stop after=() median
  "$root/build/release/bin/network_bench" store "$LAB_WORK/large.db" --segments 3000 >/dev/null
  podman volume create server >/dev/null
  install -o 10001 -g 10001 "$LAB_WORK/large.db" "$(files_of server)/routes.db"
  start_server
  start_robot scout webcam teach --route yard --delivery-timeout 120
  expect_taught
  contain desk console --env TRAILCAST_HTTP_HOST=127.0.0.1 --
  start_robot robot1 wide serve
  await 60 'robot1 in the console' tells '"robot1"'
  limit server 8mbit
  for loader in loader1 loader2; do start_loader "$loader"; done
  for loader in loader1 loader2; do
    await 60 'segments on the link' says "$loader" 'segments so far'
  done
  order missions '{"orders": "follow yard speed 0.5"}'
  for stop in 1 2 3 4 5; do
    await 60 'robot1 to drive' drives robot1
    after+=("$(stop_robot1)")
    order release '{}'
    order resume '{}'
  done
  median=$(printf '%s\n' "${after[@]}" | sort -n | sed -n 3p)
  note "stood after ${after[*]} s, while two fetch 3000 segments over 8 Mbit/s; the server: $(traffic_of server)"
  awk -v s="$median" 'BEGIN { exit !(s <= 0.9) }' || fail "stops took $median s"
  order cancel '{}'
}

# Takes the large route, into an empty store each time.
start_loader() {
  contain "$1" agent --entrypoint /bin/sh -- -c \
    "while true; do rm -f /data/routes.db*; trailcast-agent --name $1 --log-level debug fetch --route hall; done"
}

# In the container's own network, where alone the console listens.
ask_console() { in_network_of desk curl --silent --show-error --max-time 30 "$@"; }
tells() { ask_console http://localhost:8080/api/state | grep -- "$1" >/dev/null; }
order() {
  local answer
  answer=$(ask_console --fail-with-body --header 'Content-Type: application/json' --data "$2" \
    "http://localhost:8080/api/robots/robot1/$1") || fail "robot1 does not obey $1: $answer"
}

# Prints how long it drove on, by its own clock, after it was told.
stop_robot1() {
  local told_s
  told_s=$(place_of robot1)
  told_s=${told_s%% *}
  order stop '{"reason": "trial"}'
  await 10 'robot1 to stand' stands robot1
  awk -F, -v told_s="$told_s" '
    NR > 1 && $1 >= told_s && NF >= 4 {
      if (sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2) > 0.0002) moved_s = $1
      x = $2; y = $3
    }
    END { printf "%.2f", moved_s - told_s }' "$(files_of robot1)/truth.csv"
}
