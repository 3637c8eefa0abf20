#!/usr/bin/env bash
# Gathers what each image of the Dockerfile holds: the programs, stripped, the shared libraries they
# load, and of the Debian packages that these are from, the licence and, for scanners of
# vulnerabilities, name and version (/var/lib/dpkg/status.d).
#   docker/collect.sh FOLDER_OF_PROGRAMS DESTINATION [server|agent|robot|console|tools...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
programs=$1 destination=$2

# Paths as the loader finds them; the C library itself is every Debian's.
libraries_of() {
  if ldd "$@" | grep 'not found' >&2; then return 1; fi
  ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u |
    grep -vxF "$(dpkg -L libc6 | grep '\.so')"
}

# packages_of FILE...: those they are from. /lib is /usr/lib, and dpkg may know either.
packages_of() {
  local files
  mapfile -t files < <(readlink -f "$@" | sed 's|^/usr||')
  { dpkg-query -S "${files[@]}" "${files[@]/#//usr}" 2>/dev/null || true; } |
    sed 's|: /.*||' | sort -u
}

# collect IMAGE BELOW FILE...: programs, libraries of ours, scripts; without the libraries of the
# image BELOW, if it is made from one of these.
collect() {
  local image=$destination/$1 below=$destination/${2:-none} file package name loaded found libraries=()
  shift 2
  install -d "$image/usr/local/bin" "$image/usr/local/lib" "$image/var/lib/dpkg/status.d"
  local binaries=()
  for file in "$@"; do
    install "$file" "$image/usr/local/bin"
    [[ $file == *.sh ]] && continue
    strip "$image/usr/local/bin/${file##*/}"
    binaries+=("$file")
  done
  # Cyclone loads its security plugins by name, when a fleet uses them.
  local plugins=(/usr/lib/*/libddsc0debian/libdds_security_*.so)
  loaded=$(libraries_of "${binaries[@]}" "${plugins[@]}")
  mapfile -t found <<<"$loaded"
  for file in "${found[@]}" "${plugins[@]}"; do
    [[ -e $below/usr/local/lib/${file##*/} ]] || libraries+=("$file")
  done
  ((${#libraries[@]})) || return 0
  cp --dereference "${libraries[@]}" "$image/usr/local/lib"
  for package in $(packages_of "${libraries[@]}"); do
    name=${package%%:*}
    dpkg-query -s "$package" >"$image/var/lib/dpkg/status.d/$name"
    install -D -m 644 -t "$image/usr/share/doc/$name" "/usr/share/doc/$name/copyright"
  done
}

images=("${@:3}")
((${#images[@]})) || images=(server agent robot console tools)
for image in "${images[@]}"; do
  case $image in
    server | agent) collect "$image" '' "$programs/trailcast-$image" ;;
    console) collect console '' "$programs/trailcast-console" "$(command -v openssl)" "$here/console.sh" ;;
    robot) collect robot agent "$programs/trailcast" "$here/robot.sh" ;;
    tools)
      collect tools '' "$programs"/{trailcast{,-agent,-console,-server},libtrailcast_{codecs,simulated}.so}
      # What plots are lettered with.
      install -d "$destination/tools/etc"
      install -D -m 644 -t "$destination/tools/usr/share/fonts" \
        /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
      cp -rL /etc/fonts "$destination/tools/etc"
      ;;
    *)
      printf "collect.sh: there is no image '%s': server, agent, robot, console or tools\n" "$image" >&2
      exit 2
      ;;
  esac
done
