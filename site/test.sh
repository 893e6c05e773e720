#!/usr/bin/env bash
# The site: built, its links, and the programs that the playground offers. Takes bindings/js/azulejo.wasm if it is there.
#
#   site/test.sh [--long]
#
# With --long also its pages in headless Chromium, on threads if azulejo-threads.wasm is there; their pictures are in
# target/site-pictures.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-} in
    "" | --long) ;;
    *)
        sed -n '/^#   /s/^# *//p' "$0" >&2
        exit 2
        ;;
esac

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

if [ "${1:-}" != --long ]; then
    echo "SKIPPED: the site in a browser (--long)"
elif command -v chromium >/dev/null; then
    node site/test/site.js target/site target/site-pictures
else
    echo "SKIPPED: the site in a browser (no chromium)"
fi
