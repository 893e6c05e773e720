# Sourced by debian13.sh and clean-root.sh: makes roots of Debian releases by debootstrap, and keeps them.
#
# base_root RELEASE CACHE makes CACHE/base: what debootstrap calls minbase, and what a C or C++ program is built with. It
# is made once (about a minute); nothing else is ever installed in it. The Debian mirror is the one that this machine's
# apt uses, or $AZULEJO_DEBIAN_MIRROR.
#
# Both scripts make all mounts in a mount namespace of their process: they cannot be seen outside, and the kernel drops
# them when the process ends, however it ends. So nothing is left to unmount, and the caches (which belong to root) can
# be deleted at any time.

base_packages=(g++ make cmake pkg-config)

die() {
    echo "$(basename "$0"): $*" >&2
    exit 1
}

needs_tools() {
    local tool
    for tool in debootstrap unshare flock; do
        command -v "$tool" >/dev/null || die "$tool is not installed; run scripts/setup.sh --all"
    done
}

# The folder where the roots of a release are kept.
cache_of() { # SOURCE RELEASE
    local setting=AZULEJO_DEBIAN$2_DIR
    echo "${!setting:-$1/target/debian$2}"
}

# NAME=value for each of these variables that is set: the environment of sudo and of the root.
settings() {
    local name
    for name in TERM http_proxy https_proxy CARGO_BUILD_JOBS CARGO_INCREMENTAL PROPTEST_RNG_SEED RUST_BACKTRACE "$@"; do
        [ -z "${!name:-}" ] || printf '%s=%s\n' "$name" "${!name}"
    done
}

suite_of() { # RELEASE
    case $1 in
        12) echo bookworm ;;
        13) echo trixie ;;
        *) die "Debian $1 is not known here; 12 and 13 are" ;;
    esac
}

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

# Mirrors fail now and then.
attempts() { # COMMAND...
    "$@" || { sleep 10 && "$@"; } || { sleep 30 && "$@"; }
}

from_nothing() { # FOLDER COMMAND...
    rm -rf "$1"
    "${@:2}"
}

bootstrap() { # SUITE CACHE ROOT
    local suite=$1 cache=$2 root=$3 mirror keyring proxy
    mirror=${AZULEJO_DEBIAN_MIRROR:-$(find_mirror)}
    [ -n "$mirror" ] || { apt-get update -qq >&2 && mirror=$(find_mirror); }
    [ -n "$mirror" ] || die "no Debian mirror among apt's sources; set AZULEJO_DEBIAN_MIRROR to one"
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    [ -r "$keyring" ] || die "$keyring is missing; apt-get install debian-archive-keyring"
    proxy=$(apt-config shell proxy Acquire::http::Proxy)
    eval "$proxy" # apt-config prints proxy='...', or nothing
    [ -z "${proxy:-}" ] || export http_proxy=${http_proxy:-$proxy}

    mkdir -p "$cache/packages"
    attempts from_nothing "$root" debootstrap --variant=minbase --keyring="$keyring" \
        --cache-dir="$cache/packages" "$suite" "$root" "$mirror" >"$cache/bootstrap.log" 2>&1 ||
        die "debootstrap failed; $cache/bootstrap.log ends with: $(tail -n 3 "$cache/bootstrap.log")"
    apt_settings >"$root/etc/apt/apt.conf.d/90machine"
    # A root that can be made anew need not wait for the disk.
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
    # For a mirror behind https: the small root has no certificates.
    mkdir -p "$root/etc/ssl/certs"
    local certificates=/etc/ssl/certs/ca-certificates.crt
    [ ! -e "$certificates" ] || cp -L "$certificates" "$root$certificates"
}

# Tells the root how to reach the network.
network() { # ROOT
    cp -L /etc/resolv.conf "$1/etc/resolv.conf"
    cp -L /etc/hosts "$1/etc/hosts"
}

# Mounts what the system needs; all of it vanishes with the namespace.
mount_system() { # ROOT
    mount -t proc proc "$1/proc"
    mount --rbind /sys "$1/sys"
    mount --rbind /dev "$1/dev"
}

# Mounts a folder or file of the machine read-only in the root.
show() { # OUTSIDE INSIDE
    if [ -d "$1" ]; then mkdir -p "$2"; else touch "$2"; fi
    mount --bind "$1" "$2"
    mount -o remount,bind,ro "$2"
}

install_packages() { # CACHE ROOT PACKAGE...
    local cache=$1 root=$2
    shift 2
    echo "$(basename "$0"): installing in $root: $*" >&2
    network "$root"
    attempts chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -ec '
        dpkg --configure -a
        apt-get update -qq
        apt-get install -qq --no-install-recommends -o Acquire::Retries=3 "$@"
        apt-get clean' sh "$@" >"$cache/install.log" 2>&1 ||
        die "apt-get failed in the root; $cache/install.log ends with: $(tail -n 3 "$cache/install.log")"
}

base_root() { # RELEASE CACHE
    local cache=$2 root=$2/base stamp="${base_packages[*]}" suite
    suite=$(suite_of "$1")
    [ "$(cat "$root/etc/azulejo-base" 2>/dev/null)" != "$stamp" ] || return 0
    echo "$(basename "$0"): making a Debian $1 root in $root (about a minute, 600 MB)" >&2
    rm -rf "$root" "$root.partial"
    bootstrap "$suite" "$cache" "$root.partial"
    install_packages "$cache" "$root.partial" "${base_packages[@]}"
    echo "$stamp" >"$root.partial/etc/azulejo-base"
    # The name base stands for a finished one.
    mv "$root.partial" "$root"
}
