# shellcheck shell=bash disable=SC2034,SC2154  # shared with swarm.sh and the scenarios
# A Podman of one's own, for swarm.sh: its storage is a temporary folder, and processes, mounts and
# networks are in namespaces. Whatever ends the script, containers and networks end with it.
# Nothing of another Podman or Docker on the machine is touched.

# What keeps this machine from running containers; nothing if nothing does.
lab_obstacle() {
  if [[ $(id -u) != 0 ]]; then
    echo 'needs root, to run containers with networks of their own'
  elif ! unshare --pid --mount --net --fork true 2>/dev/null; then
    echo 'the kernel gives no process, mount and network namespaces here'
  elif ! lab_can_overlay; then
    echo "no overlay file system can be mounted in ${TMPDIR:-/var/tmp}"
  fi
}
lab_can_overlay() {
  local folder mounted=0
  folder=$(mktemp -d "${TMPDIR:-/var/tmp}/trailcast-overlay.XXXXXX")
  mkdir "$folder"/{lower,upper,work,merged}
  unshare --mount mount -t overlay overlay \
    -o "lowerdir=$folder/lower,upperdir=$folder/upper,workdir=$folder/work" "$folder/merged" \
    2>/dev/null || mounted=1
  rm -rf "$folder"
  return "$mounted"
}

# lab_enter ARGUMENT...: returns in the innermost of three shells, each this script with the same
# arguments: one that cleans up, one in the machine's network that makes the images, and one in a
# network namespace, where the containers run.
lab_enter() {
  case ${LAB_STAGE:-} in
    '') lab_outside "$@" ;;
    images)
      lab_hide_podman
      lab_images
      printf 'images of server, agent, robot and console: %d s\n' "$SECONDS"
      LAB_STAGE=network exec unshare --net -- "$0" "$@"
      ;;
    network)
      ip link set lo up
      podman network create fleet >/dev/null
      ;;
  esac
}

lab_outside() {
  local status=0
  lab_inside=''
  export LAB_WORK
  LAB_WORK=$(mktemp -d "${TMPDIR:-/var/tmp}/trailcast-containers.XXXXXX")
  trap lab_clean EXIT
  trap 'exit 130' INT TERM HUP
  lab_configure
  LAB_STAGE=images setpriv --pdeathsig KILL unshare --pid --mount --mount-proc --kill-child -- "$0" "$@" &
  lab_inside=$!
  wait "$lab_inside" || status=$?
  exit "$status"
}
lab_clean() {
  if [[ -n $lab_inside ]]; then
    kill -KILL "$lab_inside" 2>/dev/null || true  # unshare heeds nothing else
    wait "$lab_inside" 2>/dev/null || true
  fi
  rm -rf "$LAB_WORK"
  # Control groups of containers that were killed with everything else; empty, if they are ours.
  find /sys/fs/cgroup -depth -type d -path '*/libpod_parent*' -exec rmdir {} + 2>/dev/null || true
}

# Old kernels' control groups are refused by crun, and limits cannot be raised without the right to.
lab_configure() {
  cat >"$LAB_WORK/containers.conf" <<'CONF'
[containers]
default_ulimits = ["nofile=1024:1024", "nproc=4096:4096"]
log_driver = "k8s-file"
[engine]
runtime = "runc"
cgroup_manager = "cgroupfs"
events_logger = "file"
[network]
network_backend = "netavark"
CONF
  printf 'network_config_dir = "%s/networks"\n' "$LAB_WORK" >>"$LAB_WORK/containers.conf"
  printf '[storage]\ndriver = "overlay"\ngraphroot = "%s/storage"\nrunroot = "%s/run"\n' \
    "$LAB_WORK" "$LAB_WORK" >"$LAB_WORK/storage.conf"
  export CONTAINERS_CONF=$LAB_WORK/containers.conf CONTAINERS_STORAGE_CONF=$LAB_WORK/storage.conf
  # Checks of health are run by hand: systemd, which Podman would have do it, may not be there.
  export DISABLE_HC_SYSTEMD=true
}

# Podman's places outside its storage, in this mount namespace only.
lab_hide_podman() {
  local folder
  for folder in /run/containers /run/libpod /run/netns /dev/shm; do
    mkdir -p "$folder"
    mount -t tmpfs tmpfs "$folder"
  done
}

debian=docker.io/library/debian:bookworm-slim

# Debian 12: from a registry or, where none answers, made here, once.
lab_base() {
  local kept=$root/build/containers/debian.tar
  if timeout 60 podman pull --quiet "$debian" >/dev/null 2>&1; then return; fi
  if [[ ! -f $kept ]]; then
    echo 'no registry answers: making the base image with debootstrap'
    debootstrap --variant=minbase bookworm "$LAB_WORK/debian" >"$LAB_WORK/debootstrap.log" 2>&1 ||
      { tail -5 "$LAB_WORK/debootstrap.log" >&2; die 'debootstrap failed'; }
    rm -rf "$LAB_WORK"/debian/var/{cache/apt/archives/*.deb,lib/apt/lists/*}
    mkdir -p "${kept%/*}"
    tar -C "$LAB_WORK/debian" -c . -f "$kept.part"
    mv "$kept.part" "$kept"
    rm -rf "$LAB_WORK/debian"
  fi
  podman import --quiet "$kept" "$debian" >/dev/null
}

# The images server, agent, robot and console: of the programs in build/release or, with from_source set,
# from the repository alone.
lab_images() {
  local target programs=(--network host)
  lab_base
  if [[ -z ${from_source:-} ]]; then
    "$root/docker/collect.sh" "$root/build/release/bin" "$LAB_WORK/collected/images" \
      server agent robot console
    tar -C "$LAB_WORK/collected" -c images |
      podman import --quiet - localhost/trailcast-programs >/dev/null
    rm -rf "$LAB_WORK/collected"
    programs=(--build-arg PROGRAMS=localhost/trailcast-programs)
  fi
  for target in server agent robot console; do
    podman build --quiet --format docker --target "$target" "${programs[@]}" \
      --tag "trailcast-$target" --file "$root/docker/Dockerfile" "$root" >/dev/null
  done
}

# lab_image_mb TARGET: how much larger than Debian.
lab_image_mb() {
  local size base
  size=$(podman image inspect --format '{{.Size}}' "trailcast-$1")
  base=$(podman image inspect --format '{{.Size}}' "$debian")
  echo $(((size - base + 999999) / 1000000))
}
