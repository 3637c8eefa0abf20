#!/usr/bin/env bash
# The pairs of the given recordings that `./run recordings` judges, as a file for `trailcast judge --pairs`:
#   tests/bench/recordings.sh [plain|disturbed|refreshed|wheels|rates|all] >pairs.csv
# plain: what was taught, the same way at another time, and every recording of another place;
# disturbed: the same ways with what is done to the replays; refreshed: laps of the patio, as they are and
# disturbed, on a route that another lap has refreshed; wheels: laps of two cars, without odometry, with what
# was reckoned from their commands, and with that made wrong in named ways; rates: the same ways as in plain, of
# recordings that are said to have 5, 10, 20 and 30 frames a second. Followers are tuned on donkey_track and
# night_drive alone; what has anything of the others in it is held out.
set -euo pipefail

what=${1:-all}
places=(donkey_track night_drive patio_laps corridor_offset)
declare -A recordings=(
  [donkey_track]='teach replay'
  [night_drive]='drive'
  [patio_laps]='lap0 lap1 lap2 lap3 lap4'
  [corridor_offset]='ref query'
)
# teach, replay, truth, steering
right=(
  'donkey_track/teach donkey_track/replay donkey_track/truth_replay.csv donkey_track/replay_steering.csv'
  'patio_laps/lap0 patio_laps/lap1 patio_laps/truth_lap1.csv'
  'patio_laps/lap0 patio_laps/lap3 patio_laps/truth_lap3.csv'
  'corridor_offset/ref corridor_offset/query corridor_offset/truth_query.csv'
  'corridor_offset/query corridor_offset/ref corridor_offset/truth_ref.csv'
)
# teach, who visits, replay, truth
refreshed=(
  'patio_laps/lap0 patio_laps/lap2 patio_laps/lap1 patio_laps/truth_lap1.csv'
  'patio_laps/lap0 patio_laps/lap1 patio_laps/lap3 patio_laps/truth_lap3.csv'
)
disturbances=(reverse every=3 slower=3 skip=50 jump=3 camera gamma=0.5 gamma=2 noise=12 jpeg=30 smear
  crop=0.15 blur flare)
rate=20

set_of() {
  case "$*" in
    *patio* | *corridor*) echo 'held out' ;;
    *) echo tuned ;;
  esac
}

# pair KIND TEACH REPLAY [DISTURB [TRUTH [STEERING]]]
pair() {
  printf '%s,%s,%s,%s,%s,%s,%s,%s,,,,\n' "$(set_of "$2" "$3")" "$1" "$2" "$3" "${4-}" "${5-}" "${6-}" $rate
}

plain() {
  local place other name strange each
  for place in "${places[@]}"; do
    for name in ${recordings[$place]}; do pair identity "$place/$name" "$place/$name"; done
  done
  for each in "${right[@]}"; do
    # shellcheck disable=SC2086
    set -- $each
    pair right "$1" "$2" '' "$3" "${4-}"
  done
  for place in "${places[@]}"; do
    for name in ${recordings[$place]}; do
      for other in "${places[@]}"; do
        [[ $other == "$place" ]] && continue
        for strange in ${recordings[$other]}; do pair wrong "$place/$name" "$other/$strange"; done
      done
    done
  done
}

disturbed() {
  local each change
  for change in "${disturbances[@]}"; do
    for each in "${right[@]}"; do
      # shellcheck disable=SC2086
      set -- $each
      pair right "$1" "$2" "$change" "$3" "${4-}"
    done
  done
}

refreshed() {
  local each change
  for change in '' "${disturbances[@]}"; do
    for each in "${refreshed[@]}"; do
      # shellcheck disable=SC2086
      set -- $each
      printf '%s,right,%s,%s,%s,%s,,%s,%s,,,\n' 'refreshed' "$1" "$3" "$change" "$4" $rate "$2"
    done
  done
}

# teach, replay, truth, odometry of the teaching, of the replay
wheels=(
  'donkey_track/teach donkey_track/replay donkey_track/truth_replay.csv commanded_teach commanded_replay'
  'race_laps/lap0 race_laps/lap1 race_laps/truth_lap1.csv commanded_lap0 commanded_lap1'
  'race_laps/lap0 race_laps/lap2 race_laps/truth_lap2.csv commanded_lap0 commanded_lap2'
)
noises=(none scale=0.9 scale=1.1 turn=0.8 turn=1.2 drift=3 delay=0.2 slips frozen=2 jumps=2
  scale=1.4+bias=0.1)

# And what was taught itself, and cars of other places, all with odometry.
wheels() {
  local each noise place other
  for each in "${wheels[@]}"; do
    # shellcheck disable=SC2086
    set -- $each
    place=${1%%/*}
    printf 'without,right,%s,%s,,%s,,%s,,,,\n' "$1" "$2" "$3" $rate
    for noise in "${noises[@]}"; do
      printf 'wheels,right,%s,%s,,%s,,%s,,%s,%s,%s\n' "$1" "$2" "$3" $rate \
        "$place/odometry_$4.csv" "$place/odometry_$5.csv" "$noise"
    done
    printf 'wheels,identity,%s,%s,,,,%s,,%s,%s,\n' "$1" "$1" $rate "$place/odometry_$4.csv" \
      "$place/odometry_$4.csv"
  done
  for other in 'race_laps/lap0 donkey_track/replay commanded_lap0 commanded_replay' \
    'donkey_track/teach race_laps/lap1 commanded_teach commanded_lap1' \
    'donkey_track/teach race_laps/lap2 commanded_teach commanded_lap2'; do
    # shellcheck disable=SC2086
    set -- $other
    printf 'wheels,wrong,%s,%s,,,,%s,,%s,%s,\n' "$1" "$2" $rate "${1%%/*}/odometry_$3.csv" \
      "${2%%/*}/odometry_$4.csv"
  done
}

rates() {
  local each hz
  for hz in 5 10 20 30; do
    for each in "${right[@]}"; do
      # shellcheck disable=SC2086
      set -- $each
      printf '%s frames/s,right,%s,%s,,%s,,%s,,,,\n' $hz "$1" "$2" "$3" $hz
      printf '%s frames/s,identity,%s,%s,,,,%s,,,,\n' $hz "$1" "$1" $hz
    done
  done
}

echo 'set,kind,teach,replay,disturb,truth,steering,rate,visits,teach_odometry,replay_odometry,odometry_noise'
case $what in
  plain) plain ;;
  disturbed) disturbed ;;
  refreshed) refreshed ;;
  wheels) wheels ;;
  rates) rates ;;
  all)
    plain
    disturbed
    refreshed
    wheels
    rates
    ;;
  *)
    echo "recordings.sh: expected plain, disturbed, refreshed, wheels, rates or all, not '$what'" >&2
    exit 2
    ;;
esac
