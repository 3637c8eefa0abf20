# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# How long robots take to fetch a route: alone, many at once, beside rivals, beside dead ones.

# at_once COMMAND...: the command with each of the robots' numbers, all at once; the slowest one's
# seconds, and the bytes that the server sent.
at_once() {
  local robot before after start
  before=$(lab_sent 1)
  start=$EPOCHREALTIME
  for robot in "${robots[@]}"; do "$@" "$robot" & done
  wait_for_robots
  after=$(lab_sent 1)
  awk -v from="$start" -v to="$EPOCHREALTIME" -v bytes=$((after - before)) \
    'BEGIN { printf "%.2f %d\n", to - from, bytes }'
}
wait_for_robots() {
  local job
  for job in $(jobs -p); do
    [[ $job == "${server:-}" ]] || wait "$job" || true
  done
}

# The same of our robots; their own start is no part of it.
fetch_all() {
  local bytes robot
  rm -f "$work"/robot*
  bytes=$(at_once fetch | cut -d' ' -f2)
  for robot in "${robots[@]}"; do fetch_time "$robot"; done | sort -n |
    awk -v bytes="$bytes" 'END { print $1, bytes }'
}
by_rsync() {
  rm -f "$work/robot$1.rsync"  # it would see that there is nothing to do
  on "$1" rsync "rsync://10.77.0.1/routes/route" "$work/robot$1.rsync"
}
by_curl() { on "$1" curl --silent --output "$work/robot$1.curl" http://10.77.0.1:8080/route; }

# What the rivals serve: one file with as many bytes as the route has.
start_rivals() {
  mkdir -p "$work/served"
  head -c "$route_bytes" /dev/urandom >"$work/served/route"
  chmod 755 "$work" "$work/served"
  printf 'use chroot = no\n[routes]\npath = %s/served\n' "$work" >"$work/rsyncd.conf"
  cat >"$work/nginx.conf" <<CONF
daemon off; master_process off; pid $work/nginx.pid; error_log $work/nginx.log;
events {}
http { access_log off; client_body_temp_path $work; proxy_temp_path $work; fastcgi_temp_path $work;
  uwsgi_temp_path $work; scgi_temp_path $work; server { listen 8080; root $work/served; } }
CONF
  on 1 rsync --daemon --no-detach --config="$work/rsyncd.conf" &
  disown
  on 1 nginx -c "$work/nginx.conf" 2>/dev/null &
  disown
  await 30 'the rivals' on 2 curl --silent --head --output /dev/null http://10.77.0.1:8080/route
}

followers() {
  local host what one many
  lab_open
  for ((host = 1; host <= 17; ++host)); do lab_host "$host"; done
  make_route 1000
  lab_rate 1 20mbit
  start_server 1 "$work/server.db"
  start_rivals
  printf '| by | one: s, MB | sixteen: s, MB | times |\n'
  for what in fetch_all 'at_once by_rsync' 'at_once by_curl'; do
    robots=(2)
    # shellcheck disable=SC2086
    one=$(medians $what)
    mapfile -t robots < <(seq 2 17)
    # shellcheck disable=SC2086
    many=$(medians $what)
    awk -v what="$what" -v one="$one" -v many="$many" 'BEGIN {
      split(one, a, " "); split(many, b, " ")
      printf "| %s | %.2f, %.1f | %.2f, %.1f | %.1f, %.1f |\n", what, a[1], a[2] / 1e6, b[1],
        b[2] / 1e6, b[1] / a[1], b[2] / a[2] }'
  done
}

# What the server sends for one fetch beside followers that have all they want, where data is not
# multicast (config/dds/wifi.xml).
idle() {
  local beside running=0 host bytes
  export CYCLONEDDS_URI=file://$here/../../config/dds/wifi.xml
  lab_open
  for ((host = 1; host <= 10; ++host)); do lab_host "$host"; done
  make_route 500
  start_server 1 "$work/server.db"
  robots=(2)
  printf '| idle followers | sent for one fetch, MB | times the route |\n'
  for beside in 0 1 2 4 8; do
    while ((running < beside)); do
      host=$((3 + running++))
      : >"$work/light$host.log"
      on "$host" "$bin/network_bench" light-agent --name "light$host" --route hall --agents 9 \
        >"$work/light$host.log" 2>&1 &
      disown
      await 30 "light$host" says "light$host" fetched
    done
    bytes=$(medians fetch_all | cut -d' ' -f2)
    awk -v beside="$beside" -v bytes="$bytes" -v route="$route_bytes" \
      'BEGIN { printf "| %d | %.1f | %.1f |\n", beside, bytes / 1e6, bytes / route }'
  done
}

# signal_robot NUMBER SIGNAL: to its agent, once that has some of the route.
signal_robot() {
  await 30 "robot$1's first segments" test -s "$work/robot$1.db-wal"
  await 30 "robot$1 to fetch" says "robot$1" 'segments so far'
  sleep 0.3
  pkill "-$2" -f -- "trailcast-agent --name robot$1 "
}

# The slowest of the others' seconds when, while all fetch, the last robot but one is killed and the last
# one hangs.
fetch_beside_dead() {
  local robot gone hangs healthy
  rm -f "$work"/robot*
  gone=${robots[-2]} hangs=${robots[-1]}
  healthy=("${robots[@]:0:${#robots[@]}-2}")
  for robot in "${robots[@]}"; do fetch "$robot" & done
  signal_robot "$gone" KILL &
  signal_robot "$hangs" STOP &
  for robot in "${healthy[@]}"; do
    await "$fetch_timeout" "robot$robot" says "robot$robot" 'are here$'
  done
  pkill -KILL -f -- "trailcast-agent --name robot$hangs " || true
  wait_for_robots
  for robot in "${healthy[@]}"; do fetch_time "$robot"; done | sort -n | tail -1
}

stall() {
  local host plain beside
  lab_open
  for ((host = 1; host <= 11; ++host)); do lab_host "$host"; done
  make_route 300
  lab_rate 1 8mbit
  start_server 1 "$work/server.db"
  mapfile -t robots < <(seq 2 11)
  plain=$(medians fetch_all | cut -d' ' -f1)
  beside=$(medians fetch_beside_dead)
  printf '| ten followers, s | one of them killed, one stopped: the others, s | times |\n'
  awk -v a="$plain" -v b="$beside" 'BEGIN { printf "| %.2f | %.2f | %.2f |\n", a, b, b / a }'
}
