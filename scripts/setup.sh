#!/usr/bin/env bash
# Installs what azulejo needs to be built on Debian 12 or 13 and Ubuntu 24.04, and only what is missing.
#
#   scripts/setup.sh            to build it
#   scripts/setup.sh --tests    to run scripts/test.sh, too
#   scripts/setup.sh --all      to run scripts/test.sh --all, too
#   scripts/setup.sh --long     to run scripts/test.sh --long, too
#
# Says what it installs, and nothing if there is nothing to install. Needs root, or asks sudo for it. Rust is checked,
# not installed.
set -euo pipefail

packages=(libembree-dev libclang-dev g++ make cmake pkg-config)
# Meshes of tests/all/mesh_corpus.rs.
test_packages=(assimp-testmodels)
all_packages=(debootstrap debian-archive-keyring dpkg-dev file openmpi-bin libopenmpi-dev doxygen python3-venv chromium)
# What only a long run needs; the libraries for the packages bpy and Open3D, which open no window.
long_packages=(valgrind qemu-user-static g++-aarch64-linux-gnu g++-mingw-w64-x86-64-posix wine64 patch
               libatomic1 libegl1 libgl1 libsm6 libusb-1.0-0 libxfixes3 libxi6 libxkbcommon0 libxrender1)

die() {
    echo "setup.sh: $*" >&2
    exit 1
}

# The Rust version of Cargo.toml or later: what distributions ship is often too old.
check_rust() {
    local wanted found advice="install it with rustup"
    wanted=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' "$(dirname "$0")/../Cargo.toml")
    command -v cargo >/dev/null || die "Rust $wanted or later is needed, and cargo is not on the PATH: $advice"
    found=$(cargo --version | cut -d ' ' -f 2)
    # The smaller of both versions is the wanted one.
    [ "$(printf '%s\n' "$wanted" "$found" | sort -V | head -n 1)" = "$wanted" ] ||
        die "Rust $wanted or later is needed, and cargo is of version $found: $advice"
}

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Mirrors fail now and then: three attempts, and within them some for each file.
apt() {
    local attempt
    for attempt in 1 2 3; do
        "$@" apt-get update -qq -o Acquire::Retries=3 &&
            "$@" env DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends \
                -o Acquire::Retries=3 "${missing[@]}" && return
        sleep $((10 * attempt))
    done
    return 1
}

install_missing() {
    local missing=() sudo=() output
    for package in "$@"; do
        is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    echo "setup.sh: installing ${missing[*]}" >&2
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || die "not root, and there is no sudo: have root install ${missing[*]}"
        sudo=(sudo)
    fi
    output=$(apt "${sudo[@]}" 2>&1) || die "apt-get could not install ${missing[*]}: $(tail -n 20 <<<"$output")"
}

# Adds a component to a compiler, if it can be had.
add_component() {
    rustup component list --toolchain "$1" --installed 2>/dev/null | grep -qE "^$2(-|$)" && return
    echo "setup.sh: adding $2 to the compiler $1" >&2
    rustup component add --toolchain "$1" "$2" >/dev/null 2>&1 || echo "setup.sh: it cannot be had" >&2
}

# The sources of the standard library, which bindings/js/build.sh compiles for threads on WebAssembly; where there is a nightly
# compiler, what sanitizers and Miri need of it. Tests that lack some of it say so and are skipped.
add_components() {
    command -v rustup >/dev/null || return 0
    add_component "$(rustup show active-toolchain | cut -d ' ' -f 1)" rust-src
    rustc +nightly --version >/dev/null 2>&1 || return 0
    add_component nightly rust-src
    add_component nightly miri
}

case "${1:-}" in
"") ;;
--tests) packages+=("${test_packages[@]}") ;;
--all) packages+=("${test_packages[@]}" "${all_packages[@]}") ;;
--long) packages+=("${test_packages[@]}" "${all_packages[@]}" "${long_packages[@]}") ;;
*) die "unknown argument $1; there are --tests, --all and --long" ;;
esac
command -v apt-get >/dev/null || die "no apt-get here: install Embree (4, or 3.13), libclang, a C++ compiler and CMake"
check_rust
install_missing "${packages[@]}"
[ "${1:-}" != --long ] || add_components
