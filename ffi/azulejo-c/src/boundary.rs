//! The FFI boundary: every entry point goes through [`call`] or a function built on it.

use std::any::Any;
use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::status::{AZULEJO_ERROR_INTERNAL, AZULEJO_OK, Failure, azulejo_status};

/// Runs `body`; turns its failure or panic into a status and the thread's last error. Nothing unwinds out of it.
pub(crate) fn call(body: impl FnOnce() -> Result<(), Failure>) -> azulejo_status {
    // Unwind safety: what a panic may leave half done is a handle behind a lock, which the panic poisons.
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => AZULEJO_OK,
        Ok(Err(failure)) => failure.record(),
        Err(payload) => Failure::new(AZULEJO_ERROR_INTERNAL, describe(&*payload)).record(),
    }
}

/// The place of a result, named by the caller. It is written once, when the call has succeeded.
pub(crate) struct Out<T>(*mut T);

impl<T> Out<T> {
    /// The caller's pointer, which is checked before any work begins.
    ///
    /// # Safety
    /// Unless it is NULL or misaligned, `pointer` leads to memory for a `T`, which nothing else uses during the call.
    pub(crate) unsafe fn new(pointer: *mut T) -> Self {
        Self(pointer)
    }

    /// The caller's pointer, or none for NULL; refused if it is misaligned.
    ///
    /// # Safety
    /// As [`Out::new`].
    pub(crate) unsafe fn optional(argument: &str, pointer: *mut T) -> Result<Option<Self>, Failure> {
        if pointer.is_null() {
            return Ok(None);
        }
        let out = Self(pointer);
        out.check(argument).map(|()| Some(out))
    }

    /// Refuses a pointer to which nothing can be written.
    pub(crate) fn check(&self, argument: &str) -> Result<(), Failure> {
        check_pointer(argument, self.0)
    }

    /// Writes to a pointer that passed the check.
    pub(crate) fn write(self, value: T) {
        debug_assert!(!self.0.is_null() && self.0.is_aligned());
        // SAFETY: memory for a `T` by the promise of `new`, and checked as far as that is possible.
        unsafe { self.0.write(value) };
    }
}

/// [`call`] for a `body` that has one result.
pub(crate) fn answer<T>(out: Out<T>, body: impl FnOnce() -> Result<T, Failure>) -> azulejo_status {
    call(|| {
        out.check("out")?;
        out.write(body()?);
        Ok(())
    })
}

fn describe(payload: &(dyn Any + Send)) -> String {
    let message = payload.downcast_ref::<&str>().copied();
    let message = message.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    format!("internal error, please report it: {}", message.unwrap_or("a panic without a message"))
}

/// The referent of a pointer that must not be NULL.
pub(crate) fn required<T>(argument: &str, pointer: Option<T>) -> Result<T, Failure> {
    pointer.ok_or_else(|| Failure::invalid(argument, "is NULL"))
}

/// Refuses what a reference could not be made of.
pub(crate) fn check_pointer<T>(argument: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        Err(Failure::invalid(argument, "is NULL"))
    } else if !pointer.is_aligned() {
        Err(Failure::invalid(argument, format!("{pointer:p} is not aligned to {} bytes", align_of::<T>())))
    } else {
        Ok(())
    }
}

/// `bytes`, the size of an array if it did not overflow, must be a size that an object can have.
pub(crate) fn check_size(argument: &str, count: usize, bytes: Option<usize>) -> Result<usize, Failure> {
    let fits = |&bytes: &usize| bytes <= isize::MAX as usize;
    bytes.filter(fits).ok_or_else(|| Failure::too_large(argument, format!("{count} elements exceed the address space")))
}

/// The caller's array of `count` rows of `N` numbers; NULL only if it is empty.
///
/// # Safety
/// Unless the checks fail, `rows` leads to `count` rows that are not changed during `'a`.
pub(crate) unsafe fn rows<'a, T, const N: usize>(
    argument: &str,
    rows: *const T,
    count_argument: &str,
    count: usize,
) -> Result<&'a [[T; N]], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check_pointer(argument, rows)?;
    check_size(count_argument, count, count.checked_mul(size_of::<[T; N]>()))?;
    // SAFETY: not NULL, aligned, of a possible size; the rest is the caller's word.
    Ok(unsafe { std::slice::from_raw_parts(rows.cast(), count) })
}

