# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# A robot's camera freezes or stops, its odometry stops, its base stops answering: its agent stops
# the robot within half a second, by the robot's own clock, and says what failed.
scenario_broken() {
  start_server_with_route
  expect_stopped camera-freezes 'the same picture again'
  expect_stopped camera-stops 'no picture for'
  expect_stopped odometry-stops 'no odometry for'
  expect_stopped base-stops 'told to drive, and by its odometry it stands'
  expect_sound_store
}

# expect_stopped FAULT WORDS
expect_stopped() {
  local fault=$1 words=$2 after
  robot_options=(--env ROBOT_FAULT="$fault@2")
  start_follower "$fault" webcam
  robot_options=()
  await 60 "'$words'" says "$fault" "$words"
  podman stop --time 20 "$fault" >/dev/null
  after=$(value_of "$fault" told_to_stand_after_s)
  note "$fault: stopped after $after s, saying '$words'"
  awk -v after="$after" 'BEGIN { exit !(after ~ /^[0-9.]+$/ && after <= 0.5) }' ||
    fail "$fault: the robot was told to stand after $after s"
}
