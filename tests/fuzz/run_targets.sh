#!/usr/bin/env bash
# Runs every fuzz target in a build folder for some seconds, two at a time, and says how each fared;
# fails if one found something. Inputs that are worth keeping go to BUILD/corpus, those that broke
# something, with a log, to BUILD/findings.
#   tests/fuzz/run_targets.sh BUILD SECONDS [TARGET...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 seconds=$2
shift 2
findings="$build/findings"
# Files of inputs, and the stores made of them, are written at every run: in memory where there is some.
scratch=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$findings"

run_target() {
  local target=$1 log="$findings/$1.log" status=0 seeds=()
  [[ ! -d $here/corpus/$target ]] || seeds+=("$here/corpus/$target")
  [[ $target != segment && $target != route_file ]] || seeds+=("$here/../golden")
  [[ $target != bag ]] || seeds+=("$here/../unit/bag/others")
  mkdir -p "$build/corpus/$target"
  TMPDIR=$scratch "$build/bin/fuzz_$target" -max_total_time="$seconds" -timeout=20 \
    -rss_limit_mb=2048 -malloc_limit_mb=256 -print_final_stats=1 -artifact_prefix="$findings/$target-" \
    "$build/corpus/$target" "${seeds[@]}" >"$log" 2>&1 </dev/null || status=$?
  awk -v target="$target" -v failed="$status" '
    match($0, / cov: [0-9]+/) {
      last = substr($0, RSTART + 6, RLENGTH - 6)
      if (first == "") first = last
    }
    /number_of_executed_units/ { runs = $2 }
    END {
      result = failed ? ": FAILED" : ""
      printf "%-12s %9d runs, coverage %5d to %5d%s\n", target, runs, first, last, result
    }' "$log"
  ((status == 0)) && return
  grep -aE '^(==[0-9]+==|SUMMARY|does not hold|.*runtime error|Test unit written)' "$log" | head -5
  printf '%s: see %s\n' "$target" "$log"
  return 1
}

if (($# == 0)); then
  for binary in "$build"/bin/fuzz_*; do set -- "$@" "${binary##*/fuzz_}"; done
fi
export -f run_target
export here build seconds findings scratch
printf '%s\n' "$@" | xargs -P 2 -I{} bash -c 'run_target {}' ||
  { printf 'findings: %s\n' "$findings" >&2; exit 1; }
