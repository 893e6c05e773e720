//! The FFI boundary: every entry point goes through [`call`] or a function built on it.

use std::any::Any;
use std::fmt::Debug;
use std::mem::MaybeUninit;
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

/// [`call`] for a `body` that has one result.
pub(crate) fn answer<T>(out: Option<&mut MaybeUninit<T>>, body: impl FnOnce() -> Result<T, Failure>) -> azulejo_status {
    call(|| {
        let out = required("out", out)?;
        out.write(body()?);
        Ok(())
    })
}

/// [`answer`] for a `body` that makes a handle.
pub(crate) fn create<T>(
    out: Option<&mut MaybeUninit<Box<T>>>,
    body: impl FnOnce() -> Result<T, Failure>,
) -> azulejo_status {
    answer(out, || body().map(Box::new))
}

/// Gives a handle back.
pub(crate) fn free<T>(handle: Option<Box<T>>) {
    call(|| {
        drop(handle);
        Ok(())
    });
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

/// The handles in the caller's array of `count` pointers, none of which may be NULL.
///
/// # Safety
/// Unless the checks fail, `pointers` leads to `count` pointers to handles that live during `'a`.
pub(crate) unsafe fn handles<'a, T>(
    argument: &str,
    pointers: *const *const T,
    count: usize,
) -> Result<Vec<&'a T>, Failure> {
    // SAFETY: handed on from the caller.
    let pointers = unsafe { rows::<*const T, 1>(argument, pointers, "count", count) }?;
    let handle = |(i, &[pointer]): (usize, &[*const T; 1])| {
        // SAFETY: NULL, or a handle of the caller's.
        unsafe { pointer.as_ref() }.ok_or_else(|| Failure::invalid(argument, format!("[{i}] is NULL")))
    };
    pointers.iter().enumerate().map(handle).collect()
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
        let mut out = MaybeUninit::new(Box::new(1));
        assert_eq!(create(Some(&mut out), || Err(Failure::invalid("x", "y"))), AZULEJO_ERROR_INVALID_ARGUMENT);
        // SAFETY: the output was written before.
        assert_eq!(unsafe { out.assume_init_read() }, Box::new(1));
        assert_eq!(create::<i32>(None, || panic!("no work before the checks")), AZULEJO_ERROR_INVALID_ARGUMENT);
    }

    #[test]
    fn arrays_are_checked_before_they_are_read() {
        let floats = [0.0f32; 6];
        let misaligned = floats.as_ptr().wrapping_byte_add(1);
        let status = |pointer, count| {
            // SAFETY: the only combination that passes the checks is the true one.
            call(|| unsafe { rows::<f32, 2>("xy", pointer, "count", count) }.map(drop))
        };
        assert_eq!(status(floats.as_ptr(), 3), AZULEJO_OK);
        assert_eq!(status(std::ptr::null(), 0), AZULEJO_OK);
        assert_eq!(status(std::ptr::null(), 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(status(misaligned, 1), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(status(floats.as_ptr(), usize::MAX), AZULEJO_ERROR_TOO_LARGE);
        assert_eq!(status(floats.as_ptr(), usize::MAX / 8), AZULEJO_ERROR_TOO_LARGE);
    }
}
