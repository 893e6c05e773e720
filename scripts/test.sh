#!/usr/bin/env bash
# Every check of the project, from a fresh machine.
#
#   scripts/test.sh [--no-debian13]
#
# --no-debian13 leaves out the run against Embree 4.3 in a Debian 13 root, for people without root.
set -euo pipefail
cd "$(dirname "$0")/.."

debian13=yes
for argument; do
    case $argument in
        --no-debian13) debian13=no ;;
        *)
            sed -n '4s/^# *//p' "$0" >&2
            exit 2
            ;;
    esac
done

stage() { printf '\n== %s (after %d s)\n' "$*" "$SECONDS"; }

stage "What is missing"
scripts/setup.sh --tests

stage "Format, lints, documentation"
cargo fmt --all --check
cargo clippy --quiet --locked --workspace --all-targets -- -D warnings
RUSTDOCFLAGS='-D warnings' cargo doc --quiet --locked --workspace --no-deps

stage "Rust tests on this machine's Embree"
cargo test --locked --workspace

stage "Package: install, find_package, pkg-config, add_subdirectory, shared and static"
tests/c/package.sh --keep target/package

stage "README: its C and C++ programs"
tests/c/readme.sh target/package/prefix

stage "C and C++ programs: plain, under sanitizers, under valgrind"
tests/c/run.sh target/package/prefix --asan --valgrind

if [ $debian13 = yes ]; then
    stage "Rust tests, package, C and C++ programs on Embree 4.3, in a Debian 13 root"
    scripts/debian13.sh bash -ec '
        cargo test --offline --locked --workspace
        tests/c/package.sh --keep /var/cache/package
        tests/c/run.sh /var/cache/package/prefix'
else
    stage "SKIPPED by --no-debian13: everything on Embree 4.3"
fi

stage "All checks passed"
