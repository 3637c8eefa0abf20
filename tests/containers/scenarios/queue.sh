# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# Two followers on one route keep their distance: when the first stops, the second stops behind it,
# and both go on after.
scenario_queue() {
  local apart
  start_server_with_route
  start_robot follower-1 webcam replay --route hall
  await 120 'the first follower on its way' is_beyond follower-1 50
  signal_to STOP follower-1 trailcast
  start_robot follower-2 wide replay --route hall
  await 120 'the second to wait' says follower-2 'waits for follower-1'
  apart=$(sed -n 's/.*waits for follower-1, \([0-9.]*\) m ahead.*/\1/p' "${log_of[follower-2]}" | tail -n 1)
  note "follower-2 waits $apart m behind follower-1"
  awk -v apart="$apart" 'BEGIN { exit !(apart >= 1.0 && apart <= 2.0) }' ||
    fail "the followers are $apart m apart, expected about 1.5 m"
  ended follower-2 && fail 'follower-2 did not wait'
  signal_to CONT follower-1 trailcast
  expect_arrived follower-1 follower-2
  expect_sound_store
}
