# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# Followers that join in the middle of teaching, and one that joins when all is over.
scenario_late() {
  start_server
  start_scout
  await 120 'the third segment' says scout "segment 2 of 'hall'"
  start_follower follower-1 wide
  start_follower follower-2 firewire
  expect_taught
  expect_arrived follower-1 follower-2
  podman rm --force --time 5 follower-1 follower-2 >/dev/null
  start_follower follower-3 webcam
  expect_arrived follower-3
  note "the server's network: $(traffic_of server)"
  expect_sound_store
}
