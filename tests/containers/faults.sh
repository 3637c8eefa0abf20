# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh and the scenarios
# What may happen to programs, and to the network of a container, staged from outside.

kill_server() {
  local before
  before=$(grep -c ' ready' "${log_of[server]}")
  podman kill --signal KILL server >/dev/null
  await 10 'the death of the server' ended server
  podman start server >/dev/null
  await 30 'the server to come back' has_said server ' ready' $((before + 1))
  note 'server killed, and back'
}
has_said() { (($(grep -c -- "$2" "${log_of[$1]}") >= $3)); }

# The agent in the container NAME; its robot, and the container, live on.
kill_agent() {
  signal_to KILL "$1" trailcast-agent
  await 30 "$1 to start again" says "$1" 'the agent was killed'
  note "$1's agent killed, and started again"
}

in_network_of() {
  local name=$1
  shift
  nsenter --target "$(pid_of "$name")" --net -- "$@"
}

# Of the frames that NAME receives from others, a SHARE (0.05) is lost, IP fragments one by one.
lose() {
  in_network_of "$1" iptables -t raw -A PREROUTING -i eth0 -p udp \
    -m statistic --mode random --probability "$2" -j DROP
}

# How fast NAME sends, as '10mbit'.
limit() { in_network_of "$1" tc qdisc replace dev eth0 root tbf rate "$2" burst 32kb latency 200ms; }

bridge() { podman network inspect fleet | sed -n 's/.*"network_interface": "\(.*\)".*/\1/p'; }
# The bridge's port that NAME's interface is plugged into.
port_of() {
  local index
  index=$(in_network_of "$1" ip -o link show eth0 | sed -n 's/.*eth0@if\([0-9]*\):.*/\1/p')
  ip -o link | sed -n "s/^$index: \([^@:]*\).*/\1/p"
}
# Out of range: its frames are lost both ways, and its interface does not notice.
cut_off() { ip link set "$(port_of "$1")" nomaster; }
bring_back() { ip link set "$(port_of "$1")" master "$(bridge)"; }

# ONE and OTHER hear nothing of each other any more.
part() {
  in_network_of "$1" iptables -A INPUT -s "$(address_of "$2")" -j DROP
  in_network_of "$2" iptables -A INPUT -s "$(address_of "$1")" -j DROP
}
