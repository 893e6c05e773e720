#!/usr/bin/env bash
# Every check of the project, from a fresh machine.
#
#   scripts/test.sh [--long] [--no-debian13]
#
# --long is for once a week. It adds fresh seeds for the property tests, fuzzes each target for a minute instead of ten
# seconds, breaks one guarantee at a time to see a test fail, runs all Rust tests on Embree 4.3, also those that do not call
# Embree, and on emulated processors and systems all sums and programs.
# --no-debian13 leaves out the run on Embree 4.3 in a Debian 13 root, and the clean roots in which the Debian packages are
# installed, for users without root.
# The last lines list the cost of each stage, and what was left out.
set -euo pipefail
cd "$(dirname "$0")/.."

debian13=yes long=no
for argument; do
    case $argument in
        --long) long=yes ;;
        --no-debian13) debian13=no ;;
        *)
            sed -n '4s/^# *//p' "$0" >&2
            exit 2
            ;;
    esac
done

# The cases of the property tests: what fails is due to what has changed.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-1}
package=target/package
release=$(. /etc/os-release && echo "$ID ${VERSION_ID:-}")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. scripts/stages.sh

is_long() { [ $long = yes ]; }

# Packages are installed in a clean root of this release.
has_clean_root() { [ $debian13 = yes ] && [[ $release =~ ^debian\ 1[23]$ ]]; }

# The fuzz targets and the tests for Miri have a workspace of their own, and are compiled by other stages much later.
lints() {
    local manifest
    for manifest in Cargo.toml fuzz/Cargo.toml; do
        cargo fmt --manifest-path $manifest --all --check
        cargo clippy --quiet --locked --manifest-path $manifest --workspace --all-targets --target-dir target -- -D warnings
    done
    scripts/docs.sh
}

# Names of files become arguments of cargo.
as_tests() { xargs basename -s .rs | sed 's/^/--test=/'; }

# Runs the files that have property tests; scripts/test.sh with the same PROPTEST_RNG_SEED repeats a failure.
fresh_seeds() {
    local round tests
    mapfile -t tests < <(grep -l 'proptest!' tests/*.rs | as_tests)
    for round in 1 2 3 4 5; do
        PROPTEST_RNG_SEED=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
        echo "PROPTEST_RNG_SEED=$PROPTEST_RNG_SEED"
        cargo test --quiet --locked --package azulejo --lib "${tests[@]}"
    done
}

debian_roots() {
    scripts/debian13.sh true
    ! has_clean_root || scripts/clean-root.sh "${release#debian }" scripts true
}

sanitized_address() {
    scripts/fuzz.sh --seconds "$(is_long && echo 60 || echo 10)"
    tests/c/sanitized.sh address
}

python_package() { bindings/python/test.sh $(is_long && echo --long || true); }

# Packages of the registry that the same compiler has compiled are taken over. Of the Rust tests only those run that name
# Embree, tracing or samplers of meshes, except in a long run: the others would repeat what they did on the machine.
on_debian13() {
    local what=()
    if ! is_long; then
        mapfile -t what < <(grep -lE '\b(psp|trace|embree|surface)' tests/*.rs ffi/*/tests/*.rs | as_tests)
        what+=(--lib)
    fi
    scripts/debian13.sh bash -ec '
        scripts/share-packages.sh target/debug /var/cache/azulejo/debug
        scripts/share-packages.sh target/package/build/cargo/release /var/cache/package/build/cargo/release
        cargo test --offline --locked --workspace "$@"
        tests/c/package.sh --keep /var/cache/package
        tests/c/run.sh /var/cache/package/prefix
        tests/c/debs.sh /var/cache/package' bash "${what[@]}"
}

# Stages that wait for the network or use one core, then those in the Debian 13 root, which take over what was compiled.
lane() {
    [ $debian13 = no ] || stage "Debian roots" debian_roots
    stage "FFI boundary under Miri" scripts/miri.sh
    stage "C programs with ThreadSanitizer in Rust, too" tests/c/sanitized.sh thread
    stage "arm64 and Windows" scripts/platforms.sh "${platforms_long[@]}" arm64 windows
    if [ $debian13 = yes ]; then
        until [ -e "$work/packaged" ]; do sleep 1; done
        stage "Rust tests, package, C and C++ programs on Embree 4.3, in a Debian 13 root" on_debian13
        is_long || leave_out "the Rust tests on Embree 4.3 that do not call it, and those of the command line (--long)"
        stage "Debian packages: installed, used and removed in a clean Debian 13 root" scripts/clean-root.sh 13 \
            "${AZULEJO_DEBIAN13_DIR:-target/debian13}/root/var/cache/package/debs" tests/c/installed.sh
    else
        leave_out "everything on Embree 4.3 (--no-debian13)"
    fi
}

platforms_long=()
if is_long; then
    platforms_long=(--long)
else
    leave_out "all sums, and most C and C++ programs, on other processors and systems (--long)"
fi

stage "What is missing" scripts/setup.sh "$(is_long && echo --long || echo --tests)"
[ $debian13 = no ] || [ "$(id -u)" = 0 ] || sudo -v
behind lane

stage "Format, lints, documentation" lints
stage "Rust tests on this machine's Embree" cargo test --locked --workspace
if is_long; then
    stage "Property tests with fresh seeds" fresh_seeds
    stage "Ten thousand relaxed sets" cargo test --locked --package azulejo --test dcr_converged -- --ignored
    stage "Broken guarantees are noticed" scripts/mutate.sh
else
    leave_out "fresh seeds for the property tests (--long)"
    leave_out "ten thousand relaxed sets, and guarantees that are broken to see a test fail (--long)"
fi

stage "Package: install, find_package, pkg-config, add_subdirectory, shared and static, MPI ranks" \
    tests/c/package.sh --keep $package
touch "$work/packaged"
stage "README and guides: their programs and commands" \
    tests/c/pages.sh $package/prefix README.md docs/integrating.md docs/porting.md
stage "C and C++ programs: plain, under sanitizers, under valgrind" tests/c/run.sh $package/prefix --asan --valgrind
stage "Without Embree: sums, meshes, C and C++ programs on nothing but libc" tests/c/without_embree.sh
stage "Sums on other levels of x86" scripts/platforms.sh "${platforms_long[@]}" x86-levels
stage "Fuzzing; C and C++ programs with AddressSanitizer in Rust, too" sanitized_address
is_long || leave_out "a minute of fuzzing for each target, which had ten seconds (--long)"
stage "Python: a wheel, installed and tested in a clean environment" python_package
is_long || leave_out "the Python wheels for manylinux2014 on x86-64 and arm64, and their size (--long)"
stage "Packages of crates, and recipes for vcpkg, conan and conda" packaging/test.sh

stage "JavaScript: WebAssembly in Node and in headless Chromium" bindings/js/test.sh
stage "Debian packages: what they hold and depend on" tests/c/debs.sh $package
if has_clean_root; then
    stage "Debian packages: installed, used and removed in a clean root of $release" \
        scripts/clean-root.sh "${release#debian }" $package/debs tests/c/installed.sh
else
    leave_out "Debian packages installed in a clean root of $release"
fi

lane_ended
summary
