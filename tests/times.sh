#!/usr/bin/env bash
# What `./run test` took, as Markdown: its stages, and the thirty tests and test programs that took
# longest, from what CTest noted in the build folders. `./run test --note-times` puts it into
# tests/README.md.
#   tests/times.sh ROOT STAGES   (STAGES: a file with a line `NAME<tab>SECONDS` a stage)
set -euo pipefail
root=$1 stages=$2
presets=(release asan)

# Of each test that was run: seconds, its name, its program's.
tests() {
  local preset
  for preset in "${presets[@]}"; do
    (cd "$root" && ctest --preset "$preset" --show-only=json-v1) |
      jq -r '.tests[] | [.name, ((.command // ["?"])[0] | split("/") | last)] | @tsv' |
      awk -F'\t' -v log="$root/build/$preset/test.log" '
        { program[$1] = $2 }
        END {
          while ((getline line < log) > 0) {
            if (line !~ /^ *[0-9]+\/[0-9]+ Test +#/) continue
            seconds = line; sub(/ sec.*$/, "", seconds); sub(/^.* /, "", seconds)
            name = line; sub(/^.*Test +#[0-9]+: /, "", name); sub(/ .*$/, "", name)
            printf "%s\t%s\t%s\n", seconds, name, program[name]
          }
        }'
  done
}

all=$(tests)
printf 'On %s, %s cores of %s, by `./run test --note-times`.\n\n' "$(date -I)" "$(nproc)" \
  "$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1)"
printf '| stage | s |\n| --- | --- |\n'
awk -F'\t' '{ printf "| %s | %d |\n", $1, $2; all += $2 } END { printf "| all | %d |\n", all }' "$stages"
printf '\n| slowest tests | s |\n| --- | --- |\n'
sort -rn <<<"$all" | head -30 | awk -F'\t' '{ printf "| `%s` | %.0f |\n", $2, $1 }'
printf '\n| test programs, all their tests | s | tests |\n| --- | --- | --- |\n'
awk -F'\t' '{ s[$3] += $1; n[$3]++ } END { for (p in s) printf "%.0f\t%s\t%d\n", s[p], p, n[p] }' <<<"$all" |
  sort -rn | head -30 | awk -F'\t' '{ printf "| `%s` | %d | %d |\n", $2, $1, $3 }'
