#!/usr/bin/env bash
# The pairs of the given recordings that `./run recordings` judges, as a file for `trailcast judge --pairs`:
#   tests/bench/recordings.sh [plain|disturbed|refreshed|all] >pairs.csv
# plain: what was taught, the same way at another time, and every recording of another place;
# disturbed: the same ways with what is done to the replays; refreshed: laps of the patio, as they are and
# disturbed, on a route that another lap has refreshed. Followers are tuned on donkey_track and
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
  crop=0.15)
rate=20

set_of() {
  case "$*" in
    *patio* | *corridor*) echo 'held out' ;;
    *) echo tuned ;;
  esac
}

# pair KIND TEACH REPLAY [DISTURB [TRUTH [STEERING]]]
pair() {
  printf '%s,%s,%s,%s,%s,%s,%s,%s,\n' "$(set_of "$2" "$3")" "$1" "$2" "$3" "${4-}" "${5-}" "${6-}" $rate
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
      printf '%s,right,%s,%s,%s,%s,,%s,%s\n' 'refreshed' "$1" "$3" "$change" "$4" $rate "$2"
    done
  done
}

echo 'set,kind,teach,replay,disturb,truth,steering,rate,visits'
case $what in
  plain) plain ;;
  disturbed) disturbed ;;
  refreshed) refreshed ;;
  all)
    plain
    disturbed
    refreshed
    ;;
  *)
    echo "recordings.sh: expected plain, disturbed, refreshed or all, not '$what'" >&2
    exit 2
    ;;
esac
