# Sourced by scripts/fuzz.sh and tests/c/sanitized.sh: builds the workspace of fuzz/ with AddressSanitizer and with the
# coverage counters of libFuzzer, so that both scripts share one compiled library. Programs without libFuzzer can link
# it: the sanitizer's runtime defines what the counters call. Needs a nightly compiler.
#
# Inputs are mutated by the edges and comparisons that they reach; with AZULEJO_COVERAGE=functions by functions alone, which
# takes the compiler less time, and does for so few inputs as those of a brief run.
host=$(rustc +nightly -vV | sed -n 's/^host: //p')
instrumented=$root/target/fuzz/$host/release
coverage="-Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-trace-compares"
[ "${AZULEJO_COVERAGE:-}" != functions ] || coverage=-Cllvm-args=-sanitizer-coverage-level=1

# COMMAND ARGUMENT...: the target is named so that the flags do not apply to build scripts.
cargo_instrumented() {
    (cd "$root" && CARGO_INCREMENTAL=0 RUSTFLAGS="-Zsanitizer=address -Ccodegen-units=1 -Cpasses=sancov-module
        $coverage -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table" \
        cargo +nightly "$1" --quiet --locked --release --manifest-path fuzz/Cargo.toml --target "$host" \
        --target-dir target/fuzz "${@:2}")
}
