#!/usr/bin/env bash
# Every check of the project, from a fresh machine.
#
#   scripts/test.sh [--no-debian13]
#
# --no-debian13 leaves out the run against Embree 4.3 in a Debian 13 root, and the clean roots in which the Debian packages
# are installed, for people without root.
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

# The cases of the property tests: what fails is due to what has changed.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-1}

stage() { printf '\n== %s (after %d s, %s free)\n' "$*" "$SECONDS" "$(df -h --output=avail . | tr -d ' \n' | sed 's/^Avail//')"; }

stage "What is missing"
scripts/setup.sh --tests

stage "Format, lints, documentation"
cargo fmt --all --check
cargo clippy --quiet --locked --workspace --all-targets -- -D warnings
scripts/docs.sh

stage "Rust tests on this machine's Embree"
cargo test --locked --workspace

stage "Package: install, find_package, pkg-config, add_subdirectory, shared and static, MPI ranks"
tests/c/package.sh --keep target/package

stage "README and guides: their programs and commands"
tests/c/pages.sh target/package/prefix README.md docs/integrating.md docs/porting.md

stage "C and C++ programs: plain, under sanitizers, under valgrind"
tests/c/run.sh target/package/prefix --asan --valgrind

stage "C and C++ programs with sanitizers in Rust, too; the C border under Miri: beside each other"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. tests/c/beside.sh
# Miri takes longest, on one core.
beside scripts/miri.sh
beside tests/c/sanitized.sh address
beside tests/c/sanitized.sh thread
all_done

stage "Fuzzing, a minute for each target"
scripts/fuzz.sh

stage "Debian packages: what they hold and depend on"
tests/c/debs.sh target/package

release=$(. /etc/os-release && echo "$ID ${VERSION_ID:-}")
if [ $debian13 = no ]; then
    stage "SKIPPED by --no-debian13: Debian packages installed in a clean root"
elif [ "$release" = "debian 12" ] || [ "$release" = "debian 13" ]; then
    stage "Debian packages: installed, used and removed in a clean root of $release"
    scripts/clean-root.sh "${release#debian }" target/package/debs tests/c/installed.sh
else
    stage "SKIPPED on $release: Debian packages installed in a clean root"
fi

if [ $debian13 = yes ]; then
    stage "Rust tests, package, C and C++ programs on Embree 4.3, in a Debian 13 root"
    scripts/debian13.sh bash -ec '
        cargo test --offline --locked --workspace
        tests/c/package.sh --keep /var/cache/package
        tests/c/run.sh /var/cache/package/prefix
        tests/c/debs.sh /var/cache/package'

    stage "Debian packages: installed, used and removed in a clean Debian 13 root"
    scripts/clean-root.sh 13 "${AZULEJO_DEBIAN13_DIR:-target/debian13}/root/var/cache/package/debs" tests/c/installed.sh
else
    stage "SKIPPED by --no-debian13: everything on Embree 4.3"
fi

stage "All checks passed"
