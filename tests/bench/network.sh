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
# LIGHT_HOSTS (20) says at how many hosts the agents of `fleet`, `neighbours` and `sizes` are.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$(cd "$here/../../build/release/bin" && pwd)
# shellcheck source=tests/bench/network_lab.sh
source "$here/network_lab.sh"

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

# Cyclone alone, its own defaults: the writer at host 1, a late reader at host 2.
plain_uri='<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="eth0"/></Interfaces></General></Domain></CycloneDDS>'
plain_time() {
  local writer
  export CYCLONEDDS_URI=$plain_uri
  on 1 "$bin/network_bench" write-transient-local --samples "$1" >"$work/writer.log" &
  writer=$!
  await 30 'the writer' says writer written
  on 2 timeout "$fetch_timeout" "$bin/network_bench" read-transient-local --samples "$1" |
    sed 's/.*=//'
  kill "$writer"
  unset CYCLONEDDS_URI
}

loss() {
  local share ours plain
  lab_open
  lab_host 1
  lab_host 2
  robots=(2)
  make_route 500
  start_server 1 "$work/server.db"
  printf '| loss | fetch, s | plain, s | times |\n'
  for share in 0 0.01 0.05; do
    lab_loss 1 "$share"
    lab_loss 2 "$share"
    ours=$(medians fetch_all | cut -d' ' -f1)
    plain=$(medians plain_time 500)
    printf '| %s | %s | %s | %s |\n' "$share" "$ours" "$plain" \
      "$(awk -v a="$plain" -v b="$ours" 'BEGIN { printf "%.1f", a / b }')"
  done
}

# ddsperf's throughput with samples of a batch's size, payload in Mbit/s.
wire_rate() {
  local sub
  export CYCLONEDDS_URI=$plain_uri
  on 2 ddsperf -D 8 sub >"$work/sub.log" 2>&1 &
  sub=$!
  on 1 ddsperf -D 7 pub size 48k >/dev/null 2>&1 || true
  wait "$sub" || true
  unset CYCLONEDDS_URI
  sed -n 's/.* rate .*S\/s \([0-9.]*\) Mb\/s (.*/\1/p' "$work/sub.log" | median
}

wire() {
  local rate seconds
  lab_open
  lab_host 1
  lab_host 2
  robots=(2)
  printf '| link | fetch, Mbit/s | ddsperf, Mbit/s | share |\n'
  for rate in 20mbit 100mbit ''; do
    rm -f "$work"/server.db*
    if [[ -n $rate ]]; then
      lab_rate 1 "$rate"
      make_route 500
    else
      on 1 tc qdisc del dev eth0 root
      make_route 25000 # 100 MB: less is over before it is under way
    fi
    start_server 1 "$work/server.db"
    seconds=$(medians fetch_all | cut -d' ' -f1)
    kill "$server"
    wait "$server" || true
    awk -v link="${rate:-unlimited}" -v bytes="$route_bytes" -v s="$seconds" -v wire="$(medians wire_rate)" \
      'BEGIN { ours = bytes * 8 / s / 1e6; printf "| %s | %.1f | %.1f | %.2f |\n", link, ours, wire, ours / wire }'
  done
}

# 100 MB where the link is not limited, and what that costs either side. With CYCLONEDDS_URI, as for
# config/dds/wired.xml, both have those settings; ddsperf has its own.
bulk() {
  local run segments=25000 before took
  lab_open
  lab_host 1
  lab_host 2
  make_route "$segments"
  start_server 1 "$work/server.db"
  server_process
  await 120 'its index of views' says server 'indexed by view'
  TIMEFORMAT='%U %S'
  printf '| fetch, Mbit/s | ddsperf, Mbit/s | share | server, us a segment | follower, us a segment |\n'
  for ((run = 0; run < runs; ++run)); do
    rm -f "$work"/robot*
    before=$(server_cpu)
    took=$({ time fetch 2; } 2>&1)
    awk -v s="$(fetch_time 2)" -v bytes="$route_bytes" -v n="$segments" -v took="$took" \
      -v before="$before" -v after="$(server_cpu)" -v wire="$(wire_rate)" 'BEGIN {
      split(took, cpu, " "); ours = bytes * 8 / s / 1e6
      printf "| %.0f | %.0f | %.2f | %.0f | %.0f |\n", ours, wire, ours / wire,
        (after - before) / n * 1e6, (cpu[1] + cpu[2]) / n * 1e6 }'
  done
}

ingest() {
  local rate
  ip link set lo up
  for rate in 1 10 20 30; do
    rm -f "$work"/server.db*
    : >"$work/server.log"
    "$bin/trailcast-server" --store "$work/server.db" --dds-tag ingest --network-interface lo \
      >"$work/server.log" 2>&1 &
    server=$!
    await 30 'the server' says server ready
    "$bin/network_bench" ingest --tag ingest --rate "$rate"
    kill "$server"
    wait "$server" || true
  done
  for rate in 1 10 50 100; do "$bin/network_bench" commits "$work" --group "$rate"; done
}

