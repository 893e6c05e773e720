#!/usr/bin/env bash
# Packs the sources with all crates of the workspace: target/source/azulejo-VERSION.tar.gz, the same bytes for the same commit.
# With Rust and CMake it builds without a network and without a registry's files:
#
#   tar -xf azulejo-VERSION.tar.gz && cmake -S azulejo-VERSION -B build && cmake --build build
#
#   packaging/source.sh           packs it. Changes at hand that git knows are in it. The crates of the bindings for Python and
#                                 JavaScript and of fuzz/, which have workspaces of their own, are not.
#   packaging/source.sh --test    builds what was packed so, without Embree and hardly optimised, and uses it
set -euo pipefail
cd "$(dirname "$0")/.."

version=$(sed -n '/^\[workspace\.package\]/,/^$/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
name=azulejo-$version
work=$PWD/target/source

pack() {
    local commit
    commit=$(git stash create)
    rm -rf "$work"
    mkdir -p "$work/$name/.cargo"
    git archive "${commit:-HEAD}" | tar -x -C "$work/$name"
    # The notices of third parties find a crate by its name and version (cmake/notices.cmake).
    (cd "$work/$name" && cargo vendor --quiet --locked --versioned-dirs vendor >/dev/null)
    cat >"$work/$name/.cargo/config.toml" <<'TOML'
# Crates come from this folder alone.
[source.crates-io]
replace-with = "vendor"

[source.vendor]
directory = "vendor"

[net]
offline = true
TOML
    tar --sort=name --mtime="@$(git show --no-patch --format=%ct HEAD)" --owner=0 --group=0 --numeric-owner --format=gnu \
        -C "$work" -c "$name" | gzip -n -9 >"$work/$name.tar.gz"
    rm -r "${work:?}/$name"
    echo "$work/$name.tar.gz"
}

# A root has a network of its own, which is none; others have cargo's word.
without_network() { if [ "$(id -u)" = 0 ] && unshare --net true 2>/dev/null; then unshare --net "$@"; else "$@"; fi; }

# COMMAND...: cargo finds nothing but what was packed. Compiled as fast as can be: it is not for its speed.
alone() {
    without_network env CARGO_HOME="$work/home" CARGO_NET_OFFLINE=true CARGO_PROFILE_DEV_OPT_LEVEL=0 "$@"
}

try() {
    rm -rf "$work/$name" "$work/build" "$work/home" "$work/prefix" "$work/use"
    tar -xf "$work/$name.tar.gz" -C "$work"
    mkdir "$work/home"
    cmake -S "$work/$name" -B "$work/build" -D AZULEJO_EMBREE=OFF -D AZULEJO_CARGO_PROFILE=dev \
        -D AZULEJO_CARGO_FLAGS=--locked -D CMAKE_INSTALL_PREFIX="$work/prefix" >/dev/null
    alone cmake --build "$work/build"
    cmake --install "$work/build" >/dev/null
    cmake -S packaging/conan/test_package -B "$work/use" -D CMAKE_PREFIX_PATH="$work/prefix" >/dev/null
    cmake --build "$work/use" >/dev/null
    "$work/use/shared" && "$work/use/static"
    rm -r "${work:?}/$name" "$work/build"
}

case ${1:-} in
    "") pack ;;
    --test) try ;;
    *)
        sed -n '/^#   packaging/s/^# *//p' "$0" >&2
        exit 2
        ;;
esac
