//! The sums of `tests/sums.txt`, taken on WebAssembly by the same cases, for `test/sums.test.js`.

use std::sync::OnceLock;

#[path = "../../../../tests/sums/all.rs"]
mod all;
#[path = "../../src/threads.rs"]
mod threads;

/// The lines, or the text of an error; made once.
fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    let sums = || all::sums(&*threads::context()?);
    TEXT.get_or_init(|| sums().map_or_else(|error| error.to_string(), |list| list.to_string()))
}

/// The address of the text.
#[unsafe(no_mangle)]
pub extern "C" fn sums_text() -> *const u8 {
    text().as_ptr()
}

/// The number of its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn sums_bytes() -> usize {
    text().len()
}
