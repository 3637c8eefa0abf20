# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# Everybody's network loses packets, 5 % and then 20 % of them, and has 10 Mbit/s.
scenario_lossy() {
  local share
  for share in 0.05 0.20; do
    note "$share of the packets lost, 10 Mbit/s:"
    start_server
    worsen server "$share"
    start_scout
    worsen scout "$share"
    start_follower follower-1 wide
    worsen follower-1 "$share"
    start_follower follower-2 firewire
    worsen follower-2 "$share"
    expect_taught
    expect_arrived follower-1 follower-2
    note_convergence follower-1 follower-2
    note "the server's network: $(traffic_of server)"
    expect_sound_store
    clear_fleet
  done
}

worsen() {
  lose "$1" "$2"
  limit "$1" 10mbit
}
