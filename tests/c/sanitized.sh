#!/usr/bin/env bash
# Runs the C and C++ test programs with a libazulejo whose Rust is instrumented, too.
#
#   tests/c/sanitized.sh address|thread
#
# address: AddressSanitizer, with the overflow checks and debug assertions of Rust: the library that is fuzzed; undefined
# behaviour of the programs is a trap, which needs no second runtime. thread:
# ThreadSanitizer, for what several threads do; it needs Rust's standard library instrumented, or it would not see its
# locks. A canary shows that the Rust was instrumented: it gives the library a wrong word, which only the sanitizer can
# see. Needs a nightly compiler, and for threads its component rust-src; what is missing is said.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/tests/c
sanitizer=${1:?usage: tests/c/sanitized.sh address|thread}
checks=("-fsanitize=$sanitizer")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$here/examples.sh"
. "$here/beside.sh"

skip() {
    echo "SKIPPED: the $sanitizer sanitizer in Rust, since there is no $1 here"
    exit 0
}
rustc +nightly --version >/dev/null 2>&1 || skip "nightly compiler"
. "$root/scripts/instrumented.sh"
sysroot=$(rustc +nightly --print sysroot)

case $sanitizer in
    address)
        target=$instrumented
        library=$target/libazulejo_c.a
        # Beside the fuzz targets, whose features the compiled library has.
        build_library() { cargo_instrumented build --package azulejo-fuzz --package azulejo-c-abi --lib; }
        runtime=asan
        checks+=(-fsanitize=undefined -fsanitize-undefined-trap-on-error -fno-sanitize=vptr)
        caught="AddressSanitizer: heap-buffer-overflow"
        # without.c is for a library without Embree, and this one has it.
        mapfile -t programs < <(find "$here" -maxdepth 1 -name '*.c' ! -name without.c -o -maxdepth 1 -name '*.cpp' | sort)
        ;;
    thread)
        [ -d "$sysroot/lib/rustlib/src/rust/library" ] || skip "nightly component rust-src"
        target=$root/target/sanitizers/thread/$host/debug
        library=$target/libazulejo.a
        build_library() {
            (cd "$root" && RUSTFLAGS=-Zsanitizer=thread CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=line-tables-only \
                cargo +nightly rustc --quiet --locked -Zbuild-std --package azulejo-c --crate-type staticlib \
                --target "$host" --target-dir "$root/target/sanitizers/thread")
        }
        runtime=tsan
        caught="ThreadSanitizer: data race"
        programs=("$here"/threads.c "$here"/progress.c)
        # Nobody instruments Embree and TBB: what they lock is invisible, and C++'s library is theirs alone here.
        printf '%s\n' {race,called_from_lib}:lib{embree3,embree4,tbb}.so race:libstdc++.so >"$work/suppressions"
        export TSAN_OPTIONS="suppressions=$work/suppressions"
        ;;
    *) skip "sanitizer of this name" ;;
esac
runtime=$sysroot/lib/rustlib/$host/lib/librustc-nightly_rt.$runtime.a
[ -f "$runtime" ] || skip "$(basename "$runtime")"

# Sizes that no memory has are refused; a hundred rounds show what a thousand do. handles.c does not use freed handles here,
# which only a library that is not instrumented can refuse.
export ASAN_OPTIONS=allocator_may_return_null=1 AZULEJO_ROUNDS=100 AZULEJO_MEMORY_IS_WATCHED=1

# The Embree that the library was built for: embree3 or embree4.
embree() { sed -n 's/^cargo::metadata=library=//p' "$target"/build/azulejo-embree-sys-*/output | tail -n 1; }

# The runtime is that of the Rust compiler, for C, too: it knows the calls of both.
build_program() { # SOURCE OUTPUT
    local compiler=(cc -std=gnu11)
    case $1 in
        */no_exceptions*) compiler=(c++ -std=c++17 -fno-exceptions -fno-rtti) ;;
        *.cpp) compiler=(c++ -std=c++17) ;;
    esac
    "${compiler[@]}" -O1 -g "${checks[@]}" -DEMBREE_MAJOR="${embree#embree}" -I "$root/include" -c "$1" -o "$2.o" &&
        c++ "$2.o" -o "$2" "$library" -Wl,--whole-archive "$runtime" -Wl,--no-whole-archive -Wl,--export-dynamic \
            "-l$embree" -lpthread -ldl -lm -lrt
}

run_program() { # SOURCE
    local program
    program=$work/$(basename "$1")
    program=${program%.*}
    build_program "$1" "$program" && "$program"
}

canary_is_caught() {
    run_program "$here/canaries/$sanitizer.c" >"$work/canary" 2>&1 && return 1
    cat "$work/canary"
    # The access is the library's, not the program's.
    grep -q "$caught" "$work/canary" && grep -q "#[0-9].*$root/src/" "$work/canary"
}

step "$sanitizer: the library is built" build_library
embree=$(embree)
step "$sanitizer: the canary is caught" canary_is_caught
for program in "${programs[@]}"; do
    beside step "$sanitizer: $(basename "$program")" run_program "$program"
done
all_done
