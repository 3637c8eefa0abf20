#!/usr/bin/env bash
# Installs the Debian packages of the given groups of packages.txt that are missing. Asks for
# nothing, needs root or sudo only if something is missing, and touches the package index only then.
#   config/setup/install.sh build check
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

die() {
  printf 'setup: %s\n' "$*" >&2
  exit 1
}

wanted() {
  local group package
  while read -r group package _; do
    [[ -z $group || $group == \#* ]] && continue
    [[ " $* " == *" $group "* ]] && printf '%s\n' "$package"
  done <"$here/packages.txt"
}

installed() {
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

as_root() {
  if [[ $(id -u) == 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "to install packages, run this as root or install sudo; missing: ${missing[*]}"
  fi
}

command -v apt-get >/dev/null ||
  die "this is not Debian: install what $here/packages.txt lists by hand"
missing=()
while read -r package; do
  installed "$package" || missing+=("$package")
done < <(wanted "$@")
((${#missing[@]})) || exit 0

printf 'setup: installing %d packages: %s\n' "${#missing[@]}" "${missing[*]}"
# Debian's PostgreSQL would make and start a database of its own; the tests make theirs. Where it was
# never installed, that is left out, and the next to install it decides anew.
no_cluster=/etc/postgresql-common/createcluster.d/trailcast.conf
if [[ " ${missing[*]} " == *" postgresql-"* && ! -e /etc/postgresql-common ]]; then
  as_root mkdir -p "${no_cluster%/*}"
  as_root tee "$no_cluster" <<<'create_main_cluster = false' >/dev/null
  trap 'as_root rm -f "$no_cluster"' EXIT
fi
apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o Dpkg::Use-Pty=0 -qq)
install=("${apt[@]}" install -y --no-install-recommends "${missing[@]}")
# An index that is there may do; one that is absent or too old is fetched, once.
if ! as_root "${install[@]}" </dev/null >/dev/null 2>&1; then
  as_root "${apt[@]}" update </dev/null || die "apt-get update failed: is there a network?"
  as_root "${install[@]}" </dev/null >/dev/null || die "apt-get could not install: ${missing[*]}"
fi
