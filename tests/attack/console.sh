#!/usr/bin/env bash
# Other people's tools against a console that serves users over TLS: testssl.sh and sslscan on what it
# offers, slowhttptest on what clients that are slow on purpose cost others. Ends with 1 where they
# find what is not explained below. Needs root, the packages of group "attack", and trailcast-console.
#   tests/attack/console.sh [scan] [slow]
# without words both. SECONDS_EACH (15): how long each attack lasts.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$here/../../build/release/bin
seconds_each=${SECONDS_EACH:-15}

# Findings, by their names, and why they are none of the console's.
declare -A explained=(
  [testssl:engine_problem]='it is about the OpenSSL that testssl.sh itself uses'
  [testssl:cert_revocation]='this certificate was made here and signed by itself: no authority could revoke it'
)

# A network of its own, whose loopback has as many addresses as are wanted, each of which is seen as
# the sender's where it is sent to, and packets as long as Ethernet's: of longer ones the kernel keeps
# whole answers, and nobody is ever slow to take them.
if [[ -z ${TRAILCAST_ATTACK:-} ]]; then
  TRAILCAST_ATTACK=1 exec unshare --net --pid --mount-proc --kill-child -- "$0" "$@"
fi
ip link set lo mtu 1500 up
readonly strangers=8
for number in $(seq $strangers); do
  ip route replace local "127.0.1.$number" dev lo src "127.0.1.$number" table local
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
findings=0
# found NAME WHAT
found() {
  if [[ -n ${explained[$1]:-} ]]; then
    printf '  %s: %s (explained: %s)\n' "$1" "$2" "${explained[$1]}"
  else
    printf '  FOUND %s: %s\n' "$1" "$2"
    findings=$((findings + 1))
  fi
}

openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 365 -subj /CN=localhost \
  -addext subjectAltName=DNS:localhost -keyout tls.key -out tls.pem 2>/dev/null
"$bin/trailcast-console" users add watcher --role look --token --users users >token 2>/dev/null
: >console.log
"$bin/trailcast-console" --http-host 0.0.0.0 --http-port 0 --users users --tls-certificate tls.pem \
  --tls-key tls.key --network-interface lo --dds-tag attack >console.log 2>&1 &
console=$!
until port=$(sed -n 's|.*https://.*:\([0-9]*\)$|\1|p' console.log) && [[ -n $port ]]; do
  kill -0 $console 2>/dev/null || { cat console.log >&2; exit 1; }
  sleep 0.1
done

scan() {
  printf 'testssl.sh %s\n' "$(testssl --version 2>/dev/null | grep -m1 -o 'testssl *[0-9.]*' | grep -o '[0-9].*')"
  # Without trying each cipher, which sslscan does, and what old browsers would choose.
  TERM=dumb testssl --quiet --color 0 --warnings off --nodns none --ip 127.0.0.1 --add-ca "$work/tls.pem" \
    --jsonfile "$work/testssl.json" --protocols --std --pfs --server-preference --server-defaults \
    --headers --vulnerable --grease "https://localhost:$port" </dev/null >testssl.log 2>&1 || true
  local id severity finding
  while IFS=$'\t' read -r id severity finding; do
    found "testssl:$id" "$severity, $finding"
  done < <(jq -r '.[] | select(.severity | IN("OK", "INFO") | not) | [.id, .severity, .finding] | @tsv' testssl.json)
  # It has looked at all it was asked for, from the first to the last.
  for id in TLS1_3 heartbleed HSTS RC4 grease; do
    jq -e --arg id "$id" 'any(.id | ascii_downcase | startswith($id | ascii_downcase))' testssl.json >/dev/null ||
      found "testssl:incomplete" "it says nothing of $id"
  done
  printf '  %d findings in all\n' "$(jq length testssl.json)"

  printf 'sslscan %s\n' "$(sslscan --version --no-colour | grep -m1 -o '[0-9][0-9.]*[0-9]')"
  sslscan --no-colour --show-sigs --xml=sslscan.xml "localhost:$port" >sslscan.log
  # An element a line: what is on, and weaker than 128 bits, or that it calls weak.
  while IFS=$'\t' read -r id finding; do found "sslscan:$id" "$finding"; done < <(awk '
    function is(name) { return match($0, " " name "=\"[^\"]*\"") ? substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 4) : "" }
    function say(id) { gsub(/^ +/, ""); print id "\t" $0 }
    /<protocol / && is("enabled") == 1 && !(is("type") == "tls" && is("version") ~ /^1[.][23]$/) { say("protocol") }
    /<cipher / && (is("bits") < 128 || is("strength") !~ /^(acceptable|strong)$/) { say("cipher") }
    /<group / && is("bits") < 128 { say("group") }
    /<compression / && is("supported") == 1 { say("compression") }
    /<renegotiation / && is("supported") == 1 && is("secure") != 1 { say("renegotiation") }
    /<heartbleed / && is("vulnerable") == 1 { say("heartbleed") }
    /<expired>true/ { say("certificate") }' sslscan.xml)
  for id in '<cipher .*TLSv1.2' '<cipher .*TLSv1.3' '<group ' '<renegotiation ' '<heartbleed ' '<expired>'; do
    grep -q "$id" sslscan.xml || found "sslscan:incomplete" "it says nothing of $id"
  done
}

