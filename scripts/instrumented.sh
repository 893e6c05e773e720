# Sourced by scripts/fuzz.sh and tests/c/sanitized.sh: cargo for the workspace of fuzz/ with AddressSanitizer, in one way
# for both, so that the library is compiled once. What libFuzzer needs on top does no harm to other programs: the
# sanitizer's runtime takes its calls. Needs a nightly compiler.
host=$(rustc +nightly -vV | sed -n 's/^host: //p')
instrumented=$root/target/fuzz/$host/release

# COMMAND ARGUMENT...: a target is named, so that build scripts go without.
cargo_instrumented() {
    (cd "$root" && CARGO_INCREMENTAL=0 RUSTFLAGS="-Zsanitizer=address -Ccodegen-units=1 -Cpasses=sancov-module
        -Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-trace-compares
        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table" \
        cargo +nightly "$1" --quiet --locked --release --manifest-path fuzz/Cargo.toml --target "$host" \
        --target-dir target/fuzz "${@:2}")
}
