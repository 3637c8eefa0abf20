# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# A fleet with DDS Security teaches and follows while strangers, each from a container of its own,
# try what they can: none hears anything, the server tells once of each whom it kept out, and the
# fleet does not notice. Meanwhile somebody sniffs on the bridge.
scenario_strangers() {
  local stranger strangers=(plaintext foreign late lax replayed expired observer)
  start_server
  sniff
  start_scout
  expect_taught
  expect_sniffed hall scout
  clear_fleet

  make_keys
  start_server
  sniff
  start_scout
  start_follower follower-1 wide
  for stranger in "${strangers[@]}"; do start_stranger "$stranger"; done
  expect_taught
  expect_arrived follower-1
  for stranger in "${strangers[@]}"; do await_end 60 "$stranger"; done
  expect_stopped_by_own_dds expired 'certificate has expired'
  expect_stopped_by_own_dds observer 'trailcast/route_edits'
  expect_kept_out plaintext "at $(stranger_address plaintext):.*no keys"
  # Which of the two ends finds the other's certificate wrong first depends on who begins.
  expect_kept_out foreign \
    "(operator\..*: its keys are|at $(stranger_address foreign):.* or) of another authority"
  expect_kept_out late 'operator\..*its keys have expired'
  expect_kept_out lax "does not follow the fleet's governance"
  expect_kept_out replayed 'operator\..*its keys were revoked'
  start_follower follower-2 firewire
  expect_arrived follower-2
  expect_sniffed_nothing_of hall follower-1 follower-2
  expect_sound_store
}

# On the bridge, which the network has while it has containers.
sniff() {
  ip link set "$(bridge)" promisc on
  : >"$LAB_WORK/sniffer.log"
  "$bin/stranger" sniff "$(bridge)" "$LAB_WORK/sniffed" >>"$LAB_WORK/sniffer.log" 2>&1 &
  sniffer=$!
  await 10 'the sniffer' grep -q listening "$LAB_WORK/sniffer.log"
}
end_sniffing() {
  kill "$sniffer"
  wait "$sniffer"
}
# As a word of its own: "hall" is in "challenge", too.
reads() { grep -qaw -- "$1" "$LAB_WORK/sniffed"; }
expect_sniffed() {
  local words
  end_sniffing
  for words in "$@"; do
    reads "$words" || fail "the sniffer does not see '$words' said in the open"
  done
  note "without keys, a sniffer reads: $*"
}
expect_sniffed_nothing_of() {
  local words
  end_sniffing
  (($(stat -c %s "$LAB_WORK/sniffed") > 100000)) || fail 'the sniffer heard nearly nothing'
  for words in "$@"; do
    ! reads "$words" || fail "the sniffer reads '$words'"
  done
  note "with keys, in $(stat -c %s "$LAB_WORK/sniffed") bytes, it reads none of: $*"
}

# Of the fleet, and of those who are no members any more or never were. All keys are 20 days old.
make_keys() {
  local fleet=$LAB_WORK/authority outside=$LAB_WORK/strangers name
  in_the_past keys init "$fleet" >/dev/null
  for name in server:server scout:scout follower-1:follower follower-2:follower \
    operator:operator promoted:operator observer:observer lax:observer; do
    add_member "$fleet" "${name#*:}" "${name%:*}" 50
  done
  add_member "$fleet" operator expired 10
  mkdir -p "$outside"
  cp -a "$fleet/members/expired" "$outside/expired"
  cp -a "$fleet/members/expired" "$outside/late"
  cp -a "$fleet/members/observer" "$outside/observer"
  # Its program heeds no permissions, by a governance that asks for none.
  cp -a "$fleet/members/lax" "$outside/lax"
  forge_governance "$fleet" "$outside/lax"
  # It kept the keys, the permissions and the list of the revoked from when it was an operator.
  cp -a "$fleet/members/promoted" "$outside/replayed"
  "$bin/trailcast" keys --authority "$fleet" renew --role observer promoted >/dev/null
  in_the_past keys init "$LAB_WORK/other" >/dev/null
  add_member "$LAB_WORK/other" operator desk 50
  cp -a "$LAB_WORK/other/members/desk" "$outside/foreign"
  chown -R 10001:10001 "$fleet/members" "$outside"
  cp "$fleet/name.key" "$outside/name.key"
  chmod 644 "$outside/name.key"
}
add_member() {
  in_the_past keys --authority "$1" add --role "$2" --days "$4" "$3" >/dev/null
}
bin=$root/build/release/bin
faketime=$(dpkg -L libfaketime | grep '/libfaketime\.so')
in_the_past() { LD_PRELOAD=$faketime FAKETIME=-20d "$bin/trailcast" "$@"; }
forge_governance() {
  openssl smime -verify -noverify -text -in "$2/governance.p7s" -out "$LAB_WORK/governance.xml" 2>/dev/null
  sed -i 's#\(<enable_\(read\|write\)_access_control>\)true#\1false#' "$LAB_WORK/governance.xml"
  openssl smime -sign -in "$LAB_WORK/governance.xml" -text -out "$2/governance.p7s" \
    -signer "$1/authority.pem" -inkey "$1/authority.key" 2>/dev/null
}

# Joins in a container of that name with the keys of that name, if it has any.
start_stranger() {
  local keys=$LAB_WORK/strangers/$1 options=() words=(listen 15)
  if [[ -d $keys ]]; then
    options+=(--volume "$keys:/stranger:ro" --volume "$LAB_WORK/strangers/name.key:/name.key:ro")
    words+=(/stranger /name.key)
  fi
  # Fifteen days ago its keys were good.
  [[ $1 != late ]] || options+=(--volume "$faketime:/faketime.so:ro" --env LD_PRELOAD=/faketime.so
    --env FAKETIME=-15d --env FAKETIME_DONT_FAKE_MONOTONIC=1)
  contain "$1" robot --entrypoint /usr/local/bin/stranger \
    --volume "$bin/stranger:/usr/local/bin/stranger:ro" "${options[@]}" -- "${words[@]}"
  address_then[$1]=$(address_of "$1")
}
declare -A address_then
stranger_address() { echo "${address_then[$1]//./\\.}"; }

expect_stopped_by_own_dds() {
  [[ $(value_of "$1" joined) == no ]] || fail "$1 joined"
  says "$1" "$2" || fail "$1 was stopped for another reason than '$2'"
  note "$1: stopped by its own DDS"
}

# expect_kept_out NAME WHY: by the server, which tells so in one line; it heard nothing.
expect_kept_out() {
  local told
  [[ $(value_of "$1" joined) == yes && $(value_of "$1" heard) == 0 ]] ||
    fail "$1 joined: $(value_of "$1" joined), heard $(value_of "$1" heard) messages"
  await 20 "the server to tell that it kept out $1" grep -Eq "kept out: .*$2" "${log_of[server]}"
  told=$(grep -Ec -- "kept out: .*$2" "${log_of[server]}")
  [[ $told == 1 ]] || fail "the server told $told times that it kept out $1"
  note "$1: $(grep -Eo "kept out: .*$2.*" "${log_of[server]}")"
}
