#!/usr/bin/env bash
# Every check of the project, from a fresh machine.
#
#   scripts/test.sh [--no-debian13]
#
# --no-debian13 leaves out the run against Embree 4.3 in a Debian 13 root, which needs root and debootstrap.
set -euo pipefail
cd "$(dirname "$0")/.."

debian13=yes
for argument in "$@"; do
    case $argument in
    --no-debian13) debian13=no ;;
    *)
        echo "usage: scripts/test.sh [--no-debian13]" >&2
        exit 2
        ;;
    esac
done

stage() { printf '\n\033[1m== %s (%d s)\033[0m\n' "$*" "$SECONDS"; }

stage "Setting up"
scripts/setup.sh --tests

stage "Format, lints, documentation"
cargo fmt --all --check
cargo clippy --quiet --workspace --all-targets -- -D warnings
RUSTDOCFLAGS='-D warnings' cargo doc --quiet --workspace --no-deps

stage "Rust tests, on this machine's Embree"
cargo test --quiet --workspace

stage "Package: install, examples, find_package, pkg-config, add_subdirectory"
tests/c/package.sh build/test-prefix

stage "C and C++ programs: plain, AddressSanitizer, valgrind"
tests/c/run.sh build/test-prefix
tests/c/run.sh build/test-prefix --asan
tests/c/run.sh build/test-prefix --valgrind

if [[ $debian13 == yes ]]; then
    stage "Rust and C tests on Embree 4.3, in a Debian 13 root"
    scripts/debian13.sh
else
    stage "SKIPPED by --no-debian13: the run on Embree 4.3"
fi

stage "All checks passed"
