#!/usr/bin/env bash
# Tests the C and C++ interface of an installed azulejo.
#
#   tests/c/run.sh PREFIX [--valgrind]
#
# The headers compile without a warning in every standard, and in C++ without exceptions and RTTI; the shared library
# exports what symbols.txt says and has its SONAME; the test programs pass, plainly and with --valgrind also under valgrind,
# as many at a time as there are cores. AZULEJO_ROUNDS=10 makes the longest ones shorter. Sanitizers, which run all programs,
# are those of sanitized.sh.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
usage() {
    sed -n '4s/^# *//p' "$0" >&2
    exit 2
}
[ $# -ge 1 ] && [ -d "$1" ] || usage
prefix=$(cd "$1" && pwd)
shift
modes=(plain)
for option; do
    case $option in
        --valgrind) modes+=(valgrind) ;;
        *) usage ;;
    esac
done

cc=${CC:-cc}
cxx=${CXX:-c++}
library=$(find "$prefix" -name libazulejo.so | head -n 1)
[ -n "$library" ] || { echo "run.sh: no libazulejo.so below $prefix" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$here/../..
. "$here/version.sh"
. "$here/beside.sh"

warnings=(-Wall -Wextra -Wpedantic -Werror)
# The flags of many game engines, and of tests/c/no_exceptions*.cpp.
bare=(-fno-exceptions -fno-rtti)
include=(-I "$prefix/include")
link=(-L "$(dirname "$library")" -Wl,-rpath,"$(dirname "$library")" -lazulejo -lpthread -lm)
# The Embree that the library loads, for programs that have a scene of their own; empty if it was built without.
embree=$(sed -n 's/^set(azulejo_EMBREE embree\([34]\))$/\1/p' "$(find "$prefix" -name azulejo-config.cmake)")
[ -z "$embree" ] || link+=(-Wl,--as-needed "-lembree$embree")
include+=("-DEMBREE_MAJOR=${embree:-0}")
if [ -n "${EMBREE_DIR:-}" ]; then
    include+=(-isystem "$EMBREE_DIR/include")
    link=(-L "$EMBREE_DIR/lib" -L "$EMBREE_DIR/lib64" "-Wl,-rpath,$EMBREE_DIR/lib" "${link[@]}")
fi

# Says how a step went, and in how many seconds, with its output where that matters: step NAME COMMAND...
step() {
    local name=$1 log=$work/log began=$SECONDS
    shift
    if "$@" >"$log" 2>&1; then
        printf '%-34s %3d s  %s\n' "$name" $((SECONDS - began)) "$(tail -n 1 "$log" | grep -E '[0-9]+ passed' || echo ok)"
    else
        printf '%-34s FAILED\n' "$name"
        sed 's/^/    /' "$log"
        return 1
    fi
}

header_compiles() { # LANGUAGE STANDARD FILE FLAG...
    local strict=() compiler=$cc
    case $1 in
        c) strict=(-Wstrict-prototypes) ;;
        c++) compiler=$cxx ;;
    esac
    "$compiler" -x "$1" "-std=$2" "${warnings[@]}" "${strict[@]}" "${@:4}" -fsyntax-only "$prefix/include/$3"
}

exports() { nm --dynamic --defined-only --format=posix "$library" | awk '{ print $1 }' | LC_ALL=C sort; }

has_soname() { readelf --dynamic "$library" | grep -F "Library soname: [libazulejo.so.$abi]"; }

needs_nothing_else() { # libraries that are not the C runtime's
    local others
    others=$(readelf --dynamic "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
        grep -vE '^(libc|libm|libgcc_s|libpthread|libdl|ld-linux.*)\.so\.[0-9]+$' || true)
    [ -z "$others" ] || { echo "$others"; return 1; }
}

# Programs are built once, for all modes.
built=$work/built
mkdir "$built"
build() { # SOURCE
    local compiler=("$cxx" -std=c++17)
    case $1 in
        *.c) compiler=("$cc" -std=gnu11 -Wstrict-prototypes) ;;
        */no_exceptions*) compiler+=("${bare[@]}") ;;
    esac
    "${compiler[@]}" -O1 -g "${warnings[@]}" "${include[@]}" "$1" -o "$built/$(basename "$1")" "${link[@]}"
}

run_plain() { "$built/$(basename "$1")"; }

run_valgrind() {
    AZULEJO_MEMORY_IS_WATCHED=1 AZULEJO_ROUNDS=10 valgrind --quiet --error-exitcode=1 --leak-check=full \
        --errors-for-leak-kinds=definite,indirect --show-leak-kinds=definite,indirect "$built/$(basename "$1")"
}

# host.c has a scene of Embree's; without.c asks a library without Embree what is left.
programs=()
for source in "$here"/*.c "$here"/*.cpp; do
    case ${embree:-none}-$(basename "$source") in
        none-host.c | [34]-without.c) continue ;;
    esac
    programs+=("$source")
done

beside step "azulejo.h as C99" header_compiles c c99 azulejo.h
for header in "$prefix"/include/azulejo/*.h; do
    beside step "azulejo/$(basename "$header") alone" header_compiles c c99 "azulejo/$(basename "$header")"
done
beside step "azulejo.h as C11" header_compiles c c11 azulejo.h
beside step "azulejo.h as C++17" header_compiles c++ c++17 azulejo.h
beside step "azulejo.hpp as C++17" header_compiles c++ c++17 azulejo.hpp
beside step "azulejo.hpp as C++20" header_compiles c++ c++20 azulejo.hpp
beside step "azulejo.hpp, no exceptions or RTTI" header_compiles c++ c++17 azulejo.hpp "${bare[@]}"
exports >"$work/symbols.txt"
beside step "exported symbols" diff "$here/symbols.txt" "$work/symbols.txt"
beside step "SONAME" has_soname
beside step "needed libraries" needs_nothing_else
for source in "${programs[@]}"; do
    beside build "$source"
done
all_done
# It measures what threads do, and has the machine for itself. Valgrind lets one thread work at a time: there is nothing to
# measure.
apart step "num_threads.c (plain)" run_plain num_threads.c
for mode in "${modes[@]}"; do
    for source in "${programs[@]}"; do
        name=$(basename "$source")
        [ $name = num_threads.c ] || beside step "$name ($mode)" "run_$mode" "$source"
    done
done
all_done
