#!/usr/bin/env bash
# Tests the FFI boundary under Miri: its unit tests, and each call of the C ABI that needs neither Embree nor a second
# thread.
#
#   scripts/miri.sh
#
# Needs a nightly compiler with its component miri; without it nothing is done, which is said.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! cargo +nightly miri --version >/dev/null 2>&1; then
    echo "SKIPPED: Miri, since there is no nightly compiler with it here"
    exit 0
fi

# Code that asks for files gets an error inside. Miri ignores optimisations and warns of them.
export MIRIFLAGS=-Zmiri-isolation-error=hide CARGO_PROFILE_DEV_OPT_LEVEL=0 CARGO_INCREMENTAL=0
cargo +nightly miri test --quiet --locked --package azulejo-c --lib --target-dir target/miri
cargo +nightly miri test --quiet --locked --manifest-path fuzz/Cargo.toml --package azulejo-c-abi --target-dir target/miri
