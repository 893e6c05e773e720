#!/usr/bin/env bash
# Tests the project, from a fresh machine.
#
#   scripts/test.sh          what a change must pass on its author's machine: format, lints, Rust tests, the C
#                            package, C and C++ programs, the code in README and guides
#   scripts/test.sh --all    what a change must pass to land (.ci/run): also documentation, AddressSanitizer, fuzzing,
#                            Python, JavaScript, the links of the site, packages in a clean root of this release
#   scripts/test.sh --long   once a week: also the library as it is released, Rust tests of the studies, other Embrees,
#                            processors and systems, a library without Embree, valgrind, Miri, ThreadSanitizer, WebAssembly
#                            with threads, the site in a browser, fresh seeds for the property tests, a minute of fuzzing
#                            for each target, guarantees that are broken to see a test fail
#
# The first needs root only for packages that are missing (scripts/setup.sh lists them), the others for their Debian roots.
# What fails often comes first: every workspace and program is compiled before any long stage. The last lines list the cost
# of each stage, and what was left out; target/checked says which commit passed which stages.
set -euo pipefail
cd "$(dirname "$0")/.."

extent=quick
case ${1:-} in
    "") ;;
    --all | --long) extent=${1#--} ;;
    *)
        sed -n '/^#   /s/^# *//p' "$0" >&2
        exit 2
        ;;
esac
is_quick() { [ $extent = quick ]; }
is_long() { [ $extent = long ]; }
# A word of the command line of a stage that has more to do in a long run.
if_long() { ! is_long || echo --long; }

# The cases of the property tests: what fails is due to what has changed.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-1}
package=target/package
# The C library of a run that is not long is that of the profile dev, compiled together with packages whose tests have run:
# with the same features, so that cargo finds its work done.
is_long || export AZULEJO_CARGO_FLAGS="--locked;--package;azulejo;--package;azulejo-cli"
release=$(. /etc/os-release && echo "$ID ${VERSION_ID:-}")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. scripts/stages.sh

# Packages are installed in a clean root of this release.
has_clean_root() { [[ $release =~ ^debian\ 1[23]$ ]]; }

# The fuzz targets, the tests for Miri and the bindings have workspaces of their own, and are built by other stages much later.
lints() {
    local manifest manifests=(Cargo.toml fuzz/Cargo.toml)
    is_quick || manifests+=(bindings/python/Cargo.toml bindings/js/Cargo.toml)
    for manifest in "${manifests[@]}"; do
        cargo fmt --manifest-path "$manifest" --all --check
    done
    for manifest in "${manifests[@]}"; do
        cargo clippy --quiet --locked --manifest-path "$manifest" --workspace --all-targets --target-dir target -- -D warnings
    done
}

