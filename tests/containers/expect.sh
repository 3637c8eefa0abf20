# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh and the scenarios
# What must hold of a fleet in the end, and what is told of it.

# expect_arrived NAME...: at the path's end, by the robots' true poses.
expect_arrived() {
  local name off
  for name in "$@"; do
    await_end 240 "$name"
    [[ $(status_of "$name") == 0 && $(value_of "$name" state) == ARRIVED ]] ||
      fail "$name did not arrive: $(value_of "$name" reason)"
    off=$(off_at_end "$name") || fail "$name left no true poses"
    note "$name arrived, $off m off"
    awk -v off="$off" 'BEGIN { exit !(off < 0.5) }' || fail "$name is $off m from the path's end"
  done
}
off_at_end() {
  awk -F, -v end="$(tail -n 1 "$path")" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { x = $column["x_m"]; y = $column["y_m"] }
    END { split(end, to, ","); printf "%.2f", sqrt((x - to[1]) ^ 2 + (y - to[2]) ^ 2) }' \
    "$(files_of "$1")/truth.csv"
}

# expect_taught [SCOUT]: it ended, and everything of it was receipted.
expect_taught() {
  local scout=${1:-scout}
  await_end 240 "$scout"
  [[ $(status_of "$scout") == 0 && $(value_of "$scout" unreceipted) == 0 ]] ||
    fail "$scout ended with status $(status_of "$scout"), $(value_of "$scout" unreceipted) segments not acknowledged"
  taught_segments=$(value_of "$scout" segments)
}

# expect_sound_store: the server has the whole route, ends as it should, and its store is sound: all
# that was receipted, each segment and the route as a whole with the scout's digests.
expect_sound_store() {
  local route checked
  use_keys_of operator
  route=$(podman run --rm --network fleet --read-only "${keys_options[@]}" --entrypoint trailcast \
    trailcast-robot routes --name hall --json 2>&1) || fail "the catalog does not answer: $route"
  [[ $route == *'"segments": '$taught_segments,* && $route == *'"state": "active"'* ]] ||
    fail "expected $taught_segments segments, active: $route"
  podman stop --time 20 server >/dev/null
  [[ $(status_of server) == 0 ]] || fail "the server ended with status $(status_of server)"
  checked=$(podman run --rm --read-only --volume server:/data trailcast-server check 2>&1) ||
    fail "the server's store is damaged: $checked"
  note "$(sed -n 's/.*since the start \(.*\)/the server: \1/p' "${log_of[server]}" | tail -n 1)"
  note "all $taught_segments segments are there, $checked"
}

# When the last follower had the whole route, counted from the last segment's teaching.
note_convergence() {
  local follower last seconds=''
  last=$((taught_segments - 1))
  for follower in "$@"; do
    seconds+="$(seconds_between scout "segment $last of" "$follower" ' are here') "
  done
  note "all segments were with the followers $(tr ' ' '\n' <<<"$seconds" | sort -n | tail -n 1) s after the last was taught"
}

# Bytes that NAME received and sent so far.
traffic_of() { awk '/eth0:/ { printf "%.2f MB in, %.2f MB out", $2 / 1e6, $10 / 1e6 }' "/proc/$(pid_of "$1")/net/dev"; }

# seconds_between NAME TEXT NAME TEXT: by the first lines that say so.
seconds_between() {
  local from to
  from=$(grep -m 1 -- "$2" "${log_of[$1]}")
  to=$(grep -m 1 -- "$4" "${log_of[$3]}")
  awk -v from="$(date -d "${from%% *}" +%s.%N)" -v to="$(date -d "${to%% *}" +%s.%N)" \
    'BEGIN { printf "%.1f", to - from }'
}
