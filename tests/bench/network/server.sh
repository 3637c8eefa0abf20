# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# What a server bears: many scouts at once, a million routes.

ingest() {
  local rate
  ip link set lo up
  for rate in 1 10 20 30; do
    rm -f "$work"/server.db*
    : >"$work/server.log"
    "$bin/trailcast-server" --store "$work/server.db" --dds-tag ingest --network-interface lo \
      >"$work/server.log" 2>&1 &
    server=$!
    await 30 'the server' says server ready
    "$bin/network_bench" ingest --tag ingest --rate "$rate"
    kill "$server"
    wait "$server" || true
  done
  for rate in 1 10 50 100; do "$bin/network_bench" commits "$work" --group "$rate"; done
}

# A server with a million routes, taught 200 segments a second and asked for routes: one line for
# each half minute.
memory() {
  local minutes=${1:-60} scouts load query unanswered=0 status=0
  ip link set lo up
  "$bin/network_bench" million "$work/server.db"
  "$bin/trailcast-server" --store "$work/server.db" --dds-tag memory --network-interface lo \
    --http-port 8080 >"$work/server.log" 2>&1 &
  server=$!
  await 30 'the server' says server ready
  "$bin/network_bench" ingest --tag memory --duration $((60 * minutes)) >"$work/ingest.log" &
  scouts=$!
  load=(--dds-tag memory --network-interface lo routes)
  printf 'seconds,resident_mb,segments\n'
  SECONDS=0
  while kill -0 "$scouts" 2>/dev/null; do
    for query in '--tag row-7' '--near-site 5000,5000'; do
      # shellcheck disable=SC2086
      "$bin/trailcast" "${load[@]}" $query --json >/dev/null 2>"$work/query.log" ||
        unanswered=$((unanswered + 1))
    done
    printf '%s,%s,%s\n' "$SECONDS" \
      "$(awk '/VmRSS/ { printf "%.0f", $2 / 1000 }' "/proc/$server/status")" \
      "$(curl -s localhost:8080/metrics | awk '/^trailcast_segments_stored_total / { print $2 }')"
    sleep 25
  done
  wait "$scouts" || status=$?
  cat "$work/ingest.log"
  printf '%s queries not answered within 5 s\n' "$unanswered"
  return "$status"
}
