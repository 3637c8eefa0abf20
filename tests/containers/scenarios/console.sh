# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# The console as docker/README.md runs it: one container beside a server on the host's network, which
# is the lab's here, and docker/compose.console.yaml as it is, whose robot a program then sends.
scenario_console() {
  local told token
  podman run --detach --name server --network host --read-only --env TRAILCAST_NETWORK_INTERFACE=lo \
    --env TRAILCAST_HTTP_HOST=127.0.0.1 --volume server:/data trailcast-server >/dev/null
  podman run --detach --name console --network host --read-only --env TRAILCAST_NETWORK_INTERFACE=lo \
    --env TRAILCAST_HTTP_HOST=127.0.0.1 --memory 512m trailcast-console >/dev/null
  await 60 'the server in the console' shows_server
  podman stop --time 20 console >/dev/null
  [[ $(status_of console) == 0 ]] || fail "the console ended with status $(status_of console)"
  note 'beside a server on its host, the console shows it at http://localhost:8080'
  clear_fleet

  told=$(podman-compose --project-name trailcast --file "$root/docker/compose.console.yaml" up --detach 2>&1) ||
    fail "$told"
  for name in server console scout robot1 robot2; do
    log_of[trailcast_${name}_1]=$(podman inspect --format '{{.HostConfig.LogConfig.Path}}' "trailcast_${name}_1")
  done
  await 60 'the password' says trailcast_console_1 'log in as operator with the password'
  await 60 'the console' says trailcast_console_1 'console: https://0.0.0.0:8080'
  await_end 240 trailcast_scout_1
  token=$(podman exec trailcast_console_1 trailcast-console users add warehouse --role operate \
    --token --users /data/users 2>/dev/null) || fail 'no user can be added'
  told=$(CURL_CA_BUNDLE=$(files_of trailcast_console)/tls.pem CONSOLE=https://localhost:8080 TOKEN=$token \
    timeout 240 "$root/config/examples/send_and_wait.sh" robot1 follow round 2>&1) || fail "$told"
  note "compose.console.yaml: $told"
}
shows_server() {
  curl --silent --max-time 5 http://localhost:8080/api/state | grep '"name":"server"' >/dev/null
}
