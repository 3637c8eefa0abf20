# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# How soon a word is there: a segment, with keys and without, and a command to stand.

latency() {
  local run pong uri=${plain_uri/eth0\"/lo\" multicast=\"true\"}
  ip link set lo up
  for ((run = 0; run < runs; ++run)); do
    "$bin/network_bench" latency
    CYCLONEDDS_URI=$uri ddsperf -D 6 pong waitset >/dev/null 2>&1 &
    pong=$!
    printf 'ddsperf, one way: '
    CYCLONEDDS_URI=$uri ddsperf -D 5 ping size 4k waitset 2>&1 | grep -o 'mean.*' | tail -1
    wait "$pong" || true
  done
}

# The same with keys and without: a fetch, a segment's way, how soon two programs meet.
security() {
  local rate with
  lab_open
  lab_host 1
  lab_host 2
  robots=(2)
  make_route 500
  "$bin/trailcast" keys init "$work/fleet" >/dev/null
  "$bin/trailcast" keys add --authority "$work/fleet" --role server server >/dev/null
  "$bin/trailcast" keys add --authority "$work/fleet" --role follower robot2 >/dev/null
  for with in '' "$work/fleet"; do
    fleet=$with
    start_server 1 "$work/server.db"
    for rate in 20mbit ''; do
      [[ -z $rate ]] && on 1 tc qdisc del dev eth0 root || lab_rate 1 "$rate"
      printf '%sfetch of 500, link %s: s, bytes %s\n' "${with:+secured, }" "${rate:-unlimited}" \
        "$(medians fetch_all)"
    done
    kill "$server"
    wait "$server" || true
    for ((rate = 0; rate < runs; ++rate)); do
      "$bin/network_bench" latency ${with:+--secured}
    done
  done
}

# stop [SAMPLES]: from an operator's word to a robot that is told to stand, and to its answer; the
# robot follows a route meanwhile, 30 pictures a second, and all three are hosts of their own.
stop() {
  local samples=${1:-200} sim=(--ros-interface lo) loss
  lab_open
  for host in 1 2 3 4 5; do lab_host "$host"; done
  make_route 3000
  start_server 1 "$work/server.db"
  on 2 "$bin/trailcast" robot --sim loop --ros2 /scout "${sim[@]}" --scout --lockstep >"$work/scout.log" 2>&1 &
  disown
  on 2 "$bin/trailcast-agent" teach --route round --store "$work/robot.db" --ros2 /scout "${sim[@]}" \
    --lockstep --end-when-still 1 >"$work/teach.log" 2>&1
  on 2 "$bin/trailcast" robot --sim loop --ros2 /robot "${sim[@]}" >"$work/body.log" 2>&1 &
  disown
  on 2 "$bin/trailcast-agent" serve --name robot --store "$work/robot.db" --network-interface eth0 \
    --ros2 /robot "${sim[@]}" >"$work/robot.log" 2>&1 &
  disown
  await 30 'the robot' says robot 'available as'
  on 3 "$bin/trailcast" send robot follow round laps 1000 --network-interface eth0 >/dev/null
  await 30 'the robot on its way' says robot FOLLOWING
  printf '| network | pauses | told to stand after, ms: median | p99 | worst | answered after, ms: median | p99 | worst |\n'
  told_to_stand 'free'
  for loss in 1 2 3; do lab_loss "$loss" 0.05; done
  told_to_stand '5 % of all packets lost'
  for loss in 1 2 3; do lab_loss "$loss" 0; done
  lab_rate 1 8mbit
  fetch_on 4 &
  fetch_on 5 &
  await 60 'segments on the link' says robot4 'segments so far'
  told_to_stand "the server's link of 8 Mbit/s full of segments"
}
# Again and again, into an empty store.
fetch_on() {
  robots=("$1")
  while true; do
    rm -f "$work/robot$1.db"*
    fetch "$1" || true
  done
}
# told_to_stand NETWORK: the lines of operator and robot laid side by side, by the clock that all
# hosts share.
told_to_stand() {
  on 3 "$bin/network_bench" stop robot --samples "$samples" >"$work/told"
  awk '
    function of_day(clock, part) {
      split(clock, part, ":")
      return 1000 * (part[1] * 3600 + part[2] * 60 + part[3])
    }
    FNR == NR { if (/ HELD in /) held[++stands] = of_day($1); next }
    {
      told = $1 % 86400000
      while (at < stands && held[at] < told) ++at
      if (held[at] >= told) print held[at] - told, $2
    }' "$work/robot.log" "$work/told" >"$work/both"
  printf '| %s | %d of %d | %s | %s |\n' "$1" "$(wc -l <"$work/both")" "$samples" \
    "$(spread 1 <"$work/both")" "$(spread 2 <"$work/both")"
}
# Of a column: the median, what 99 % are below, and the worst.
spread() {
  cut -d' ' -f"$1" | sort -n | awk '
    { v[NR] = $1 }
    END { printf "%.0f | %.0f | %.0f", v[1 + int((NR - 1) / 2)], v[1 + int(0.99 * (NR - 1))], v[NR] }'
}
