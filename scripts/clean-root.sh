#!/usr/bin/env bash
# Runs a command in a clean root of a Debian release, which has a compiler, CMake and pkg-config, but no Embree, no Rust
# and no trace of azulejo or of an earlier run.
#
#   scripts/clean-root.sh RELEASE DEBS command [argument]...
#
# RELEASE is 12 or 13. What the command changes is kept in memory and lost. It runs as root, in a root that is made once
# (debian-root.sh) in target/debian<RELEASE>, or in $AZULEJO_DEBIAN<RELEASE>_DIR. Needs root, or asks sudo for it. The
# project is at /azulejo and DEBS, a folder of packages, at /debs, both read-only. Packages from the mirror are fetched
# once.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

. "$(dirname "$0")/debian-root.sh"

outside() {
    local source cache debs settings sudo=()
    [ $# -ge 3 ] || { sed -n '5s/^# *//p' "$0" >&2 && exit 2; }
    source=$(cd "$(dirname "$0")/.." && pwd)
    cache=$(cache_of "$source" "$1")
    debs=$(cd "$2" && pwd)
    needs_tools
    mkdir -p "$cache"
    [ "$(id -u)" = 0 ] || sudo=(sudo)
    mapfile -t settings < <(settings AZULEJO_DEBIAN_MIRROR)
    exec "${sudo[@]}" env "${settings[@]}" unshare --mount --propagation private bash "$0" --inside \
        "$1" "$source" "$(cd "$cache" && pwd)" "$debs" "${@:3}"
}

# Lays memory over the base: what is written goes there.
mount_clean() { # CACHE
    local layer=$1/layer
    mkdir -p "$layer"
    mount -t tmpfs -o mode=755 tmpfs "$layer"
    mkdir "$layer/changes" "$layer/work" "$layer/root"
    mount -t overlay overlay -o "lowerdir=$1/base,upperdir=$layer/changes,workdir=$layer/work" "$layer/root"
}

inside() {
    local release=$1 source=$2 cache=$3 debs=$4 root=$3/layer/root settings
    shift 4
    exec 9>"$cache/lock"
    flock 9
    base_root "$release" "$cache"
    mount_clean "$cache"
    network "$root"
    mount_system "$root"
    show "$source" "$root/azulejo"
    show "$debs" "$root/debs"
    mkdir -p "$cache/archives/partial"
    mount --bind "$cache/archives" "$root/var/cache/apt/archives"
    mapfile -t settings < <(settings)
    exec chroot "$root" env -i "${settings[@]}" HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin sh -c 'cd /azulejo && exec "$@"' sh "$@"
}

if [ "${1:-}" = --inside ]; then
    shift
    inside "$@"
else
    outside "$@"
fi
