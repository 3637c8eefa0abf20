# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# Two sites: the route server's, 10.77.0.0/16, and one of robots behind NAT, 10.78.0.0/16, with a line
# between that delays and loses, and WireGuard in user space over it, set up by config/vpn/.
#
#   server, robots, gateway 9 --- wan --- NAT 58 --- gateway 59, robots

# forwards NUMBER: the host passes on what is for others.
forwards() { on "$1" sysctl --quiet net.ipv4.ip_forward=1; }

sites_open() {
  local host
  lab_open
  ip link add field type bridge mcast_snooping 0
  ip link set field up
  for host in 1 2 9; do lab_host "$host"; done
  for host in 52 58 59; do lab_host "$host" field "10.78.0.$((host - 50))"; done
  for host in 9 58 59; do forwards "$host"; done
  on 1 ip route add 10.78.0.0/16 via 10.77.0.9
  on 52 ip route add default via 10.78.0.8
  on 59 ip route add default via 10.78.0.8
}

# line FLAGS...: the line between the sites, as network_bench link has it.
line() {
  if [[ -n ${line_pid:-} ]]; then
    kill "$line_pid"
    wait "$line_pid" || true
  fi
  : >"$work/line.log"
  "$bin/network_bench" link "${host_pid[9]}" "${host_pid[58]}" "$@" >"$work/line.log" 2>&1 &
  line_pid=$!
  await 10 'the line' says line ready
  on 9 ip address add 203.0.113.1/30 dev wan
  on 58 ip address add 203.0.113.2/30 dev wan
  for end in 9 58; do on "$end" ip link set wan up; done
  on 58 ip route replace default via 203.0.113.1
}

# NAT 58 lets out whatever its site sends, and in only the answers.
nat() {
  on 58 iptables -t nat -A POSTROUTING -o wan -j MASQUERADE
  on 58 iptables -A FORWARD -i wan -m state ! --state ESTABLISHED,RELATED -j DROP
}

# vpn: config/vpn/ with keys in it, brought up at both gateways. The sockets of WireGuard's two
# processes lie in a folder of this script's own.
vpn() {
  local site
  mkdir -p /var/run/wireguard
  mount -t tmpfs none /var/run/wireguard
  for site in server robot; do
    (umask 077 && wg genkey >"$work/$site.key")
    wg pubkey <"$work/$site.key" >"$work/$site.pub"
  done
  for site in server robot; do
    sed -e "s#SERVER_SITE_PRIVATE_KEY#$(cat "$work/server.key")#" \
      -e "s#SERVER_SITE_PUBLIC_KEY#$(cat "$work/server.pub")#" \
      -e "s#ROBOT_SITE_PRIVATE_KEY#$(cat "$work/robot.key")#" \
      -e "s#ROBOT_SITE_PUBLIC_KEY#$(cat "$work/robot.pub")#" \
      -e 's#SERVER_SITE_ADDRESS#203.0.113.1#' \
      "$here/../../config/vpn/$site-site.conf" >"$work/$site-site.conf"
    chmod 600 "$work/$site-site.conf"
  done
  on 9 wg-quick up "$work/server-site.conf" >"$work/vpn-server.log" 2>&1
  on 59 wg-quick up "$work/robot-site.conf" >"$work/vpn-robot.log" 2>&1
  on 52 ip route add 10.77.0.0/16 via 10.78.0.9
}

# cut, mend: the line's end at the NAT.
cut_line() {
  on 58 iptables -t raw -I PREROUTING -i wan -j DROP
  on 58 iptables -t mangle -I POSTROUTING -o wan -j DROP
}
mend_line() {
  on 58 iptables -t raw -D PREROUTING -i wan -j DROP
  on 58 iptables -t mangle -D POSTROUTING -o wan -j DROP
}

# As a loss of power would.
kill_server() {
  [[ -n ${server:-} ]] || return 0
  kill -KILL "$server"
  wait "$server" 2>/dev/null || true
  server=
  await 10 "the server's end" server_gone
}
server_gone() { ! pgrep -x trailcast-serve >/dev/null; }

# server_anew: with an empty store.
server_anew() {
  kill_server
  rm -f "$work"/server.db*
  start_server 1 "$work/server.db"
}

# deliver HOST FLAGS...: what a scout has taught, to the server; at most ten minutes.
deliver() {
  local host=$1
  shift
  rm -f "$work"/scout.db*
  cp "$work/taught.db" "$work/scout.db"
  on "$host" "$bin/trailcast-agent" --name scout --network-interface eth0 --discovery star \
    --store "$work/scout.db" deliver --delivery-timeout 600 "$@" >"$work/scout.log" 2>&1
}

