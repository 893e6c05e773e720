//! include/azulejo.h is what cbindgen makes of this crate, byte for byte. `AZULEJO_BLESS=1` writes it.

use std::{env, fs, path::Path};

/// As wide as a line of the header may be.
const COLUMNS: usize = 100;

#[test]
fn the_committed_header_is_the_generated_one() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    config.header = Some(preamble(&fs::read_to_string(root.join("src/lib.rs")).unwrap()));

    let mut generated = Vec::new();
    cbindgen::generate_with_config(root, config).unwrap().write(&mut generated);
    let generated = String::from_utf8(generated).unwrap();

    let is_too_long = |line: &&str| line.chars().count() > COLUMNS;
    assert_eq!(generated.lines().find(is_too_long), None, "a line of the header is longer than {COLUMNS} columns");

    let path = root.join("../../include/azulejo.h");
    if env::var_os("AZULEJO_BLESS").is_some() {
        fs::write(&path, &generated).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    let same = committed.lines().zip(generated.lines()).take_while(|(old, new)| old == new).count();
    assert!(committed == generated, "{} differs from line {}; AZULEJO_BLESS=1 rewrites it", path.display(), same + 1);
}

/// The `//!` page at the top of a source file as a C comment.
fn preamble(source: &str) -> String {
    let page = source.lines().map_while(|line| line.strip_prefix("//!"));
    let lines: String = page.map(|line| format!(" *{line}\n")).collect();
    format!("/*\n{lines} */")
}
