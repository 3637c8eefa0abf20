# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh
# Three scouts with other cameras teach routes that meet, the server joins them, and five robots on
# duty with other cameras again are sent to one place over them, while a part of the way is closed
# and one of them is carried off. Routes, robots and places are those of 'trailcast demo --network';
# NETWORK_SEED draws where robots stand, and which of them is carried off.
scenario_network() {
  local plan=$LAB_WORK/network seed=${NETWORK_SEED:-1} scouts robots name place closed
  mkdir -p "$plan"
  "$root/build/release/bin/journeys" plan "$plan" "$seed" >"$plan/plan"
  mapfile -t scouts < <(planned scout)
  mapfile -t robots < <(planned robot)
  place=$(planned place) closed=$(planned closed)
  note "seed $seed"

  contain server server -- --junctions-auto
  await 30 'the server' says server ready
  for name in "${scouts[@]}"; do start_planned "$name" teach; done
  for name in "${scouts[@]}"; do expect_taught "$name"; done
  await 60 'the server to find where they meet' has_said server 'proposed join' 3
  # With other seeds it may be sure of none: the operator confirms what it proposes.
  [[ $seed != 1 ]] || says server 'taken, as --junctions-auto says' ||
    fail 'the server has joined nothing'
  told_network confirm all above 0.7
  # What is too short to be found, the operator knows.
  told_network join hall@3 round@2
  told_network name lab-2 "hall@$place"

  for name in "${robots[@]}"; do start_planned "$name" serve; done
  for name in "${robots[@]}"; do await 60 "$name available" says "$name" "available as '$name'"; done
  for name in "${robots[@]}"; do send_planned "$name"; done
  await 60 'the first of them under way' grep -qs 'under way' "$plan/${robots[0]}.said"
  told_network close hall "$closed"
  await 240 'the end of all missions' all_have_ended
  expect_planned_journeys
  taught_segments=$(value_of scout-1 segments)
  expect_sound_store
}

# planned WHAT: names, or what the plan has of it; field_of NAME FIELD.
planned() { sed -n "s/^$1 \([^ ]*\).*/\1/p" "$plan/plan"; }
field_of() { awk -v name="$1" -v field="$2" '$2 == name { print $field }' "$plan/plan"; }

# start_planned NAME teach|serve: its world is its own, nobody is in its way. Five that look thirty
# times a second are more than two cores can draw.
start_planned() {
  local name=$1 command=$2 carry path options=(--keep-distance 0)
  path=$(field_of "$name" 6) carry=$(field_of "$name" 8)
  [[ $command == serve ]] || options=(--route "$(field_of "$name" 3)" --delivery-timeout 120)
  robot_options=(--env ROBOT_PICTURE_RATE=10 --env ROBOT_SEED="$(field_of "$name" 5)" --env ROBOT_CARRY="${carry#-}")
  start_robot "$name" "$(field_of "$name" 4)" "$command" "${options[@]}"
  robot_options=()
}

send_planned() {
  operate send "$1" goto lab-2 --from "$(field_of "$1" 7)" --wait >"$plan/$1.said" 2>&1 &
}

# Who was carried to where no way leads on waits for one.
all_have_ended() {
  local name waiting=0
  for name in "${robots[@]}"; do
    [[ $(field_of "$name" 8) == - ]] || ! tail -n 1 "$plan/$name.said" | grep -q 'no way leads' ||
      waiting=$((waiting + 1))
  done
  (($(jobs -pr | wc -l) <= waiting))
}

told_network() {
  local told
  told=$(operate network "$@" 2>&1) || fail "network $*: $told"
  note "network $*: $(tail -n 1 <<<"$told")"
}

# All arrive but who was carried off, which may say why it has not; nobody says that it has and is
# elsewhere, nobody has been on what is closed, and all stand.
expect_planned_journeys() {
  local name told
  grep -q 're-planned: hall .* was closed' "$plan"/*.said || fail 'nobody was sent another way'
  for name in "${robots[@]}"; do
    stands "$name" || fail "$name drives although its mission has ended"
    [[ $(field_of "$name" 8) == - ]] || says "$name" 'somebody carries the robot off' ||
      fail "nobody carried $name off"
  done
  for name in "${scouts[@]}" "${robots[@]}"; do
    cp "$(files_of "$name")/truth.csv" "$plan/$name-truth.csv"
  done
  told=$(for name in "${robots[@]}"; do tail -n 1 "$plan/$name.said"; done |
    "$root/build/release/bin/journeys" judge "$plan" "$seed") || fail "not all did as they should: $told"
  while read -r told_line; do note "$told_line"; done <<<"$told"
}
