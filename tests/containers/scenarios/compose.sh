# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# docker/compose.yaml and docker/compose.secure.yaml as they are: a scout teaches the laboratory,
# followers keep their distance, all arrive.
scenario_compose() {
  export FOLLOWERS=2 KEYS=$LAB_WORK/authority/members
  expect_compose compose.yaml scout follower_1 follower_2
  clear_fleet
  make_fleet_keys
  expect_compose compose.secure.yaml scout follower-1 follower-2
}

make_fleet_keys() {
  local tool=$root/build/release/bin/trailcast member
  "$tool" keys init "$LAB_WORK/authority" >/dev/null
  for member in server:server scout:scout follower-1:follower follower-2:follower \
    console:operator; do
    "$tool" keys --authority "$LAB_WORK/authority" add --role "${member#*:}" "${member%:*}" >/dev/null
  done
  chown -R 10001:10001 "$KEYS"
}

# expect_compose FILE ROBOT...
expect_compose() {
  local file=$1 name told state token names=()
  shift
  told=$(podman-compose --project-name trailcast --file "$root/docker/$file" up --detach 2>&1) ||
    fail "$told"
  for name in "$@"; do
    [[ $name == *_[0-9] ]] || name+=_1
    names+=("trailcast_$name")
  done
  for name in trailcast_server_1 trailcast_console_1 "${names[@]}"; do
    podman container exists "$name" || fail "$name is not there: $told"
    log_of["$name"]=$(podman inspect --format '{{.HostConfig.LogConfig.Path}}' "$name")
  done
  for name in "${names[@]}"; do
    await_end 300 "$name"
    state=$(value_of "$name" state)
    [[ $(status_of "$name") == 0 ]] || fail "$name ended with status $(status_of "$name")"
    note "$file: $name: $(value_of "$name" segments) segments${state:+, $state}"
  done
  says trailcast_console_1 'console: https://' || fail "the console does not listen"
  token=$(podman exec trailcast_console_1 trailcast-console users add screen --role look --token \
    --users /data/users 2>/dev/null) || fail 'no user can be added to the console'
  told=$(curl --silent --show-error --cacert "$(files_of trailcast_console)/tls.pem" \
    --header "Authorization: Bearer $token" https://localhost:8080/api/state) || fail "the console: $told"
  [[ $told == *'"name":"scout"'* && $told == *'"name":"server"'* ]] || fail "the console shows: $told"
  is_well trailcast_server_1 || fail 'the server is not well'
}
