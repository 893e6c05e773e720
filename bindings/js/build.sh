#!/usr/bin/env bash
# Builds azulejo.wasm, which belongs to the package.
set -euo pipefail
cd "$(dirname "$0")"

rustup target list --installed | grep -qx wasm32-unknown-unknown || rustup target add wasm32-unknown-unknown
cargo build --quiet --locked --release --target wasm32-unknown-unknown \
    --target-dir target --workspace
cp target/wasm32-unknown-unknown/release/azulejo_js.wasm azulejo.wasm
cp target/wasm32-unknown-unknown/release/azulejo_js_sums.wasm target/sums.wasm
echo "azulejo.wasm: $(stat -c %s azulejo.wasm) bytes, $(gzip -9 -c azulejo.wasm | wc -c) with gzip"
