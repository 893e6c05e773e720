#!/usr/bin/env bash
# Runs the calls of the C ABI that need no Embree and one thread, and the tests of the border, under Miri.
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

# What asks for files gets no answer in there. Miri warns of optimisations, which it does without.
export MIRIFLAGS=-Zmiri-isolation-error=hide CARGO_PROFILE_DEV_OPT_LEVEL=0 CARGO_INCREMENTAL=0
cargo +nightly miri test --quiet --locked --package azulejo-c --lib --target-dir target/miri
cargo +nightly miri test --quiet --locked --manifest-path fuzz/Cargo.toml --package azulejo-c-abi --target-dir target/miri
