# Networks on one machine, for network.sh: a bridge that is the air, and hosts on it, each in a
# network namespace without a name. Everything runs in a process namespace, too: with the script,
# whatever ends it, all processes end and all networks go. Needs root.
lab_enter() {
  [[ -n ${TRAILCAST_LAB:-} ]] ||
    TRAILCAST_LAB=1 exec unshare --net --pid --mount-proc --kill-child -- "$0" "$@"
}

declare -A host_pid

# lab_open: the air.
lab_open() {
  ip link set lo up
  ip link add air type bridge mcast_snooping 0
  ip link set air up
}

# lab_host NUMBER [BRIDGE ADDRESS]: 10.77.0.NUMBER on eth0; from 256 on 10.77.1.0 and so on.
lab_host() {
  local number=$1 bridge=${2:-air} address=${3:-$(lab_address "$1")} pid
  setpriv --pdeathsig KILL unshare --net sleep infinity &
  pid=$!
  disown "$pid"
  until [[ $(readlink "/proc/$pid/ns/net") != $(readlink /proc/self/ns/net) ]] &&
    [[ $(cat "/proc/$pid/comm") == sleep ]]; do sleep 0.01; done
  host_pid[$number]=$pid
  ip link add "port$number" type veth peer name eth0 address "$(lab_mac "$number")" netns "$pid"
  ip link set "port$number" master "$bridge" up
  on "$number" ip link set lo up
  on "$number" ip address add "$address/16" dev eth0
  on "$number" ip link set eth0 up
}

lab_address() { printf '10.77.%d.%d' $(($1 / 256)) $(($1 % 256)); }
lab_mac() { printf '02:00:0a:4d:%02x:%02x' $(($1 / 256)) $(($1 % 256)); }

# lab_introduce: every host knows where every other one is. Without it each asks, and the kernel's
# one table of neighbours, which all hosts share, is full with 1024 of them: 32 hosts.
lab_introduce() {
  local host other
  local -A lab_ips lab_macs
  for host in "${!host_pid[@]}"; do
    lab_ips[$host]=$(lab_address "$host") lab_macs[$host]=$(lab_mac "$host")
  done
  for host in "${!host_pid[@]}"; do
    for other in "${!host_pid[@]}"; do
      [[ $other == "$host" ]] ||
        printf 'neigh replace %s lladdr %s dev eth0 nud permanent\n' "${lab_ips[$other]}" "${lab_macs[$other]}"
    done | on "$host" ip -batch -
  done
}

# on NUMBER COMMAND...: runs it there.
on() {
  local number=$1
  shift
  setpriv --pdeathsig KILL nsenter --target "${host_pid[$number]}" --net -- "$@"
}

# lab_rate NUMBER RATE: what the host sends; lab_loss NUMBER SHARE: of the frames it receives, IP
# fragments one by one.
lab_rate() { on "$1" tc qdisc replace dev eth0 root tbf rate "$2" burst 32kb latency 200ms; }
lab_loss() {
  on "$1" iptables -t raw -F PREROUTING
  [[ $2 == 0 ]] ||
    on "$1" iptables -t raw -A PREROUTING -p udp -m statistic --mode random --probability "$2" -j DROP
}

# Bytes that the host has sent.
lab_sent() { on "$1" awk '/eth0:/ { print $10 }' /proc/net/dev; }
