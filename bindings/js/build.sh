#!/usr/bin/env bash
# Builds azulejo.wasm and azulejo-threads.wasm, which belong to the package.
#
#   bindings/js/build.sh            as they are published
#   bindings/js/build.sh --brief    without the one with threads, for tests
set -euo pipefail
cd "$(dirname "$0")"

threads=yes
case ${1:-} in
    "") ;;
    --brief) threads=no ;;
    *)
        sed -n '/^#   /s/^# *//p' "$0" >&2
        exit 2
        ;;
esac

# FOLDER: where cargo built them. NAME: what follows the names.
take() {
    cp "$1/azulejo_js.wasm" "azulejo$2.wasm"
    cp "$1/azulejo_js_sums.wasm" "target/sums$2.wasm"
    echo "azulejo$2.wasm: $(stat -c %s "azulejo$2.wasm") bytes, $(gzip -9 -c "azulejo$2.wasm" | wc -c) with gzip"
}

# The standard library of the target has no threads in mind: it is compiled with atomic instructions, from its sources, which
# cargo does only where the compiler takes itself for a nightly one (last tried with Rust 1.95). Memory is imported, as all
# threads have the same; its first pages hold the constants and the first stack (MEMORY in pool.js).
build_threads() {
    local flags="-C target-feature=+atomics,+bulk-memory,+mutable-globals" argument
    for argument in shared-memory import-memory export-memory initial-memory=$((64 << 16)) max-memory=$((65536 << 16)) \
        export=__stack_pointer export=__wasm_init_tls export=__tls_size export=__tls_align; do
        flags+=" -C link-arg=--$argument"
    done
    # The compiler warns of each crate that its target is not a stable one.
    RUSTC_BOOTSTRAP=1 RUSTFLAGS=$flags cargo build --quiet --locked --release --target wasm32-unknown-unknown \
        -Z build-std=std,panic_abort --target-dir target/threads --workspace 2>target/threads.log ||
        { cat target/threads.log >&2; return 1; }
}

rustup target list --installed | grep -qx wasm32-unknown-unknown || rustup target add wasm32-unknown-unknown
cargo build --quiet --locked --release --target wasm32-unknown-unknown \
    --target-dir target --workspace
take target/wasm32-unknown-unknown/release ""

rm -f azulejo-threads.wasm target/sums-threads.wasm
if [ $threads = no ]; then
    echo "SKIPPED: azulejo-threads.wasm (--long)"
elif rustup component list --installed | grep -qx rust-src || rustup component add rust-src >/dev/null 2>&1; then
    build_threads
    take target/threads/wasm32-unknown-unknown/release -threads
else
    echo "SKIPPED: azulejo-threads.wasm (rustup has no rust-src)"
fi
