#!/usr/bin/env bash
# What `./run test` took, as Markdown: its stages, and the thirty tests and test programs that took
# longest, from what CTest noted in the build folders. `./run test --note-times` puts it into
# tests/TIMES.md.
#   tests/times.sh ROOT STAGES   (STAGES: a file with a line `NAME<tab>SECONDS` a stage)
set -euo pipefail
root=$1 stages=$2
presets=(release asan)

# Of each test that was run: seconds, its name, its program's. GoogleTest says how long its cases
# took; CTest does of those that another program runs.
tests() {
  local preset
  for preset in "${presets[@]}"; do
    awk '
      /^Command: / {
        program = $2; gsub(/"/, "", program); sub(/^.*\//, "", program)
      }
      /^"[^"]*" start time: / { name = $1; gsub(/"/, "", name); cases = 0 }
      /^\[       OK \] .* ms\)$/ {
        ++cases
        seconds = $(NF - 1); sub(/\(/, "", seconds); sub(/,$/, "", $4)
        printf "%.3f\t%s\t%s\n", seconds / 1000, $4, program
      }
      /^Test time = / && !cases { printf "%.3f\t%s\t%s\n", $4, name, program }
    ' "$root/build/$preset/Testing/Temporary/LastTest.log"
  done
}

all=$(tests)
printf 'On %s, %s cores of %s, by `./run test --note-times`.\n\n' "$(date -I)" "$(nproc)" \
  "$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1)"
printf '| stage | s |\n| --- | --- |\n'
awk -F'\t' '{ printf "| %s | %d |\n", $1, $2; all += $2 } END { printf "| all | %d |\n", all }' "$stages"
printf '\n| slowest tests | s |\n| --- | --- |\n'
sort -rn <<<"$all" | awk -F'\t' 'NR <= 30 { printf "| `%s` | %.0f |\n", $2, $1 }'
printf '\n| test programs, all their tests | s | tests |\n| --- | --- | --- |\n'
awk -F'\t' '{ s[$3] += $1; n[$3]++ } END { for (p in s) printf "%.0f\t%s\t%d\n", s[p], p, n[p] }' <<<"$all" |
  sort -rn | awk -F'\t' 'NR <= 30 { printf "| `%s` | %d | %d |\n", $2, $1, $3 }'