# A server with a million routes, taught 200 segments a second and asked for routes: one line for
# each half minute.
memory() {
  local minutes=${1:-60} scouts load query unanswered=0 status=0
  ip link set lo up
  "$bin/network_bench" million "$work/server.db"
  "$bin/trailcast-server" --store "$work/server.db" --dds-tag memory --network-interface lo \
    --http-port 8080 >"$work/server.log" 2>&1 &
  server=$!
  await 30 'the server' says server ready
  "$bin/network_bench" ingest --tag memory --duration $((60 * minutes)) >"$work/ingest.log" &
  scouts=$!
  load=(--dds-tag memory --network-interface lo routes)
  printf 'seconds,resident_mb,segments\n'
  SECONDS=0
  while kill -0 "$scouts" 2>/dev/null; do
    for query in '--tag row-7' '--near-site 5000,5000'; do
      # shellcheck disable=SC2086
      "$bin/trailcast" "${load[@]}" $query --json >/dev/null 2>"$work/query.log" ||
        unanswered=$((unanswered + 1))
    done
    printf '%s,%s,%s\n' "$SECONDS" \
      "$(awk '/VmRSS/ { printf "%.0f", $2 / 1000 }' "/proc/$server/status")" \
      "$(curl -s localhost:8080/metrics | awk '/^trailcast_segments_stored_total / { print $2 }')"
    sleep 25
  done
  wait "$scouts" || status=$?
  cat "$work/ingest.log"
  printf '%s queries not answered within 5 s\n' "$unanswered"
  return "$status"
}

# Datagrams that all hosts together have sent, and received.
datagrams() {
  local host
  for host in "${!host_pid[@]}"; do
    on "$host" awk '/eth0:/ { print $11, $3 }' /proc/net/dev
  done | awk '{ sent += $1; received += $2 } END { print sent, received }'
}

# The latest of the moments at which the agents said WORD, in seconds since BEGAN.
latest() {
  grep -h "^$1 " "$work"/light*.log | sort -k2 -n | awk -v began="$2" 'END { printf "%.1f", $2 - began }'
}

# The server's process, its memory at most and now (MB) and processor time (s).
server_process() {
  process=$(<"/proc/$server/task/$server/children")
  process=${process% }
}
server_peak_mb() { awk '/VmHWM/ { print $2 / 1000 }' "/proc/$process/status"; }
server_mb() { awk '/VmRSS/ { print $2 / 1000 }' "/proc/$process/status"; }
server_cpu() { awk '{ print ($14 + $15) / 100 }' "/proc/$process/stat"; }

# Many light agents join one server at once, each at a host of its own: how long until all have met
# (in a star the server, in a mesh all of them) and have the route, and what that costs. Fails when
# it takes more than the bounds below.
swarm() {
  local agents=${1:-100} discovery=${2:-star} agent began before after said met=met
  local longest_s=60 most_mb=60
  [[ $discovery == star ]] || met=heard-all
  lab_open
  for ((agent = 1; agent <= agents + 1; ++agent)); do lab_host "$agent"; done
  lab_introduce
  make_route 20
  start_server 1 "$work/server.db"
  server_process
  read -r -a before < <(datagrams)
  began=$(cut -d' ' -f1 /proc/uptime)
  for ((agent = 2; agent <= agents + 1; ++agent)); do
    : >"$work/light$agent.log"
    on "$agent" "$bin/network_bench" light-agent --name "light$agent" --route hall \
      --agents "$agents" --discovery "$discovery" >"$work/light$agent.log" 2>&1 &
  done
  said=0
  while ((said < 2 * agents)) && awk -v began="$began" -v most=$longest_s \
    '{ exit !($1 - began < most) }' /proc/uptime; do
    said=$(awk -v met="$met" '$1 == met || $1 == "fetched" { ++n } END { print n + 0 }' "$work"/light*.log)
    sleep 0.2
  done
  read -r -a after < <(datagrams)
  awk -v agents="$agents" -v met="$(latest "$met" "$began")" -v fetched="$(latest fetched "$began")" \
    -v sent=$((after[0] - before[0])) -v received=$((after[1] - before[1])) -v way="$discovery" \
    -v mb="$(server_peak_mb)" -v most="$most_mb" -v cpu="$(server_cpu)" -v complete=$((said == 2 * agents)) '
    BEGIN {
      printf "| agents | discovery | all have met, s | all have the route, s | datagrams sent | received | server, MB | its processor time, s |\n"
      printf "| %d | %s | %s | %s | %d | %d | %.1f | %.2f |\n", agents, way, met, fetched, sent, received, mb, cpu
      if (!complete) print "not all of them within the bound"
      if (mb > most) printf "the server has more than %d MB\n", most
      exit !complete || mb > most }'
}

# WORD was said by so many AGENTS.
all_say() { (($(grep -h "^$1 " "$work"/light*.log | wc -l) >= $2)); }

