# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# An available robot is sent along the route before it is there, and the server, then the agent too, are
# killed meanwhile: the mission is done once, nothing moves by itself after a restart, and what was sent
# meanwhile is done after it.
scenario_missions() {
  local told
  start_server_with_route
  told=$(operate send robot1 follow hall --id trip --unheard) || fail "nobody keeps the mission: $told"
  [[ $told == *'a server keeps it'* ]] || fail "the server does not say that it keeps it: $told"
  kill_server
  start_robot robot1 wide serve --name robot1
  await 60 'the mission that was sent before' says robot1 'mission trip of operator, follow hall: under way'
  kill_server
  await 120 'robot1 on its way' is_beyond robot1 30
  kill_agent robot1
  await 60 'the agent to take the mission up' says robot1 'its agent has started again in the middle of mission trip'
  await 30 'the server to know' is_in_state paused
  told=$(operate send robot1 wait 1 --id next) || fail "nobody queues the next mission: $told"
  [[ $told == *'waits: it does mission trip'* ]] || fail "it does not say what it waits for: $told"
  told=$(operate resume robot1) || fail "it does not resume: $told"
  await 120 'the end of the mission' is_in_state arrived
  await 30 'the end of the next one' is_in_state arrived next
  note "sent while out of reach, server killed twice, agent killed: $(off_at_end robot1) m off"
  awk -v off="$(off_at_end robot1)" 'BEGIN { exit !(off < 0.5) }' || fail 'robot1 is not at the end'
  podman stop --time 20 robot1 >/dev/null
  [[ $(status_of robot1) == 0 ]] || fail "robot1 ended with status $(status_of robot1)"
  expect_sound_store
}

is_in_state() {
  local mission=${2:-trip}
  [[ $(operate missions --mission "$mission" --state "$1" 2>/dev/null) == *"$mission"* ]]
}
