#!/usr/bin/env bash
# Tests the CMake package: builds and installs azulejo into a temporary prefix and uses it as other projects do.
#
#   tests/c/package.sh [--brief] [--dev] [--share] [--quick] [--keep DIR]
#
# With --keep the library is built and installed in DIR (DIR/build, DIR/prefix), which stays. With --brief it is used in one
# place only; with --dev it is that of cargo's profile dev, and with --share in the project's target folder, where the tests
# have compiled it, instead of DIR/build/cargo. --quick is all three, and without MPI.
# examples_c outside the tree, shared and static, through find_package; plane.c through pkg-config; as a guest in other
# programs (guest.sh); all again from a prefix that was moved; through add_subdirectory; Embree is loaded on use (lazy.sh);
# debugging information is beside the library; licences are installed; and a version that is not there is refused.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
base=$work quick=no brief=no share=no profile=release
while [ $# -gt 0 ]; do
    case $1 in
        --quick) quick=yes brief=yes share=yes profile=dev ;;
        --share) share=yes ;;
        --brief) brief=yes ;;
        --dev) profile=dev ;;
        --keep)
            mkdir -p "${2:?--keep needs a directory}"
            base=$(cd "$2" && pwd)
            shift
            ;;
        *)
            sed -n '4s/^# *//p' "$0" >&2
            exit 2
            ;;
    esac
    shift
done
prefix=$base/prefix

. "$root/tests/c/examples.sh"
. "$root/tests/c/version.sh"

install_library() {
    if [ $share = yes ]; then
        mkdir -p "$base/build" && ln -sfn "$root/target" "$base/build/cargo"
    fi
    cmake -S "$root" -B "$base/build" -DAZULEJO_CARGO_PROFILE=$profile \
        -DAZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" && cmake --build "$base/build" && cmake --install "$base/build" --prefix "$prefix"
}

as_subdirectory() {
    mkdir -p "$work/host"
    cat >"$work/host/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.20)
project(host LANGUAGES C CXX)
add_subdirectory("$root" azulejo)
add_subdirectory("$root/examples_c" examples)
END
    # The library is the one that was built above: cargo finds its work done.
    mkdir -p "$work/host-build/azulejo" && ln -sfn "$base/build/cargo" "$work/host-build/azulejo/cargo"
    cmake -S "$work/host" -B "$work/host-build" -DAZULEJO_CARGO_PROFILE=$profile \
        -DAZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" &&
        cmake --build "$work/host-build" -j "${CARGO_BUILD_JOBS:-$(nproc)}"
}

find_version() { # VERSION
    mkdir -p "$work/version"
    printf 'cmake_minimum_required(VERSION 3.20)\nproject(v C)\nfind_package(azulejo %s CONFIG REQUIRED)\n' "$1" \
        >"$work/version/CMakeLists.txt"
    rm -rf "$work/version-build"
    cmake -S "$work/version" -B "$work/version-build" -DCMAKE_PREFIX_PATH="$prefix"
}

version_refused() { fails find_version "$1" && grep -q "compatible with requested version" "$work/log"; }

# The licences of azulejo and of the crates that it contains.
has_licences() {
    local folder=$prefix/share/doc/azulejo
    cmp "$root/LICENSE-MIT" "$folder/LICENSE-MIT" && cmp "$root/LICENSE-APACHE" "$folder/LICENSE-APACHE" &&
        grep -q '^  rayon [0-9.]* (MIT OR Apache-2.0)$' "$folder/THIRD-PARTY.txt" &&
        grep -q '^--- rayon-[0-9.]*' "$folder/THIRD-PARTY.txt"
}

# The library is small, and the file beside it is found by the name and the checksum in it. (The profile dev has no
# debugging information, but symbols, and checks that make it larger.)
has_debug_file() {
    local library debug
    library=$(readlink -f "$(find "$prefix" -name libazulejo.so)") debug=$(dirname "$library")/.debug/$(basename "$library").debug
    fails has_section .symtab "$library" && fails has_section .debug_info "$library" && has_section .symtab "$debug" &&
        { [ $profile = dev ] || { [ "$(stat -c %s "$library")" -lt 9000000 ] && has_section .debug_info "$debug"; }; } &&
        [ "$(build_id "$library")" = "$(build_id "$debug")" ] &&
        readelf --debug-dump=links --debug-dump=follow-links "$library" >"$work/links" 2>&1 && head -n 20 "$work/links" &&
        grep -qF "Found separate debug info file: $(dirname "$debug")" "$work/links"
}

has_section() { readelf --section-headers --wide "$2" | grep -qwF -- "$1"; }

build_id() { readelf --notes "$1" | grep -o 'Build ID: [0-9a-f]*'; }

static_has_no_debug_info() {
    local library
    library=$(find "$prefix" -name libazulejo.a)
    { [ $profile = dev ] || [ "$(stat -c %s "$library")" -lt 20000000 ]; } && fails has_section .debug_info "$library"
}

make_mesh
step "build and install" install_library
step "examples, shared" examples "$work/shared" "$prefix"
step "they run" run_examples "$work/shared"
step "scatter" run_scatter "$work/shared"
step "stipple" run_stipple "$work/shared"
step "dither" run_dither "$work/shared"
step "tufts" run_tufts "$work/shared"
step "forest" run_forest "$work/shared"
step "lights" run_lights "$work/shared"
step "camera" run_camera "$work/shared"
step "plants" run_plants "$work/shared"
step "paint" run_paint "$work/shared"
step "lod" run_lod "$work/shared"
[ $quick = yes ] || step "ranks" run_ranks "$work/shared"
step "pkg-config" pkg_config "$prefix"
step "pkg-config --static" pkg_config "$prefix" --static
step "it does not need libazulejo.so" is_static "$work/plane"
step "licences" has_licences
step "debugging information beside the library" has_debug_file
step "static: without debugging information" static_has_no_debug_info
"$root/tests/c/lazy.sh" "$prefix"
step "version $abi is found" find_version "$abi"
[ $brief = no ] || exit 0
step "examples, static" examples "$work/static" "$prefix" -DAZULEJO_EXAMPLES_STATIC=ON
step "they do not need libazulejo.so" is_static "$work/static/plane"
step "they run" run_examples "$work/static"
"$root/tests/c/guest.sh" "$prefix"
step "an older minor version is refused" version_refused 0.1
step "a newer minor version is refused" version_refused "${abi%.*}.$((${abi#*.} + 1))"
step "version 99 is refused" version_refused 99
cp -a "$prefix" "$work/moved to another place"
mv "$prefix" "$prefix.away"
step "moved: examples, shared" few_examples "$work/moved-shared" "$work/moved to another place"
step "moved: they run" run_examples "$work/moved-shared"
step "moved: examples, static" few_examples "$work/moved-static" "$work/moved to another place" -DAZULEJO_EXAMPLES_STATIC=ON
mv "$prefix.away" "$prefix"
cp -a "$prefix" "$work/moved"
step "moved: pkg-config" pkg_config "$work/moved"
step "add_subdirectory" as_subdirectory
step "they run" run_examples "$work/host-build/examples"
