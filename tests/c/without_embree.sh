#!/usr/bin/env bash
# Tests a library that is built without Embree: it needs nothing but the C runtime, its small sets have the sums of
# tests/few_sums.txt, and C and C++ programs pass.
#
#   tests/c/without_embree.sh [--long]
#
# With --long also all sums, all programs, and Rust tests of samples on meshes, which repeat what they do on this machine by
# other engines.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
cd "$root"
prefix=target/without-embree/prefix

few=(--skip has_the_sums_of_the_file) brief=(--brief)
[ "${1:-}" != --long ] || few=() brief=()
cargo test --quiet --locked --package azulejo-conformance --no-default-features --test sums -- "${few[@]}"
[ "${1:-}" != --long ] ||
    cargo test --quiet --locked --package azulejo --no-default-features --test all -- psp:: given::
# Cargo finds what the tests have compiled.
mkdir -p target/without-embree
ln -sfn "$root/target" target/without-embree/cargo
cmake -S . -B target/without-embree -D AZULEJO_EMBREE=OFF -D AZULEJO_CARGO_PROFILE=dev \
    -D AZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" >/dev/null
cmake --build target/without-embree
cmake --install target/without-embree --prefix "$prefix" >/dev/null
library=$(find "$prefix" -name libazulejo.so)
if readelf --dynamic "$library" | grep -i 'NEEDED.*embree'; then
    echo "without_embree.sh: $library asks for Embree" >&2
    exit 1
fi
# What takes long and does not ask for Embree ran before.
AZULEJO_ROUNDS=10 tests/c/run.sh "$prefix" "${brief[@]}"
