#!/usr/bin/env bash
# Tests azulejo, without Embree, on processors and systems other than this machine's, which are emulated.
#
#   scripts/platforms.sh [x86-levels] [arm64] [windows]
#
# x86-levels: the sums on processors of x86 without AVX, and without AVX-512, whose vector code the unit tests run on this
# machine.
# arm64: qemu runs C and C++ programs that link the shared library of CMake's build, and the sums.
# windows: DLL and command line are built by MinGW's compiler; wine runs C and C++ programs, the command line and the sums.
# All of it, if none is named. Rust's standard library for a target is installed by rustup; where that cannot be had,
# nightly builds it from its sources; without those the target is skipped, which is said.
set -euo pipefail
cd "$(dirname "$0")/.."

arm=aarch64-unknown-linux-gnu windows=x86_64-pc-windows-gnu
targets=()
for argument; do
    case $argument in
        x86-levels | arm64 | windows) targets+=("$argument") ;;
        *)
            sed -n '4s/^# *//p' "$0" >&2
            exit 2
            ;;
    esac
done
[ ${#targets[@]} -gt 0 ] || targets=(x86-levels arm64 windows)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Nothing waits for builds for this machine, which may run at the same time.
build=target/platforms
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc

# TARGET: sees to Rust's standard library for it, or prints what is left out. Sets std: variables for cargo, if cargo
# builds it.
has_std() {
    std=()
    if [ -d "$(rustc --print target-libdir --target "$1")" ] || rustup target add "$1" >/dev/null 2>&1; then
        return
    fi
    std=(RUSTUP_TOOLCHAIN=nightly CARGO_UNSTABLE_BUILD_STD=std)
    [ -d "$(rustc +nightly --print sysroot 2>/dev/null)/lib/rustlib/src/rust/library" ] ||
        { echo "SKIPPED: $1, whose standard library neither rustup can install nor nightly build" && return 1; }
}

# SUBCOMMAND ARGUMENT...: cargo for the target at hand, without Embree.
run_cargo() {
    env "${std[@]}" cargo "$1" --quiet --locked --no-default-features --target-dir $build --target "$target" "${@:2}"
}

# NAME CMAKE-ARGUMENT...: the libraries as CMake lays them out, in $build/NAME/lib. Cargo finds what it has compiled before.
layout_libraries() {
    mkdir -p "$build/$1"
    ln -sfn "$PWD/$build" "$build/$1/cargo"
    cmake -S . -B "$build/$1" -D AZULEJO_EMBREE=OFF -D AZULEJO_CARGO_PROFILE=dev -D AZULEJO_CARGO_FLAGS=--locked \
        "${@:2}" >/dev/null
    env "${std[@]}" cmake --build "$build/$1"
}

# COMMAND... --package NAME: builds the package and the test program of the sums at once, so that what they share is
# compiled once, and prints where the program is.
sums_program() {
    "$@" --lib --package azulejo-conformance --test sums --message-format=json |
        sed -n 's/.*"name":"sums".*"executable":"\([^"]*\)".*/\1/p'
}

x86_levels() {
    local program level
    [ "$(uname -m)" = x86_64 ] || { echo "SKIPPED: levels of x86, on another processor" && return; }
    program=$(sums_program cargo build --quiet --locked --no-default-features)
    for level in Nehalem Haswell; do
        echo "sums on $level"
        # Qemu names each feature that it does not emulate.
        qemu-x86_64-static -cpu $level "$program" --quiet 2>&1 | grep -v "TCG doesn't support"
    done
}

# RUNNER-FUNCTION CC CXX FOLDER SUFFIX SOURCE...: compiles the programs against the library in the folder, and runs them.
run_programs() {
    local runner=$1 cc=$2 cxx=$3 library=$4 suffix=$5 source name compiler
    for source in "${@:6}"; do
        name=$(basename "$source")
        compiler=("$cxx" -std=c++17)
        case $name in
            *.c) compiler=("$cc" -std=gnu11) ;;
            no_exceptions*) compiler+=(-fno-exceptions -fno-rtti) ;;
        esac
        "${compiler[@]}" -O1 -Wall -Wextra -Wpedantic -Werror -D EMBREE_MAJOR=0 -I include "$source" \
            -o "$work/$name$suffix" -L "$library" -lazulejo -lpthread -lm
        printf '%-24s ' "$name"
        AZULEJO_ROUNDS=10 "$runner" "$work/$name$suffix" >"$work/said" 2>&1 || { cat "$work/said" && return 1; }
        tail -n 1 "$work/said" | tr -d '\r' | grep -E '[0-9]+ passed' || echo ok
    done
}

