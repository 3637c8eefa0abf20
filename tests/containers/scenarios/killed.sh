# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# The server is killed twice while a scout teaches and followers follow, and a follower once: the
# server comes back with all that it receipted, the follower goes on or says why it cannot.
scenario_killed() {
  start_server
  start_scout
  start_follower follower-1 wide
  start_follower follower-2 hd
  await 120 'the second segment' says scout "segment 1 of 'hall'"
  kill_server
  await 120 'a follower on its way' is_beyond follower-1 15
  kill_server
  start_follower follower-3 firewire
  await 120 'a follower in the middle' is_beyond follower-3 40
  kill_agent follower-3
  expect_taught
  expect_arrived follower-1 follower-2
  await_end 240 follower-3
  expect_went_on_or_said_why follower-3
  expect_sound_store
}

expect_went_on_or_said_why() {
  local status reason
  status=$(status_of "$1")
  reason=$(value_of "$1" reason)
  case $status in
    0)
      expect_arrived "$1"
      note "$1 went on from where it stood"
      ;;
    3)
      [[ -n $reason ]] || fail "$1 did not arrive and does not say why"
      note "$1 did not go on: $reason"
      ;;
    *) fail "$1 ended with status $status" ;;
  esac
}