/// Writes a result into the caller's array, which was checked before work began.
///
/// # Safety
/// `out` leads to at least as many elements as there are values.
pub(crate) unsafe fn write<T: Copy>(out: *mut T, values: &[T]) {
    // SAFETY: the caller's word; the library's own arrays do not overlap the caller's.
    unsafe { out.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
}

/// The pair of numbers at `pointer`.
///
/// # Safety
/// Unless the checks fail, `pointer` leads to two numbers.
pub(crate) unsafe fn pair(argument: &str, pointer: *const f64) -> Result<[f64; 2], Failure> {
    check_pointer(argument, pointer)?;
    // SAFETY: not NULL and aligned; the rest is the caller's word.
    Ok(unsafe { pointer.cast::<[f64; 2]>().read() })
}

/// Refuses a field that later versions may use.
pub(crate) fn check_reserved(reserved: u32) -> Result<(), Failure> {
    if reserved == 0 { Ok(()) } else { Err(Failure::invalid("reserved", format!("{reserved} is not 0"))) }
}

/// Refuses a field that has no effect in this call, unless it has its default.
pub(crate) fn check_unused<T: PartialEq + Debug>(field: &str, value: T, default: T, call: &str) -> Result<(), Failure> {
    if value == default {
        return Ok(());
    }
    Err(Failure::invalid(field, format!("{value:?} has no effect {call}; leave the default, {default:?}")))
}

/// A flag of the caller, 0 or 1.
pub(crate) fn flag(argument: &str, value: u32) -> Result<bool, Failure> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Failure::invalid(argument, format!("{other} is neither 0 nor 1"))),
    }
}

/// The pointer to an array of the library's for C: NULL if it is empty.
pub(crate) fn array<T, U>(rows: &[T]) -> *const U {
    if rows.is_empty() { std::ptr::null() } else { rows.as_ptr().cast() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::status::{AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE};

    #[test]
    fn a_panic_becomes_a_status() {
        assert_eq!(call(|| panic!("on purpose")), AZULEJO_ERROR_INTERNAL);
        assert_eq!(call(|| panic!("on purpose: {}", 1)), AZULEJO_ERROR_INTERNAL);
        assert_eq!(call(|| std::panic::panic_any(7)), AZULEJO_ERROR_INTERNAL);
    }

    #[test]
    fn an_output_is_written_on_success_only() {
        let mut memory = [1u64; 2];
        let start = memory.as_mut_ptr();
        // SAFETY: NULL, misaligned, or memory for a number.
        let out = |pointer: *mut u64| unsafe { Out::new(pointer) };
        assert_eq!(answer(out(start), || Err(Failure::invalid("x", "y"))), AZULEJO_ERROR_INVALID_ARGUMENT);
        for bad in [std::ptr::null_mut(), start.wrapping_byte_add(1), start.wrapping_byte_add(4)] {
            assert_eq!(answer(out(bad), || panic!("no work before the checks")), AZULEJO_ERROR_INVALID_ARGUMENT);
        }
        assert_eq!(memory, [1; 2]);
        assert_eq!(answer(out(memory.as_mut_ptr()), || Ok(7)), AZULEJO_OK);
        assert_eq!(memory, [7, 1]);
    }

    #[test]
    fn arrays_are_checked_before_they_are_read() {
        let floats = [0.0f32; 6];
        let misaligned = floats.as_ptr().wrapping_byte_add(1);
        let status = |pointer, count| {
            // SAFETY: the only combination that passes the checks is the true one.
            call(|| unsafe { rows::<f32, 2>("positions", pointer, "count", count) }.map(drop))
        };
        assert_eq!(status(floats.as_ptr(), 3), AZULEJO_OK);
        assert_eq!(status(std::ptr::null(), 0), AZULEJO_OK);
        assert_eq!(status(std::ptr::null(), 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(status(misaligned, 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(status(floats.as_ptr(), usize::MAX), AZULEJO_ERROR_TOO_LARGE);
        assert_eq!(status(floats.as_ptr(), usize::MAX / 8), AZULEJO_ERROR_TOO_LARGE);
    }
}
