# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# Many agents, without robots, at one server.

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
