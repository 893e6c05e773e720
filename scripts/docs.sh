#!/usr/bin/env bash
# Builds the reference of the crate (target/doc/azulejo) and of the C interface (target/doc/c), without a warning: each
# public item has a text. Needs what setup.sh --all installs.
set -euo pipefail
cd "$(dirname "$0")/.."

RUSTDOCFLAGS='-D warnings' cargo doc --quiet --locked --workspace --no-deps
doxygen docs/Doxyfile