# Seconds from the server's first word to the last receipt.
delivery_time() {
  awk '
    function at(clock, part) { split(clock, part, ":"); return part[1] * 3600 + part[2] * 60 + part[3] }
    /server .* is there$/ { if (!from) from = at($1) }
    /robots follow route/ { to = at($1) }
    /^unreceipted=0$/ { whole = 1 }
    END { if (whole) printf "%.1f\n", to - from; else print "failed" }' "$work/scout.log"
}

# Segments that the scout has receipts for, all of the route, and that are not whole in the store
# of the server, which was killed.
receipts_lost() {
  local kept=0
  if "$bin/trailcast-server" --store "$work/server.db" check >"$work/check.log" 2>&1; then
    kept=$("$bin/trailcast" export hall --store "$work/server.db" --out "$work/kept.trailcast" --force |
      sed -n 's/.*, \([0-9]*\) segments, .*/\1/p')
  fi
  echo $((route_segments - kept))
}

# IP fragments that the host has sent.
fragments_of() { on "$1" awk '/^Ip: [0-9]/ { print $20 }' /proc/net/snmp; }

holds_a_quarter() {
  (($(cat "$work"/server.db "$work"/server.db-wal 2>/dev/null | wc -c) > route_bytes / 4))
}

# measure_site NAME HOST FLAGS...: one line of the table. With `outage` set, the line is cut for so
# many seconds while the route is delivered.
measure_site() {
  local name=$1 host=$2 found query lost='-' seconds fragments
  shift 2
  fragments=$(fragments_of "$host")
  server_anew
  if ! on "$host" "$bin/network_bench" meet --queries 1 --patience 30 "$@" >/dev/null 2>"$work/meet.log"; then
    printf '| %s | not within 30 s | | | | | |\n' "$name"
    return
  fi
  found=$(for ((run = 0; run < 5; ++run)); do
    on "$host" "$bin/network_bench" meet --queries 1 "$@" | cut -d' ' -f1
  done | median)
  query=$(on "$host" "$bin/network_bench" meet --queries 100 "$@")
  if [[ -n ${outage:-} ]]; then
    deliver "$host" "$@" &
    local delivery=$!
    await 60 'a quarter of the route at the server' holds_a_quarter
    cut_line
    sleep "$outage"
    mend_line
    wait "$delivery" || true
  else
    deliver "$host" "$@" || true
  fi
  seconds=$(delivery_time)
  kill_server
  [[ $seconds == failed ]] || lost=$(receipts_lost)
  awk -v name="$name" -v found_ms="$found" -v query="$query" -v seconds="$seconds" -v lost="$lost" \
    -v fragments=$(($(fragments_of "$host") - fragments)) 'BEGIN {
      split(query, q, " ")
      printf "| %s | %.2f | %s | %s | %s | %s | %s |\n", name, found_ms / 1000, q[2], q[3], seconds,
        lost, fragments }'
}

sites() {
  local remote=(--server-address 10.77.0.1) made
  route_segments=${1:-1300}
  made=$("$bin/network_bench" store "$work/taught.db" --segments "$route_segments")
  route_bytes=$(cut -d' ' -f3 <<<"$made")
  sites_open
  line
  nat
  printf '# %s; %s; %s; load %s\n' "$made" "$(date --utc +%F)" \
    "$(nproc) x $(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1)" "$(cut -d' ' -f1 /proc/loadavg)"
  printf '| network | found, s | catalog query, ms: median | p99 | route delivered, s | receipts lost | IP fragments |\n'
  printf '| --- | --- | --- | --- | --- | --- | --- |\n'
  measure_site 'one LAN, by multicast' 2
  measure_site 'two sites, NAT, no VPN' 52 "${remote[@]}"
  vpn
  export CYCLONEDDS_URI="file://$here/../../config/dds/vpn.xml"
  measure_site 'two sites, NAT, VPN' 52 "${remote[@]}"
  line --delay 100
  measure_site 'the same, 100 ms each way' 52 "${remote[@]}"
  outage=60 measure_site '100 ms each way, gone for 60 s meanwhile' 52 "${remote[@]}"
  line --delay 100 --loss 0.01
  measure_site '100 ms and 1 % lost each way' 52 "${remote[@]}"
  line --delay 100 --loss 0.05
  measure_site '100 ms and 5 % lost each way' 52 "${remote[@]}"
  unset CYCLONEDDS_URI
  measure_site 'the same without dds/vpn.xml' 52 "${remote[@]}"
}
