//! SHA-256 sums of what calls return: the same bytes for any number of threads and on every processor and system, since
//! `tests/sums.txt` was written. Only hits of Embree on global projectors are left out.
//!
//! Most calls are those of a grid: each sampler by all that can be asked of it, on small sets, whose sums are in
//! `tests/few_sums.txt` and which WebAssembly makes in seconds (`bindings/js/test.sh`), and on large ones. The
//! others are of domains, meshes and options that stand for themselves.
//!
//! A change that is not meant to alter a set leaves the files as they are. One that does writes them anew, and says so in the
//! changelog: `AZULEJO_BLESS=1 cargo test --release -p azulejo-conformance --test sums`.

use azulejo::{Context, Result};
use azulejo_sums::list::List;
use azulejo_sums::{few_sums, sums};

/// Compares sums with those of a file, or writes them to it.
fn check(file: &str, expected: &str, sums: Result<List>) {
    let sums = sums.unwrap().to_string();
    if std::env::var_os("AZULEJO_BLESS").is_some() {
        std::fs::write(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(file), &sums).unwrap();
        return;
    }
    let differ: Vec<_> = expected.lines().zip(sums.lines()).filter(|(a, b)| a != b).collect();
    assert!(differ.is_empty(), "expected and found: {differ:#?}");
    assert_eq!(expected.lines().count(), sums.lines().count());
}

#[test]
fn what_calls_return_has_the_sums_of_the_file() {
    check("sums.txt", include_str!("sums.txt"), sums(&Context::new(0).unwrap()));
}

#[test]
fn what_calls_return_for_small_sets_has_the_sums_of_its_file() {
    check("few_sums.txt", include_str!("few_sums.txt"), few_sums(&Context::new(0).unwrap()));
}
