# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# A fleet with keys: a stranger without, and an observer, try to send a robot and to stop one that
# drives. Nothing moves or stands for them, and they are told why; for an operator it does.
scenario_who_may_send() {
  local before
  make_keys_of_roles
  start_server
  start_scout
  expect_taught
  start_robot robot1 wide serve
  await 60 'robot1 available' says robot1 "available as 'robot1'"
  await 60 'its first place' has_place robot1
  before=$(place_of robot1)
  expect_refused observer "of the role 'observer'" send robot1 follow hall
  expect_refused stranger 'neither robot1 nor a route server answered' \
    send robot1 follow hall --timeout 3
  [[ $(cut -d' ' -f2- <<<"$(place_of robot1)") == "$(cut -d' ' -f2- <<<"$before")" ]] ||
    fail "robot1 moved from $before to $(place_of robot1)"

  operate send robot1 follow hall speed 0.5 --id trip >/dev/null || fail 'the operator cannot send'
  await 60 'robot1 on its way' says robot1 'mission trip of operator, follow hall speed 0.5: under way'
  expect_refused observer "of the role 'observer'" stop robot1
  expect_refused stranger 'did not answer' stop robot1 --timeout 3
  expect_refused stranger 'no robot that this is meant for was heard' stop --all --timeout 3
  ! says robot1 'mission trip.*paused' || fail 'robot1 stands for somebody'
  operate stop robot1 >/dev/null || fail 'the operator cannot stop it'
  await 20 'robot1 to stand' says robot1 'mission trip.*paused'
  operate cancel robot1 >/dev/null || fail 'the operator cannot cancel'
  note 'observer and stranger were told that they may not; the operator sent, stopped, cancelled'
  podman stop --time 20 robot1 >/dev/null
  expect_sound_store
}

make_keys_of_roles() {
  local tool=$root/build/release/bin/trailcast member
  "$tool" keys init "$LAB_WORK/authority" >/dev/null
  for member in server:server scout:scout robot1:follower operator:operator observer:observer; do
    "$tool" keys --authority "$LAB_WORK/authority" add --role "${member#*:}" "${member%:*}" >/dev/null
  done
  chown -R 10001:10001 "$LAB_WORK/authority/members"
}
has_place() { [[ -n $(place_of "$1") ]]; }

# expect_refused WHO WORDS COMMAND...
expect_refused() {
  local who=$1 words=$2 told
  shift 2
  told=$(operate_as "$who" "$@" 2>&1) && fail "$who may: $*"
  [[ $told == *"$words"* ]] || fail "$who is not told '$words' but: $told"
}
