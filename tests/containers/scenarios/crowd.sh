# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# A hundred agents without robots (status, queries, fetches), each at a network host of its own, join
# one server at once. What it costs, and the bounds, are tests/bench/network.sh's.
scenario_crowd() {
  local said
  said=$("$root/tests/bench/network.sh" swarm 100 2>&1) || fail "$said"
  while read -r line; do note "$line"; done <<<"$said"
}
