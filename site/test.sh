#!/usr/bin/env bash
# The site: built, its links, the programs that the playground offers, and its pages in headless Chromium; their pictures are in
# target/site-pictures. Takes bindings/js/azulejo.wasm if it is there.
set -euo pipefail
cd "$(dirname "$0")/.."

site/build.sh --built
node site/test/links.js target/site

code=target/site-code
rm -rf $code
mkdir -p $code/rust/src/bin
node site/test/code.js $code include
cp $code/*.rs $code/rust/src/bin
cp Cargo.lock $code/rust
cat >$code/rust/Cargo.toml <<'TOML'
[package]
name = "programs-of-the-site"
version = "0.0.0"
edition = "2024"

[dependencies]
azulejo = { path = "../../..", default-features = false }

[workspace]
TOML
cargo check --quiet --offline --manifest-path $code/rust/Cargo.toml --target-dir target/site-check

if command -v chromium >/dev/null; then
    node site/test/site.js target/site target/site-pictures
else
    echo "SKIPPED: the site in a browser (no chromium)"
fi
