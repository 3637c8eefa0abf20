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
  bring_back scout
  back=$SECONDS
  expect_taught
  note "all of it was receipted $((SECONDS - back)) s after the scout was back"
  for robot in 1 2 3 4; do start_follower "follower-$robot" wide; done
  for robot in 1 2 3 4; do
    await 120 "follower-$robot to have the route" says "follower-$robot" 'segments of .* are here'
  done
  part server follower-1
  part server follower-2
  note 'the server is cut off from follower-1 and follower-2'
  expect_arrived follower-1 follower-2 follower-3 follower-4
  says follower-1 "server 'server' is gone" || note 'follower-1 arrived before it missed the server'
  expect_sound_store
}
