#!/usr/bin/env bash
# Fuzzes the C ABI and the analysis with libFuzzer and AddressSanitizer.
#
#   scripts/fuzz.sh [--seconds N | --brief] [--seed S] [TARGET...]
#
# Each target of fuzz/fuzz_targets, or those named, runs for N seconds (60), as many at a time as there are cores, or with
# --brief for about five, but by a number of inputs: the same ones on any machine, so that a failure is due to what has
# changed. The seed is 1; 0 takes a random one. Inputs that fail are kept in
# target/fuzz/artifacts, and `scripts/fuzz.sh TARGET FILE` runs one of them again. A target that runs too few inputs for ten
# seconds or more fails, since it has looked at nothing. Before that the checkers are tested: each notices a sample that is
# missing or moved. Needs a nightly compiler; without one nothing is done, which is said.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

if ! rustc +nightly --version >/dev/null 2>&1; then
    echo "SKIPPED: fuzzing, since there is no nightly compiler here"
    exit 0
fi

seconds=60
export seed=1
targets=()
file=
while [ $# -gt 0 ]; do
    case $1 in
        --seconds)
            seconds=${2:?--seconds needs a number}
            shift
            ;;
        --brief) seconds=0 ;;
        --seed)
            seed=${2:?--seed needs a number}
            shift
            ;;
        *) if [ -f "$1" ]; then file=$1; else targets+=("$1"); fi ;;
    esac
    shift
done
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(basename -s .rs fuzz/fuzz_targets/*.rs)

. scripts/instrumented.sh
mapfile -t binaries < <(printf -- '--bin\n%s\n' "${targets[@]}")
cargo_instrumented build "${binaries[@]}"
cargo_instrumented test --lib
programs=$instrumented

# The fewest inputs that a run of so many seconds may have: about a tenth to a quarter of what two
# idle cores reach, since other stages run beside it.
fewest() { # TARGET SECONDS
    case $1 in
        mesh | kinds) echo $(($2 / 2)) ;;
        analysis | density | edits | measure | relax | volume) echo $((25 * $2 / 10)) ;;
        *) echo $((300 * $2 / 10)) ;;
    esac
}

# The inputs of a brief run.
brief() { # TARGET
    case $1 in
        kinds) echo 30 ;;
        density | measure) echo 50 ;;
        relax | volume) echo 100 ;;
        analysis | edits | mesh) echo 200 ;;
        mask | stl) echo 1000 ;;
        *) echo 2000 ;;
    esac
}

# A target in a corpus of its own, begun with the seeds; says how many inputs it ran.
fuzz() {
    local work=target/fuzz/corpus/$1 log=target/fuzz/$1.log until=-max_total_time=$2 runs
    if [ "$2" = 0 ]; then
        work=target/fuzz/brief/$1
        rm -rf "$work"
        until=-runs=$(brief "$1")
    fi
    mkdir -p "$work" target/fuzz/artifacts
    if "$programs/$1" "$work" fuzz/corpus/"$1" "$until" -seed="$seed" -timeout=600 -rss_limit_mb=3000 -max_len=4096 \
        -artifact_prefix="target/fuzz/artifacts/$1-" >"$log" 2>&1; then
        printf '%-10s %s\n' "$1" "$(tail -n 1 "$log")"
        runs=$(sed -n 's/^Done \([0-9]*\) runs .*/\1/p' "$log")
        [ "$2" -lt 10 ] || [ "${runs:-0}" -ge "$(fewest "$1" "$2")" ] || {
            printf '%-10s FAILED: %s inputs, %s are the fewest\n' "$1" "${runs:-no}" "$(fewest "$1" "$2")"
            return 1
        }
    else
        printf '%-10s FAILED\n' "$1"
        { grep -m 1 -A 2 panicked "$log" || true; tail -n 60 "$log"; } | cut -c -1000 | sed 's/^/    /'
        return 1
    fi
}
export -f fuzz fewest brief
export programs

if [ -n "$file" ]; then
    exec "$programs/${targets[0]}" "$file"
fi
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c "fuzz {} $seconds"
