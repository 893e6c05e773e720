//! Memory that JavaScript writes arguments to.

use std::alloc::{Layout, alloc, dealloc};

/// Numbers are aligned to their size, of 8 bytes at most.
fn layout(bytes: usize) -> Option<Layout> {
    Layout::from_size_align(bytes.max(8), 8).ok()
}

/// Allocates this many bytes, which the caller has to free; null if the allocation fails.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_take(bytes: usize) -> *mut u8 {
    // SAFETY: the layout is not empty.
    layout(bytes).map_or(std::ptr::null_mut(), |layout| unsafe { alloc(layout) })
}

/// Frees allocated memory.
///
/// # Safety
/// `pointer` is from [`azulejo_take`] with as many bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_give_back(pointer: *mut u8, bytes: usize) {
    if let Some(layout) = layout(bytes)
        && !pointer.is_null()
    {
        // SAFETY: allocated with this layout, which the caller guarantees.
        unsafe { dealloc(pointer, layout) }
    }
}

/// The rows of an argument.
///
/// # Safety
/// Unless `count` is 0, `pointer` is valid for reads of `count` rows, which do not change during `'a`.
pub(crate) unsafe fn rows<'a, T>(pointer: *const T, count: usize) -> &'a [T] {
    // SAFETY: guaranteed by the caller.
    if count == 0 { &[] } else { unsafe { std::slice::from_raw_parts(pointer, count) } }
}

/// The rows of an argument that may be left out, and then is null.
///
/// # Safety
/// As [`rows`], or null.
pub(crate) unsafe fn optional<'a, T>(pointer: *const T, count: usize) -> Option<&'a [T]> {
    // SAFETY: guaranteed by the caller.
    (!pointer.is_null()).then(|| unsafe { rows(pointer, count) })
}