# Of the C and C++ programs, which are compiled and run much later.
syntax() {
    local source strict
    for source in tests/c/*.c tests/c/*.cpp examples_c/*.c examples_c/*.cpp; do
        case $source in
            examples_c/ranks.c | tests/c/host.c) continue ;; # They need more headers than those of the project.
            *.c) strict=(cc -std=gnu11 -Wstrict-prototypes) ;;
            *) strict=(c++ -std=c++17) ;;
        esac
        "${strict[@]}" -Wall -Wextra -Wpedantic -Werror -Iinclude -DEMBREE_MAJOR=3 -fsyntax-only "$source"
    done
}

# Names of files of tests/all become beginnings of names of tests.
as_modules() { xargs basename -s .rs | sed 's/$/::/'; }

# Runs the files that have property tests; scripts/test.sh with the same PROPTEST_RNG_SEED repeats a failure.
fresh_seeds() {
    local round modules
    mapfile -t modules < <(grep -l 'proptest!' tests/all/*.rs | as_modules)
    for round in 1 2 3 4 5; do
        PROPTEST_RNG_SEED=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
        echo "PROPTEST_RNG_SEED=$PROPTEST_RNG_SEED"
        cargo test --quiet --locked --package azulejo --lib
        cargo test --quiet --locked --package azulejo --test all -- "${modules[@]}"
    done
}

# Studies and benchmarks compile the library with features of its own, once more: their tests are for a long run.
rust_tests() {
    local others=(--exclude azulejo-studies --exclude azulejo-benches)
    ! is_long || others=()
    cargo test --locked --workspace "${others[@]}"
}

debian_roots() {
    ! is_long || scripts/debian13.sh true
    ! has_clean_root || scripts/clean-root.sh "${release#debian }" scripts true
}

sanitized_address() {
    is_long || export AZULEJO_COVERAGE=functions
    scripts/fuzz.sh $(is_long || echo --brief)
    tests/c/sanitized.sh address
}

# Packages of the registry that the same compiler has compiled are taken over, so that the library is of the profile dev.
on_debian13() {
    scripts/debian13.sh bash -ec '
        scripts/share-packages.sh target/debug /var/cache/package/build/cargo/debug
        tests/c/package.sh --brief --dev --keep /var/cache/package
        cargo test --offline --locked --target-dir /var/cache/package/build/cargo --package azulejo-conformance \
            --package azulejo-embree-sys
        AZULEJO_ROUNDS=10 tests/c/run.sh /var/cache/package/prefix
        tests/c/debs.sh --dev /var/cache/package
        scripts/share-packages.sh target/debug /var/cache/azulejo/debug
        cargo test --offline --locked --workspace'
}

# Stages that wait for the network or use one core, then those in the Debian 13 root, which take over what was compiled.
lane() {
    stage "Debian roots" debian_roots
    stage "Fuzzing; C and C++ programs with AddressSanitizer in Rust, too" sanitized_address
    ! is_long || slow_lane
}

slow_lane() {
    stage "FFI boundary under Miri" scripts/miri.sh
    stage "C programs with ThreadSanitizer in Rust, too" tests/c/sanitized.sh thread
    stage "arm64 and Windows" scripts/platforms.sh arm64 windows
    until [ -e "$work/packaged" ]; do sleep 1; done
    stage "Rust tests, package, C and C++ programs on Embree 4.3, in a Debian 13 root" on_debian13
    stage "Debian packages: installed, used and removed in a clean Debian 13 root" scripts/clean-root.sh 13 \
        "${AZULEJO_DEBIAN13_DIR:-target/debian13}/root/var/cache/package/debs" tests/c/installed.sh
}

early_stages() {
    stage "Format and lints" lints
    stage "C and C++ programs compile" syntax
}

quick_stages() {
    stage "What is missing" scripts/setup.sh --tests
    early_stages
    stage "Rust tests" rust_tests
    stage "Package: install, find_package, pkg-config" tests/c/package.sh --quick --keep target/quick
    stage "README and guides: their programs and commands" \
        tests/c/pages.sh target/quick/prefix README.md docs/integrating.md docs/porting.md
    stage "C and C++ programs" env AZULEJO_ROUNDS=10 tests/c/run.sh target/quick/prefix
    leave_out "what scripts/test.sh --all adds"
}

all_stages() {
    stage "What is missing" scripts/setup.sh "$(is_long && echo --long || echo --all)"
    [ "$(id -u)" = 0 ] || sudo -v
    behind lane
    early_stages
    stage "Documentation" scripts/docs.sh
    stage "Rust tests on this machine's Embree" rust_tests
    stage "Package: install, find_package, pkg-config, add_subdirectory, shared and static, MPI ranks" \
        tests/c/package.sh $(is_long || echo --dev --share) --keep $package
    touch "$work/packaged"
    stage "README and guides: their programs and commands" \
        tests/c/pages.sh $package/prefix README.md docs/integrating.md docs/porting.md
    if is_long; then
        stage "C and C++ programs: plain, under valgrind" tests/c/run.sh $package/prefix --valgrind
        stage "Without Embree: sums, meshes, C and C++ programs on nothing but libc" tests/c/without_embree.sh
        stage "Sums on other levels of x86" scripts/platforms.sh x86-levels
    else
        stage "C and C++ programs" env AZULEJO_ROUNDS=10 tests/c/run.sh $package/prefix
    fi
    stage "Python: a wheel, installed and tested in a clean environment" bindings/python/test.sh $(if_long)
    stage "Packages of crates, recipes for vcpkg, conan and conda, workflows" packaging/test.sh $(if_long)
    stage "JavaScript: WebAssembly in Node and in headless Chromium" bindings/js/test.sh $(if_long)
    stage "Blender extension: its manifest, and that its files compile" integrations/blender/test.sh --brief
    stage "Scenes in USD and glTF, by the validators of these formats" integrations/formats/test.sh
    stage "Site: links and programs of the playground" site/test.sh $(if_long)
    stage "Debian packages: what they hold and depend on" tests/c/debs.sh $(is_long || echo --dev) $package
    if has_clean_root; then
        stage "Debian packages: installed, used and removed in a clean root of $release" \
            scripts/clean-root.sh "${release#debian }" $package/debs tests/c/installed.sh
    else
        leave_out "Debian packages installed in a clean root of $release"
    fi
    if is_long; then
        stage "Property tests with fresh seeds" fresh_seeds
        stage "Ten thousand relaxed sets" cargo test --locked --package azulejo --test all -- --ignored dcr_converged::
        stage "Ten million rays by every engine" cargo test --locked --package azulejo --lib -- --ignored engines::ten_million
        stage "Blender extension, installed in Blender as a Python module" integrations/blender/test.sh
        stage "Examples with trimesh, Open3D, PyVista, Mitsuba and three.js" integrations/examples/test.sh
        stage "Broken guarantees are noticed" scripts/mutate.sh
    else
        leave_out "what scripts/test.sh --long adds"
    fi
    lane_ended
}

if is_quick; then quick_stages; else all_stages; fi
summary
