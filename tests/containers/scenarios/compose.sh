# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# docker/compose.yaml as it is: a scout teaches the laboratory, followers keep their distance, all
# arrive.
scenario_compose() {
  local name told
  local robots=(trailcast_scout_1 trailcast_follower_1 trailcast_follower_2)
  told=$(FOLLOWERS=2 podman-compose --project-name trailcast \
    --file "$root/docker/compose.yaml" up --detach 2>&1) || fail "$told"
  for name in trailcast_server_1 "${robots[@]}"; do
    podman container exists "$name" || fail "$name is not there: $told"
    log_of[$name]=$(podman inspect --format '{{.HostConfig.LogConfig.Path}}' "$name")
  done
  for name in "${robots[@]}"; do
    await_end 300 "$name"
    [[ $(status_of "$name") == 0 ]] || fail "$name ended with status $(status_of "$name")"
    note "$name: $(value_of "$name" segments) segments, $(value_of "$name" state)"
  done
  podman healthcheck run trailcast_server_1 >/dev/null || fail 'the server is not well'
}
