#!/usr/bin/env bash
# Do the tests notice? Breaks one guarantee at a time in a copy of the sources, and fails unless a named test fails.
#
#   scripts/mutate.sh [NAME...]
#
# Each file of tests/mutations is a patch. Its first line names the guarantee that it breaks, the second the
# test that must notice:
# `Must fail: --test all FILE::TEST`. What it breaks is broken only where `crate::broken("NAME")` says so: thus all patches are
# applied and compiled once, and the environment picks one of them for each run. The same tests must pass with none.
# Assertions in the sources are left out, so that it is the test that notices. A patch that no longer applies is an error:
# put the same fault into the new sources, and write `git diff -U2` over it. Builds in target/mutations.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$PWD/target/mutations
names=("$@")
[ $# -gt 0 ] || mapfile -t names < <(basename -s .patch tests/mutations/*.patch)

scripts/share-packages.sh target/debug "$work/target/debug"
rm -rf "$work/sources"
mkdir -p "$work/sources"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -p -t "$work/sources"
cd "$work/sources"
for name in tests/mutations/*.patch; do
    patch --silent --strip=1 --fuzz=0 <"$name" || {
        echo "FAILED: $name does not apply" >&2
        exit 1
    }
done
cat >>src/lib.rs <<'END'

/// Whether the environment asks for this guarantee to be broken.
pub(crate) fn broken(guarantee: &str) -> bool {
    static BROKEN: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    BROKEN.get_or_init(|| std::env::var("AZULEJO_BROKEN").unwrap_or_default()) == guarantee
}
END

# Packages of the registry stay as they were compiled.
crate=profile.dev.package.azulejo
export CARGO_TARGET_DIR=$work/target
tests() { # ARGUMENT...
    cargo test --quiet --locked --package azulejo --config "$crate.debug-assertions=false" \
        --config "$crate.overflow-checks=false" --config "$crate.opt-level=1" "$@"
}
# Before any test, whose time is limited: what is broken may never end.
tests --lib --test all --no-run
run() { # AZULEJO_BROKEN ARGUMENT...: runs a test
    (
        ulimit -t 1200
        AZULEJO_BROKEN=$1 tests "${@:2}" -- --exact
    ) >"$work/log" 2>&1
}
has_run() { grep -q '^running 1 test$' "$work/log"; }

failed=0
fault() { # NAME WHY
    printf '%-24s FAILED: %s\n' "$1" "$2"
    tail -n 20 "$work/log" | sed 's/^/    /'
    failed=1
}

declare -A passes
for name in "${names[@]}"; do
    test=$(sed -n '2s/^Must fail: //p' "tests/mutations/$name.patch")
    read -ra arguments <<<"$test"
    if [ -z "${passes[$test]:-}" ] && ! { run "" "${arguments[@]}" && has_run; }; then
        fault "$name" "$test must pass with nothing broken"
        continue
    fi
    passes[$test]=yes
    # What fails for another reason, such as a crash, is not a failure of the test.
    if run "$name" "${arguments[@]}"; then
        fault "$name" "not noticed by $test"
    elif ! grep -q '^test result: FAILED' "$work/log"; then
        fault "$name" "$test did not end"
    else
        printf '%-24s noticed by %s\n' "$name" "$test"
    fi
done
exit $failed