# NAME...: the sources of all programs but those named.
programs() {
    local source
    for source in tests/c/*.c tests/c/*.cpp; do
        [[ " $* " == *" $(basename "$source") "* ]] || echo "$source"
    done
}

on_arm64() { qemu-aarch64-static -L /usr/aarch64-linux-gnu -E "LD_LIBRARY_PATH=$PWD/$library" "$@"; }

arm64() {
    local target=$arm program sources library=$build/arm64/lib
    has_std $target || return 0
    program=$(sums_program run_cargo build --package azulejo-c)
    layout_libraries arm64 -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=aarch64 \
        -D CMAKE_C_COMPILER=aarch64-linux-gnu-gcc
    # What has a scene of Embree's, and what times threads.
    mapfile -t sources < <(programs host.c num_threads.c)
    run_programs on_arm64 aarch64-linux-gnu-gcc aarch64-linux-gnu-g++ "$library" "" "${sources[@]}"
    on_arm64 "$program" --quiet
}

to_windows() { tr / '\\' <<<"Z:$1"; }

# PROGRAM ARGUMENT...: what belongs to wine, with a folder of its own, where it finds the DLLs of the libraries and of the
# compiler.
with_wine() {
    WINEPREFIX=$PWD/$build/wine WINEDEBUG=-all WINEPATH=$(to_windows "$PWD/$build/dlls") "/usr/lib/wine/$1" "${@:2}"
}

on_windows() { with_wine wine64 "$@"; }

# The folder is made, and what does so has ended, before a program runs, which it may kill. Then one server for all
# programs: one that ends when it has no program left may kill the next, too.
serve_windows() {
    mkdir -p $build/wine
    with_wine wine64 wineboot --init </dev/null >/dev/null 2>&1
    with_wine wineserver64 --wait
    with_wine wineserver64 --persistent
    trap 'with_wine wineserver64 --kill; rm -rf "$work"' EXIT
}

# The DLLs that programs ask for. Debian's wine 8 lacks the one that Rust's standard library has random numbers from.
gather_dlls() {
    local name
    mkdir -p $build/dlls
    cp $build/windows/lib/azulejo.dll $build/dlls
    for name in libstdc++-6 libgcc_s_seh-1 libwinpthread-1; do
        cp "$(x86_64-w64-mingw32-g++ -print-file-name=$name.dll)" $build/dlls
    done
    x86_64-w64-mingw32-gcc -shared -x c - -o $build/dlls/bcryptprimitives.dll -ladvapi32 <<'END'
#include <windows.h>
BOOLEAN WINAPI SystemFunction036(PVOID to, ULONG size);
BOOL WINAPI ProcessPrng(PBYTE to, SIZE_T size) { return SystemFunction036(to, (ULONG)size); }
END
}

# The command line: a set in a file is that of the standard output, and is read from the standard input.
command_line() {
    local program=$build/$windows/debug/azulejo.exe
    run_cargo build --package azulejo-cli
    on_windows $program plane --radius 0.05 --seed 3 --output "$(to_windows "$work")\\file.csv"
    on_windows $program plane --radius 0.05 --seed 3 --output - --format csv | cmp - "$work/file.csv"
    on_windows $program analyze --input-format csv - <"$work/file.csv" >/dev/null
    echo "azulejo.exe              ok"
}

windows() {
    local target=$windows sources
    has_std $target || return 0
    if [ ${#std[@]} -gt 0 ] && ! command -v x86_64-w64-mingw32-dlltool >/dev/null; then
        echo "SKIPPED: $target, whose standard library nightly cannot build without MinGW's dlltool"
        return
    fi
    layout_libraries windows -D CMAKE_SYSTEM_NAME=Windows -D CMAKE_SYSTEM_PROCESSOR=x86_64 \
        -D CMAKE_C_COMPILER=x86_64-w64-mingw32-gcc
    gather_dlls
    serve_windows
    # Nor what calls POSIX.
    mapfile -t sources < <(programs host.c num_threads.c faults.c files.c frozen.c memory.c throwing.cpp)
    run_programs on_windows x86_64-w64-mingw32-gcc x86_64-w64-mingw32-g++ $build/windows/lib .exe "${sources[@]}"
    command_line
    on_windows "$(sums_program run_cargo build)" --quiet
}

for target in "${targets[@]}"; do
    "${target/-/_}"
done
