#!/usr/bin/env bash
# Tests a library that is built without Embree: it needs nothing but the C runtime, it has the sums of tests/sums.txt, and
# Rust tests of samples on meshes, which repeat what they do elsewhere by other engines, and C and C++ programs pass.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
cd "$root"
prefix=target/without-embree/prefix

cargo test --quiet --locked --package azulejo-conformance --no-default-features --test sums
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
AZULEJO_ROUNDS=10 tests/c/run.sh "$prefix"
