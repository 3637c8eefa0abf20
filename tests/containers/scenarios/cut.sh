# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# The scout is out of range for a minute while it teaches, and goes on; later the server is cut off
# from half of the followers while they drive, and they drive on.
scenario_cut() {
  local lost=60 back robot
  start_server
  start_scout
  await 120 'the second segment' says scout "segment 1 of 'hall'"
  cut_off scout
  note "the scout is out of range for $lost s, teaching"
  sleep "$lost"
  ended scout && fail 'the scout was done although it was out of range'
  bring_back scout
  back=$SECONDS
  expect_taught
  note "all of it was receipted $((SECONDS - back)) s after the scout was back"
  for robot in follower-1 follower-2; do
    start_follower "$robot" wide
    await 120 "$robot to have the route" says "$robot" 'segments of .* are here'
    part server "$robot"
    note "the server is cut off from $robot, which drives"
  done
  start_follower follower-3 wide
  start_follower follower-4 wide
  expect_arrived follower-1 follower-2 follower-3 follower-4
  says follower-1 "server 'server' is gone" || note 'follower-1 arrived before it missed the server'
  expect_sound_store
}
