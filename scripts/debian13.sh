#!/usr/bin/env bash
# Runs a command, by default the Rust tests, in a Debian 13 root: against Embree 4.3, on a machine that has another one.
#
#   scripts/debian13.sh [command [argument]...]
#
# The root is made once by debootstrap (about a minute) in target/debian13, or in $AZULEJO_DEBIAN13_DIR, and kept. The
# Debian mirror is the one that this machine's apt uses, or $AZULEJO_DEBIAN_MIRROR. Needs root, or asks sudo for it.
#
# All mounts are made in a mount namespace of this process: they cannot be seen outside, and the kernel drops them
# when the process ends, however it ends. So nothing is left to unmount, and the root (which belongs to root) can be
# deleted at any time. Inside, the project is at /azulejo, read-only; what cargo builds goes to /var/cache/azulejo.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

suite=trixie
packages=(libembree-dev libclang-dev g++ cmake make pkg-config)

die() {
    echo "debian13.sh: $*" >&2
    exit 1
}

# NAME=value for each of these variables that is set: what sudo and the root are told of the environment.
settings() {
    local name
    for name in TERM http_proxy https_proxy CARGO_BUILD_JOBS RUST_BACKTRACE "$@"; do
        [ -z "${!name:-}" ] || printf '%s=%s\n' "$name" "${!name}"
    done
}

# --- Outside: as the user, who knows where the Rust toolchain is and who owns cargo's registry ---

outside() {
    local source cache sysroot tool settings sudo=()
    source=$(cd "$(dirname "$0")/.." && pwd)
    cache=${AZULEJO_DEBIAN13_DIR:-$source/target/debian13}
    command -v cargo >/dev/null || die "cargo is not installed; scripts/setup.sh says what to do"
    for tool in debootstrap unshare flock; do
        command -v "$tool" >/dev/null || die "$tool is not installed; run scripts/setup.sh --tests"
    done
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

# The first Debian archive among apt's own sources, known by its suite. Apt parses both formats of source files better
# than a script would, but lists only what it has fetched once.
find_mirror() {
    local suites='(bullseye|bookworm|trixie|forky|sid|stable|oldstable|testing|unstable)'
    apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 'Component: main' |
        sed -nE "s/^((http|https|file):[^ ]*) $suites\$/\1/p" | sed -n 1p
}

# What this machine's apt was told about proxies, certificates and clocks holds in the root too.
apt_settings() {
    apt-config dump | grep -iE '^Acquire::(http|https|Retries|Check-Date|Check-Valid-Until)\b.* ".+";$' || true
}

bootstrap() {
    local cache=$1 root=$2 mirror keyring proxy
    mirror=${AZULEJO_DEBIAN_MIRROR:-$(find_mirror)}
    [ -n "$mirror" ] || { apt-get update -qq >&2 && mirror=$(find_mirror); }
    [ -n "$mirror" ] || die "no Debian mirror among apt's sources; set AZULEJO_DEBIAN_MIRROR to one"
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    [ -r "$keyring" ] || die "$keyring is missing; apt-get install debian-archive-keyring"
    proxy=$(apt-config shell proxy Acquire::http::Proxy)
    eval "$proxy" # apt-config prints proxy='...', or nothing
    [ -z "${proxy:-}" ] || export http_proxy=${http_proxy:-$proxy}

    echo "debian13.sh: making a Debian 13 root in $root (about a minute, 1 GB)" >&2
    rm -rf "$cache/root.partial"
    mkdir -p "$cache/packages"
    debootstrap --variant=minbase --keyring="$keyring" --cache-dir="$cache/packages" \
        "$suite" "$cache/root.partial" "$mirror" >"$cache/bootstrap.log" 2>&1 ||
        die "debootstrap failed; $cache/bootstrap.log ends with: $(tail -n 3 "$cache/bootstrap.log")"
    apt_settings >"$cache/root.partial/etc/apt/apt.conf.d/90machine"
    # For a mirror behind https: the small root has no certificates.
    mkdir -p "$cache/root.partial/etc/ssl/certs"
    local certificates=/etc/ssl/certs/ca-certificates.crt
    [ ! -e "$certificates" ] || cp -L "$certificates" "$cache/root.partial$certificates"
    # The name root stands for a finished one.
    mv "$cache/root.partial" "$root"
}

# Mounts what the system needs; all of it vanishes with the namespace.
mount_system() {
    local root=$1
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    cp -L /etc/resolv.conf "$root/etc/resolv.conf"
    cp -L /etc/hosts "$root/etc/hosts"
}

# Installs the packages, once for each version of their list, also after an attempt that was broken off.
install_packages() {
    local cache=$1 root=$2 stamp=$2/etc/azulejo-packages
    [ "$(cat "$stamp" 2>/dev/null)" != "${packages[*]}" ] || return 0
    echo "debian13.sh: installing in the root: ${packages[*]}" >&2
    chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -ec '
        dpkg --configure -a
        apt-get update -qq
        apt-get install -qq --no-install-recommends "$@"
        apt-get clean' sh "${packages[@]}" >"$cache/install.log" 2>&1 ||
        die "apt-get failed in the root; $cache/install.log ends with: $(tail -n 3 "$cache/install.log")"
    echo "${packages[*]}" >"$stamp"
}

# Mounts a folder or file of the machine read-only in the root.
show() {
    if [ -d "$1" ]; then mkdir -p "$2"; else touch "$2"; fi
    mount --bind "$1" "$2"
    mount -o remount,bind,ro "$2"
}

inside() {
    local source=$1 cache=$2 sysroot=$3 cargo_home=$4 root=$2/root part settings
    shift 4
    [ $# -gt 0 ] || set -- cargo test --offline --workspace
    # Children inherit the lock: a second run waits until the command of the first one has ended.
    exec 9>"$cache/lock"
    flock 9

    [ -d "$root" ] || bootstrap "$cache" "$root"
    mount_system "$root"
    install_packages "$cache" "$root"

    show "$source" "$root/azulejo"
    show "$sysroot" "$root/opt/rust"
    # Of cargo's home only what holds packages and says where they are from: never its credentials.
    mkdir -p "$root/opt/cargo"
    for part in registry git config.toml; do
        [ ! -e "$cargo_home/$part" ] || show "$cargo_home/$part" "$root/opt/cargo/$part"
    done
    mapfile -t settings < <(settings)
    exec chroot "$root" env -i "${settings[@]}" HOME=/root LC_ALL=C.UTF-8 \
        PATH=/opt/rust/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        CARGO_HOME=/opt/cargo CARGO_TARGET_DIR=/var/cache/azulejo CARGO_NET_OFFLINE=true \
        sh -c 'cd /azulejo && exec "$@"' sh "$@"
}

if [ "${1:-}" = --inside ]; then
    shift
    inside "$@"
else
    outside "$@"
fi
