#!/usr/bin/env bash
# Runs a command, by default the Rust tests, in a Debian 13 root: against Embree 4.3, on a machine that has another one.
#
#   scripts/debian13.sh [command [argument]...]
#
# The root is made once (debian-root.sh) in target/debian13, or in $AZULEJO_DEBIAN13_DIR, and kept. Needs root, or asks
# sudo for it. Inside, the project is at /azulejo, read-only; what cargo builds goes to /var/cache/azulejo.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

. "$(dirname "$0")/debian-root.sh"

# In addition to the packages of every root; cpack needs dpkg-dev and file to make Debian packages, examples_c/ranks.c MPI.
packages=(libembree-dev libclang-dev dpkg-dev file openmpi-bin libopenmpi-dev)

# --- Outside: as the user, whose environment names the Rust toolchain and cargo's registry ---

outside() {
    local source cache sysroot settings sudo=()
    source=$(cd "$(dirname "$0")/.." && pwd)
    cache=$(cache_of "$source" 13)
    command -v cargo >/dev/null || die "cargo is not installed; scripts/setup.sh says what to do"
    needs_tools
    cargo fetch --quiet --locked --manifest-path "$source/Cargo.toml"
    sysroot=$(rustc --print sysroot)
    [ "$sysroot" != /usr ] || die "a distribution's Rust toolchain cannot be shown in the root; use one of rustup"
    mkdir -p "$cache"
    [ "$(id -u)" = 0 ] || sudo=(sudo)
    mapfile -t settings < <(settings AZULEJO_DEBIAN_MIRROR)
    exec "${sudo[@]}" env "${settings[@]}" unshare --mount --propagation private bash "$0" --inside \
        "$source" "$(cd "$cache" && pwd)" "$sysroot" "${CARGO_HOME:-$HOME/.cargo}" "$@"
}

# --- Inside the mount namespace: as root ---

# The base and the packages, made anew when either changes, also after an attempt that was broken off.
make_root() { # CACHE
    local cache=$1 root=$1/root stamp="${base_packages[*]} ${packages[*]}"
    [ "$(cat "$root/etc/azulejo-packages" 2>/dev/null)" != "$stamp" ] || return 0
    base_root 13 "$cache"
    rm -rf "$root"
    cp -a "$cache/base" "$root"
    install_packages "$cache" "$root" "${packages[@]}"
    echo "$stamp" >"$root/etc/azulejo-packages"
}

inside() {
    local source=$1 cache=$2 sysroot=$3 cargo_home=$4 root=$2/root part settings
    shift 4
    [ $# -gt 0 ] || set -- cargo test --offline --workspace
    # Children inherit the lock: a second run waits until the command of the first one has ended.
    exec 9>"$cache/lock"
    flock 9

    make_root "$cache"
    network "$root"
    mount_system "$root"
    show "$source" "$root/azulejo"
    show "$sysroot" "$root/opt/rust"
    # Of cargo's home only what holds packages and says where they are from: never its credentials. It is where it is
    # outside, or cargo would not take over what was compiled there (share-packages.sh).
    mkdir -p "$root$cargo_home"
    for part in registry git config.toml; do
        [ ! -e "$cargo_home/$part" ] || show "$cargo_home/$part" "$root$cargo_home/$part"
    done
    # The meshes of tests/all/mesh_corpus.rs.
    [ ! -d /usr/share/assimp/models ] || show /usr/share/assimp/models "$root/usr/share/assimp/models"
    mapfile -t settings < <(settings)
    exec chroot "$root" env -i "${settings[@]}" HOME=/root LC_ALL=C.UTF-8 \
        PATH=/opt/rust/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        CARGO_HOME="$cargo_home" CARGO_TARGET_DIR=/var/cache/azulejo CARGO_NET_OFFLINE=true \
        sh -c 'cd /azulejo && exec "$@"' sh "$@"
}

if [ "${1:-}" = --inside ]; then
    shift
    inside "$@"
else
    outside "$@"
fi