light_hosts=${LIGHT_HOSTS:-20}  # with several agents each, a participant for every agent
# start_lights AGENTS FLAGS...: they join a server, all at once; how long until it knows them all.
start_lights() {
  local agents=$1 host known=0
  shift
  lab_open
  for ((host = 1; host <= light_hosts + 1; ++host)); do lab_host "$host"; done
  lab_introduce
  make_route 20
  start_server 1 "$work/server.db" --http-port 9464
  server_process
  read -r -a before < <(datagrams)
  began=$(cut -d' ' -f1 /proc/uptime)
  for ((host = 2; host <= light_hosts + 1; ++host)); do
    on "$host" "$bin/network_bench" light-agent --name "light$host" --agents "$agents" \
      --count $((agents / light_hosts)) --discovery star "$@" >"$work/light$host.log" 2>&1 &
    lights+=("$!")
  done
  SECONDS=0
  while ((known < agents && SECONDS < 300)); do
    known=$(on 1 curl -s http://127.0.0.1:9464/metrics | awk '/^trailcast_agents / { print $2 }')
    sleep 0.2
  done
  known_after=$(awk -v began="$began" '{ printf "%.1f", $1 - began }' /proc/uptime)
  read -r -a after < <(datagrams)
  ((known >= agents)) || die "the server knows $known of $agents agents after $known_after s"
  await 60 'all to hear the server' all_say met "$agents"
  met_after=$(latest met "$began")
}

# Datagrams that the server's host could not take, so far.
server_lost() { on 1 awk '/^Udp: [0-9]/ { print $6 }' /proc/net/snmp; }

# A large fleet joins one server, and stays for a while: what an agent costs.
fleet() {
  local agents=${1:-1000} minutes=${2:-1} before after cpu joined_cpu asked
  start_lights "$agents"
  joined_cpu=$(server_cpu)
  printf '| agents | the server knows all, s | all have heard it, s | datagrams sent | server, MB | its processor time, s |\n'
  printf '| %d | %s | %s | %d | %.1f | %.2f |\n' "$agents" "$known_after" "$met_after" \
    $((after[0] - before[0])) "$(server_peak_mb)" "$joined_cpu"
  printf '| minutes later | server, MB | share of a processor | datagrams a second | lost at the server | a catalog answer, s |\n'
  local minute
  for ((minute = 1; minute <= minutes; ++minute)); do
    read -r -a before < <(datagrams)
    cpu=$(server_cpu)
    sleep 60
    read -r -a after < <(datagrams)
    asked=$EPOCHREALTIME
    on 1 "$bin/trailcast" --network-interface eth0 --discovery star routes >/dev/null
    awk -v minute="$minute" -v mb="$(server_mb)" -v cpu="$cpu" -v now="$(server_cpu)" \
      -v sent=$((after[0] - before[0])) -v lost="$(server_lost)" -v from="$asked" -v to="$EPOCHREALTIME" \
      'BEGIN { printf "| %d | %.1f | %.3f | %d | %d | %.2f |\n", minute, mb, (now - cpu) / 60, sent / 60, lost, to - from }'
  done
}

# Fleets of several sizes; the table and a picture of it go to the folder.
sizes() {
  local folder=$1 agents
  shift
  (($#)) || set -- 50 100 200 400 700 1000
  printf 'agents,known_s,met_s,datagrams,server_mb,join_cpu_s,share,lost,answer_s\n' >"$folder/fleet.csv"
  for agents in "$@"; do
    TRAILCAST_LAB='' "$0" fleet "$agents" 1 | tee /dev/stderr |
      awk -v agents="$agents" -F' *[|] *' '$2 !~ /^[0-9]+$/ { next }
        row++ == 0 { known = $3; met = $4; sent = $5; joined = $7; next }
        { mb = $3; share = $4; lost = $6; answer = $7 }
        END { printf "%s,%s,%s,%s,%s,%s,%s,%s,%s\n", agents, known, met, sent, mb, joined, share, lost, answer }' \
        >>"$folder/fleet.csv"
  done
  "$bin/network_bench" plot-fleet "$folder/fleet.csv" "$folder/fleet.png"
}

# Followers of one route, and what each is told of the others.
neighbours() {
  local agents=${1:-200} seconds=${2:-60} before after cpu light
  start_lights "$agents" --follow
  read -r -a before < <(datagrams)
  cpu=$(server_cpu)
  sleep "$seconds"
  read -r -a after < <(datagrams)
  awk -v agents="$agents" -v cpu="$cpu" -v now="$(server_cpu)" -v s="$seconds" -v sent=$((after[0] - before[0])) \
    'BEGIN { printf "%d followers of one route: server %.3f of a processor, %d datagrams a second\n", agents, (now - cpu) / s, sent / s }'
  for light in "${lights[@]}"; do kill "$(<"/proc/$light/task/$light/children")" || true; done
  for light in "${lights[@]}"; do wait "$light" || true; done
  cat "$work"/light*.log | grep '^neighbours' | sort
}

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
  await 30 'the robot' says robot 'on duty'
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

die() {
  printf 'network.sh: %s\n' "$*" >&2
  exit 1
}

main() {
  case ${1:-} in
    followers | idle | stall | loss | wire | bulk | ingest | latency | memory | security | stop | swarm | fleet | neighbours | sizes) ;;
    *)
      die 'say what to measure: followers, idle, stall, loss, wire, bulk, ingest, latency, memory, security, stop, swarm, fleet, neighbours or sizes'
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