# watch PROCESS...: until they have ended, what a user of another address is answered; how often, how
# many times not, how long the slowest took, in ms, and how many MB the kernel had of TCP at most.
watch() {
  local process
  : >watched
  for process in "$@"; do
    while kill -0 "$process" 2>/dev/null; do
      curl --silent --output /dev/null --max-time 20 --interface 127.0.0.2 --cacert tls.pem \
        --header "Authorization: Bearer $(<token)" --write-out '%{http_code} %{time_total} ' \
        "https://localhost:$port/api/state" >>watched || true
      awk '/^TCP:/ { print $NF * 4 / 1024 }' /proc/net/sockstat >>watched
      sleep 0.2
    done
  done
  awk '$1 != 200 { failed++ } $2 > slowest { slowest = $2 } $3 > memory { memory = $3 }
    END { print NR, failed + 0, int(1000 * slowest), int(memory) }' watched
}

# slow NAME ADDRESSES PATH OPTION...: of slowhttptest, which says each second how it is answered itself.
slow() {
  local name=$1 addresses=$2 path=$3 number processes=() answers failed slowest memory_mb shut_out seconds
  shift 3
  for number in $(seq "$addresses"); do
    slowhttptest "$@" -c 400 -r 100 -l "$seconds_each" -p 5 -g -o "slow$number" \
      -u "https://127.0.1.$number:$port$path" >"slow$number.log" 2>&1 &
    processes+=($!)
  done
  if ((addresses == 0)); then
    sleep "$seconds_each" &
    processes=($!)
  fi
  read -r answers failed slowest memory_mb < <(watch "${processes[@]}")
  for number in $(seq "$addresses"); do
    [[ -s slow$number.csv ]] || found "slow:incomplete" "$name: $(tail -n 2 "slow$number.log")"
  done
  read -r shut_out seconds < <(find . -name 'slow*.csv' -exec tail -q -n +2 {} + |
    awk -F, '$5 == 0 { n++ } END { print n + 0, NR }')
  rm -f slow*.csv slow*.html
  printf '| %s | %d | %d | %d | %d | %d of %d | %d |\n' "$name" "$addresses" "$answers" "$failed" \
    "$slowest" "$shut_out" "$seconds" "$memory_mb"
  ((answers > 0 && failed == 0)) || found "slow:unanswered" "$name from $addresses addresses: $failed of $answers"
  ((slowest < 3000)) || found "slow:late" "$name from $addresses addresses: an answer after $slowest ms"
  ((addresses == 0 || shut_out < seconds)) || found "slow:shut-out" "$name from $addresses addresses: its own probes are not answered"
  ((memory_mb < 256)) || found "slow:memory" "$name from $addresses addresses: $memory_mb MB of TCP in the kernel"
}

slow_all() {
  local addresses ranges
  printf 'slowhttptest %s\n\n' "$(slowhttptest -h 2>/dev/null | grep -o 'version [0-9.]*' || true)"
  printf '| attack | addresses | answers to another user | failed | slowest, ms | seconds in which slowhttptest itself is not answered | TCP memory, MB |\n'
  printf '| --- | --- | --- | --- | --- | --- | --- |\n'
  slow none 0 /
  for addresses in 1 $strangers; do
    slow 'slow headers (-H)' "$addresses" / -H -i 2
    slow 'slow body (-B)' "$addresses" /api/log-in -B -i 2 -f application/json
    slow 'slow reading (-X)' "$addresses" /page.js -X -n 2 -w 1 -y 16 -z 5
    slow 'ranges (-R)' "$addresses" /page.js -R -t GET -a 1 -b 1000
  done
}

(($#)) || set -- scan slow
[[ " $* " != *' scan '* ]] || scan
[[ " $* " != *' slow '* ]] || slow_all
kill -0 $console 2>/dev/null || found 'console:ended' "$(tail -n 3 console.log)"
printf '%d findings that are not explained\n' "$findings"
((findings == 0))
