# shellcheck shell=bash disable=SC2034,SC2154  # shared with network.sh
# What packets cost: lost ones, sizes, a link that nothing limits.

# Cyclone alone, its own defaults: the writer at host 1, a late reader at host 2.
plain_uri='<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="eth0"/></Interfaces></General></Domain></CycloneDDS>'
plain_time() {
  local writer
  export CYCLONEDDS_URI=$plain_uri
  on 1 "$bin/network_bench" write-transient-local --samples "$1" >"$work/writer.log" &
  writer=$!
  await 30 'the writer' says writer written
  on 2 timeout "$fetch_timeout" "$bin/network_bench" read-transient-local --samples "$1" |
    sed 's/.*=//'
  kill "$writer"
  unset CYCLONEDDS_URI
}

loss() {
  local share ours plain
  lab_open
  lab_host 1
  lab_host 2
  robots=(2)
  make_route 500
  start_server 1 "$work/server.db"
  printf '| loss | fetch, s | plain, s | times |\n'
  for share in 0 0.01 0.05; do
    lab_loss 1 "$share"
    lab_loss 2 "$share"
    ours=$(medians fetch_all | cut -d' ' -f1)
    plain=$(medians plain_time 500)
    printf '| %s | %s | %s | %s |\n' "$share" "$ours" "$plain" \
      "$(awk -v a="$plain" -v b="$ours" 'BEGIN { printf "%.1f", a / b }')"
  done
}

# ddsperf's throughput with samples of a batch's size, payload in Mbit/s.
wire_rate() {
  local sub
  export CYCLONEDDS_URI=$plain_uri
  on 2 ddsperf -D 8 sub >"$work/sub.log" 2>&1 &
  sub=$!
  on 1 ddsperf -D 7 pub size 48k >/dev/null 2>&1 || true
  wait "$sub" || true
  unset CYCLONEDDS_URI
  sed -n 's/.* rate .*S\/s \([0-9.]*\) Mb\/s (.*/\1/p' "$work/sub.log" | median
}

wire() {
  local rate seconds
  lab_open
  lab_host 1
  lab_host 2
  robots=(2)
  printf '| link | fetch, Mbit/s | ddsperf, Mbit/s | share |\n'
  for rate in 20mbit 100mbit ''; do
    rm -f "$work"/server.db*
    if [[ -n $rate ]]; then
      lab_rate 1 "$rate"
      make_route 500
    else
      on 1 tc qdisc del dev eth0 root
      make_route 25000 # 100 MB: less is over before it is under way
    fi
    start_server 1 "$work/server.db"
    seconds=$(medians fetch_all | cut -d' ' -f1)
    kill "$server"
    wait "$server" || true
    awk -v link="${rate:-unlimited}" -v bytes="$route_bytes" -v s="$seconds" -v wire="$(medians wire_rate)" \
      'BEGIN { ours = bytes * 8 / s / 1e6; printf "| %s | %.1f | %.1f | %.2f |\n", link, ours, wire, ours / wire }'
  done
}

# 100 MB where the link is not limited, and what that costs either side. With CYCLONEDDS_URI, as for
# config/dds/wired.xml, both have those settings; ddsperf has its own.
bulk() {
  local run segments=25000 before took
  lab_open
  lab_host 1
  lab_host 2
  make_route "$segments"
  start_server 1 "$work/server.db"
  server_process
  await 120 'its index of views' says server 'indexed by view'
  TIMEFORMAT='%U %S'
  printf '| fetch, Mbit/s | ddsperf, Mbit/s | share | server, us a segment | follower, us a segment |\n'
  for ((run = 0; run < runs; ++run)); do
    rm -f "$work"/robot*
    before=$(server_cpu)
    took=$({ time fetch 2; } 2>&1)
    awk -v s="$(fetch_time 2)" -v bytes="$route_bytes" -v n="$segments" -v took="$took" \
      -v before="$before" -v after="$(server_cpu)" -v wire="$(wire_rate)" 'BEGIN {
      split(took, cpu, " "); ours = bytes * 8 / s / 1e6
      printf "| %.0f | %.0f | %.2f | %.0f | %.0f |\n", ours, wire, ours / wire,
        (after - before) / n * 1e6, (cpu[1] + cpu[2]) / n * 1e6 }'
  done
}
