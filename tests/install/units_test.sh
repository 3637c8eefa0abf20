#!/usr/bin/env bash
# Has systemd read the units that are installed and, as root, boots it in namespaces of its own over
# a copy of this machine's files that goes with it, and has it run server, agent and console.
#   units_test.sh BUILD_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1

skip() {
  echo "SKIPPED: $*"
  exit 77
}
fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# Of units as they are for a program that lies elsewhere.
read_units() {
  local unit
  mkdir "$work/read"
  for unit in "$work"/usr/lib/systemd/system/*.service; do
    sed "s#/usr/bin/#$work/usr/bin/#" "$unit" >"$work/read/${unit##*/}"
  done
  systemd-analyze verify --man=no "$work"/read/*.service || fail 'systemd does not like a unit'
  # Exposure, by systemd's own measure, of 100.
  systemd-analyze security --no-pager --offline=true --threshold=20 "$work"/read/*.service \
    >"$work/security" || { grep 'Overall' "$work/security"; fail 'a unit may do too much'; }
  grep -o 'Overall.*[0-9]' "$work/security"
}

# As config/README.md says: before the first start.
give_keys() {
  local keys=("$work/usr/bin/trailcast" keys) member
  "${keys[@]}" init "$1/root/fleet"
  for member in server:server robot1:follower console:operator operator:operator; do
    "${keys[@]}" --authority "$1/root/fleet" add --role "${member#*:}" "${member%:*}"
  done
  for member in server:trailcast robot1:trailcast-agent console:trailcast-console; do
    mkdir "$1/var/lib/${member#*:}"
    cp -r "$1/root/fleet/members/${member%:*}" "$1/var/lib/${member#*:}/keys"
  done
  sed -i -e 's#^security = .*#security = "keys"#' -e 's#^network-interface = .*#network-interface = "lo"#' \
    "$1/etc/trailcast/agent.toml"
}

# In namespaces of its own, and a control group's.
boot() {
  local root=$work/files/root
  mount --make-rprivate /
  mount -t tmpfs tmpfs "$work/files"
  mkdir "$work"/files/{upper,work,root}
  mount -t overlay overlay "$root" \
    -o "lowerdir=/,upperdir=$work/files/upper,workdir=$work/files/work"
  mount -t proc proc "$root/proc"
  mount -t sysfs sysfs "$root/sys"
  mount -t cgroup2 cgroup2 "$root/sys/fs/cgroup"
  for folder in run tmp dev mnt; do mount -t tmpfs tmpfs "$root/$folder"; done
  for device in null zero full random urandom tty; do
    touch "$root/dev/$device"
    mount --bind "/dev/$device" "$root/dev/$device"
  done
  mkdir -m 1777 "$root/dev/shm"
  mkdir "$root"/dev/{pts,mqueue,hugepages}
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
  ln -s pts/ptmx "$root/dev/ptmx"
  ip link set lo up
  rm -rf "$root"/etc/{systemd/system,machine-id} "$root"/var/lib/{,private/}trailcast*
  mkdir -p "$root"/etc/{systemd/system,trailcast}
  echo 0123456789abcdef0123456789abcdef >"$root/etc/machine-id"
  cp -a "$work/usr/." "$root/usr"
  cp "$work/usr/share/trailcast/agent.toml" "$root/etc/trailcast"
  give_keys "$root"
  for program in agent console server; do
    printf '%s\n' TRAILCAST_NETWORK_INTERFACE=lo TRAILCAST_SECURITY=keys \
      >"$root/etc/default/trailcast-$program"
  done
  mkdir "$root/mnt/checks"
  mount --bind "$work/checks" "$root/mnt/checks"
  cp "$here/units_check.sh" "$root/mnt"
  cat >"$root/etc/systemd/system/checks.service" <<'UNIT'
[Unit]
Wants=trailcast-agent.service trailcast-console.service trailcast-server.service
[Service]
ExecStart=/mnt/units_check.sh /mnt/checks
UNIT
  cat >"$root/etc/systemd/system/checks.target" <<'UNIT'
[Unit]
Requires=basic.target
Wants=checks.service
UNIT
  mkdir "$root/mnt/before"
  cd "$root"
  pivot_root . mnt/before
  umount -l mnt/before
  exec env -i container=trailcast PATH=/usr/bin:/usr/sbin:/bin:/sbin \
    /lib/systemd/systemd --system --unit=checks.target --log-target=console --show-status=no
}

clean() {
  if [[ -n ${booted:-} ]]; then
    kill -KILL "$booted" 2>/dev/null || true # it is pid 1 there, and all of it ends
    wait "$booted" 2>/dev/null || true
  fi
  rm -rf "$work"
  [[ -z ${group:-} ]] || until find "$group" -depth -type d -exec rmdir {} + 2>/dev/null; do sleep 0.1; done
}

if [[ ${UNITS_STAGE:-} == boot ]]; then boot; fi
command -v systemd-analyze >/dev/null || skip 'systemd is not installed'
export work
work=$(mktemp -d)
trap clean EXIT
trap 'exit 130' INT TERM HUP
mkdir "$work"/{files,checks}
cmake --install "$build" --prefix "$work/usr" >"$work/install.log"
read_units

[[ $(id -u) == 0 ]] || skip 'booting systemd needs root; the units read well'
groups=$(awk '$3 == "cgroup2" { print $2; exit }' /proc/mounts)
group=$groups/trailcast-units-$$
if [[ -z $groups ]] || ! mkdir "$group" 2>/dev/null; then
  group=''
  skip 'no control groups here; the units read well'
fi
unshare --mount --pid --net --uts --ipc --cgroup --fork true 2>/dev/null ||
  skip 'the kernel gives no namespaces here; the units read well'
(
  echo "$BASHPID" >"$group/cgroup.procs"
  UNITS_STAGE=boot exec setpriv --pdeathsig KILL \
    unshare --mount --pid --net --uts --ipc --cgroup --fork --kill-child "$0" "$build"
) >"$work/boot.log" 2>&1 &
booted=$!
# await_check SECONDS FILE: false if systemd has ended, or it takes longer.
await_check() {
  local until=$((SECONDS + $1))
  until [[ -e $work/checks/$2 ]]; do
    if ((SECONDS > until)) || ! kill -0 "$booted" 2>/dev/null; then return 1; fi
    sleep 0.2
  done
}
if ! await_check 60 told; then
  tail -n 5 "$work/boot.log"
  skip 'systemd does not boot here; the units read well'
fi
await_check 260 ended || { cat "$work/boot.log" "$work/checks/told" >&2; fail 'the checks did not end'; }
cat "$work/checks/told"
[[ $(cat "$work/checks/ended") == 0 ]] || { cat "$work/boot.log" >&2; fail 'see above'; }
