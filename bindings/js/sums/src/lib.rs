//! The sums of `tests/sums.txt` and `tests/few_sums.txt`, taken on WebAssembly by the same cases, for `test/sums.test.js`.

use std::sync::OnceLock;

#[path = "../../../../tests/sums/all.rs"]
mod all;
#[path = "../../src/threads.rs"]
mod threads;

/// The lines of one of the two files, or the text of an error; made once.
fn text(few: bool) -> &'static str {
    static TEXTS: [OnceLock<String>; 2] = [OnceLock::new(), OnceLock::new()];
    let take = if few { all::few_sums } else { all::sums };
    let sums = || take(&*threads::context()?);
    TEXTS[usize::from(few)].get_or_init(|| sums().map_or_else(|error| error.to_string(), |list| list.to_string()))
}

/// The address of the text.
#[unsafe(no_mangle)]
pub extern "C" fn sums_text(few: bool) -> *const u8 {
    text(few).as_ptr()
}

/// The number of its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn sums_bytes(few: bool) -> usize {
    text(few).len()
}
