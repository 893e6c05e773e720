#!/usr/bin/env bash
# Tests the CMake package: builds and installs azulejo into a temporary prefix and uses it as other projects do.
#
#   tests/c/package.sh [--keep DIR]      with --keep: builds and installs in DIR (DIR/build, DIR/prefix), which stays
#
# examples_c outside the tree, shared and static, through find_package; plane.c through pkg-config; all again from a
# prefix that was moved; through add_subdirectory; and a version that is not there is refused.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
base=$work
if [ "${1:-}" = --keep ]; then
    mkdir -p "${2:?--keep needs a directory}"
    base=$(cd "$2" && pwd)
fi
prefix=$base/prefix
jobs=${CARGO_BUILD_JOBS:-$(nproc)}

step() { # NAME COMMAND...
    local name=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        printf '%-44s ok\n' "$name"
    else
        printf '%-44s FAILED\n' "$name"
        tail -n 40 "$work/log" | sed 's/^/    /'
        exit 1
    fi
}

fails() { ! "$@"; }

install_library() {
    cmake -S "$root" -B "$base/build" -DAZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" &&
        cmake --build "$base/build" && cmake --install "$base/build" --prefix "$prefix"
}

make_mesh() {
    printf 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 0.5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >"$work/roof.obj"
}

examples() { # BUILD PREFIX CMAKE-ARGUMENT...: outside the tree, from a copy that knows nothing of it
    local build=$1
    rm -rf "$work/examples" && cp -r "$root/examples_c" "$work/examples"
    cmake -S "$work/examples" -B "$build" -DCMAKE_PREFIX_PATH="$2" "${@:3}" && cmake --build "$build" -j "$jobs"
}

run_examples() { # BUILD: each prints lines of finite numbers
    local build=$1
    "$build/plane" 0.05 >"$work/plane.txt" && check_numbers "$work/plane.txt" 2 200 &&
        "$build/surface" "$work/roof.obj" >"$work/surface.txt" && check_numbers "$work/surface.txt" 6 9000 &&
        "$build/relax" >"$work/relax.txt" && check_numbers "$work/relax.txt" 2 1024 &&
        fails "$build/surface" "$work/missing.obj"
}

check_numbers() { # FILE COLUMNS AT-LEAST
    awk -v columns="$2" -v least="$3" '
        NF != columns { exit bad = 1 }
        { for (i = 1; i <= NF; i++) if ($i !~ /^-?[0-9.]+(e-?[0-9]+)?$/) exit bad = 1 }
        END { exit bad || NR < least }' "$1"
}

run_scatter() { # BUILD
    "$1/scatter" "$work/roof.obj" --samples 5000 --out "$work/out" --threads 2 >"$work/table.txt" &&
        cat "$work/table.txt" && [ "$(wc -l <"$work/table.txt")" = 4 ] &&
        has_vertices surface.ply 36 && has_vertices plane.ply 8 && has_vertices relaxed.ply 8 &&
        [ "$(ls "$work/out" | wc -l)" = 3 ] && fails "$1/scatter" && fails "$1/scatter" "$work/missing.obj"
}

run_stipple() { # BUILD: a disk that fades from black to white
    awk 'BEGIN { print "P2 60 40\n# a disk\n255"; for (y = 0; y < 40; y++) for (x = 0; x < 60; x++) {
        d = ((x - 30) ^ 2 + (y - 20) ^ 2) / 225; print d < 1 ? int(255 * d) : 255 } }' >"$work/disk.pgm"
    local dots
    dots=$("$1/stipple" "$work/disk.pgm" "$work/disk.svg" 5000 | cut -d ' ' -f 1)
    [ "$dots" -gt 4500 ] && [ "$dots" -lt 6000 ] && [ "$(grep -c '^M' "$work/disk.svg")" = "$dots" ] &&
        fails "$1/stipple" && fails "$1/stipple" "$work/roof.obj" "$work/roof.svg"
}

has_vertices() { # FILE BYTES-PER-VERTEX: the file is as long as its header says
    local file=$work/out/$1 count header
    count=$(grep -a -m 1 '^element vertex ' "$file" | cut -d ' ' -f 3)
    header=$(grep -a -b -m 1 '^end_header$' "$file" | cut -d : -f 1)
    [ "$count" -gt 0 ] && [ "$(stat -c %s "$file")" = $((header + 11 + count * $2)) ]
}

is_static() { fails grep -q azulejo <(readelf --dynamic "$1"); }

pkg_config() { # PREFIX FLAG...
    local modules flags
    modules=$(dirname "$(find "$1" -name azulejo.pc)")
    flags=$(PKG_CONFIG_PATH=$modules pkg-config "${@:2}" --cflags --libs azulejo)
    if [ "${2:-}" = --static ]; then
        flags=${flags/-lazulejo/-l:libazulejo.a}
    fi
    # shellcheck disable=SC2086
    cc "$root/examples_c/plane.c" -o "$work/plane" $flags -Wl,-rpath,"$(dirname "$modules")" &&
        "$work/plane" 0.1 >"$work/plane.txt" && check_numbers "$work/plane.txt" 2 50
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
    cmake -S "$work/host" -B "$work/host-build" -DAZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" &&
        cmake --build "$work/host-build" -j "$jobs"
}

version_refused() {
    mkdir -p "$work/version"
    printf 'cmake_minimum_required(VERSION 3.20)\nproject(v C)\nfind_package(azulejo %s CONFIG REQUIRED)\n' "$1" \
        >"$work/version/CMakeLists.txt"
    rm -rf "$work/version-build"
    cmake -S "$work/version" -B "$work/version-build" -DCMAKE_PREFIX_PATH="$prefix" && return 1
    grep -q "compatible with requested version" "$work/log"
}

make_mesh
step "build and install" install_library
step "examples, shared" examples "$work/shared" "$prefix"
step "they run" run_examples "$work/shared"
step "scatter" run_scatter "$work/shared"
step "stipple" run_stipple "$work/shared"
step "examples, static" examples "$work/static" "$prefix" -DAZULEJO_EXAMPLES_STATIC=ON
step "they do not need libazulejo.so" is_static "$work/static/plane"
step "they run" run_examples "$work/static"
step "pkg-config" pkg_config "$prefix"
step "pkg-config --static" pkg_config "$prefix" --static
step "it does not need libazulejo.so" is_static "$work/plane"
step "version 99 is refused" version_refused 99
step "version 0.2 is refused" version_refused 0.2
cp -a "$prefix" "$work/moved to another place"
mv "$prefix" "$prefix.away"
step "moved: examples, shared" examples "$work/moved-shared" "$work/moved to another place"
step "moved: they run" run_examples "$work/moved-shared"
step "moved: examples, static" examples "$work/moved-static" "$work/moved to another place" -DAZULEJO_EXAMPLES_STATIC=ON
mv "$prefix.away" "$prefix"
cp -a "$prefix" "$work/moved"
step "moved: pkg-config" pkg_config "$work/moved"
step "add_subdirectory" as_subdirectory
step "they run" run_examples "$work/host-build/examples"
