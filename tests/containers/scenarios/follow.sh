# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# A scout teaches, five followers with other cameras follow while it does, and all arrive. The
# catalog is asked from every robot's container.
scenario_follow() {
  local cameras=(firewire wide hd webcam fisheye) followers=() robot i
  start_server
  for i in "${!cameras[@]}"; do
    followers+=("follower-$((i + 1))")
    start_follower "${followers[i]}" "${cameras[i]}"
  done
  start_scout
  await 60 'the route in the catalog' says server "'hall'"
  # While its robot stands, teaching does not go on, and no follower is done before it was asked.
  signal_to STOP scout trailcast
  for robot in scout "${followers[@]}"; do
    await 30 "an answer from the catalog in $robot" catalog_lists_route "$robot"
    is_well "$robot" || fail "$robot is not well"
  done
  signal_to CONT scout trailcast
  is_well server || fail 'the server is not well'
  note "the catalog answered in all of scout, ${followers[*]}"
  expect_taught
  expect_arrived "${followers[@]}"
  note_convergence "${followers[@]}"
  note "the server's network: $(traffic_of server)"
  expect_hanging_to_be_noticed
  expect_sound_store
}

expect_hanging_to_be_noticed() {
  podman kill --signal STOP server >/dev/null
  await 20 'the check of health to fail' is_ill server
  podman kill --signal CONT server >/dev/null
  await 20 'the server to be well again' is_well server
  note 'a server that hangs is not well, until it goes on'
}

catalog_lists_route() { podman exec "$1" trailcast routes --name hall --timeout 3 >/dev/null 2>&1; }
is_ill() { ! is_well "$1"; }
