#!/usr/bin/env bash
# Installs what is built, and has somebody else's program built on it teach and follow.
#   install_test.sh BUILD_FOLDER [RECORDINGS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 recordings=${2:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/installed" >"$work/install.log"
for file in bin/trailcast{,-agent,-console,-server,-vda5050} lib/systemd/system/trailcast-{agent,console,server,vda5050}.service \
  share/bash-completion/completions/trailcast{,-agent,-console,-server} \
  share/fish/vendor_completions.d/trailcast{,-agent,-console,-server}.fish \
  share/zsh/{vendor-completions,site-functions}/_trailcast{,-agent,-console,-server}; do
  [[ -e $work/installed/$file ]] || { echo "not installed: $file" >&2; exit 1; }
done
if find "$work/installed/include" -path '*/src/*' | grep .; then
  echo 'these are nobody else'\''s' >&2
  exit 1
fi
cmake -S "$here" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/installed" --log-level=WARNING >"$work/configure.log" 2>&1 ||
  { cat "$work/configure.log" >&2; exit 1; }
ninja -C "$work/build" --quiet
if [[ ! -d $recordings ]]; then
  echo "built; no recordings at '$recordings' to follow"
  exit 77
fi
told=$(TRAILCAST_MODULES=$work/installed/lib/trailcast "$work/build/teach_and_follow" "$recordings/teach" "$recordings/replay")
echo "$told"
[[ $told == *ARRIVED ]]
