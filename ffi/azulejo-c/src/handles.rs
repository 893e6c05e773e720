//! Handles: what the library makes and the caller owns, behind a tag that names its type.
//!
//! Behind a caller's `azulejo_mesh *` is a [`Tagged`] mesh. The first word in its memory is the tag of the type; it is
//! overwritten before the memory is given back. So a handle of another type is refused, and so is a freed one for as
//! long as nothing else has its memory. That it has none is the caller's word (`SAFETY` below), for which there is no
//! check.

use std::sync::TryLockError;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::boundary::{self, Out, check_pointer, rows};
use crate::status::{AZULEJO_ERROR_BUSY, AZULEJO_ERROR_INTERNAL, Failure, azulejo_status};

/// A type that the caller has handles of.
///
/// # Safety
/// No other type has the same name. [`handle!`] takes the name of the type.
pub(crate) unsafe trait Handle {
    /// The name of the C type.
    const NAME: &str;
}

/// Lets the caller have handles of a type.
macro_rules! handle {
    ($name:ident) => {
        // SAFETY: the types of the header have names of their own.
        unsafe impl $crate::handles::Handle for $name {
            const NAME: &str = stringify!($name);
        }
    };
}
pub(crate) use handle;

/// The memory that a handle leads to.
#[repr(C)]
struct Tagged<T> {
    tag: AtomicU64,
    value: T,
}

/// The tag of a handle that was freed.
const FREED: u64 = 0;

/// The tag of a type: the FNV-1a hash of its name (Fowler, Noll and Vo). It is no address and no small number.
const fn tag<T: Handle>() -> u64 {
    let (name, mut hash, mut i) = (T::NAME.as_bytes(), 0xcbf2_9ce4_8422_2325u64, 0);
    while i < name.len() {
        hash = (hash ^ name[i] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        i += 1;
    }
    hash
}

/// Makes a handle of what `body` returns.
pub(crate) fn create<T: Handle>(out: Out<*mut T>, body: impl FnOnce() -> Result<T, Failure>) -> azulejo_status {
    boundary::answer(out, || body().map(make))
}

/// A handle of a value.
pub(crate) fn make<T: Handle>(value: T) -> *mut T {
    Box::into_raw(Box::new(Tagged { tag: AtomicU64::new(const { tag::<T>() }), value })).cast()
}

/// The value behind a handle of the caller; refuses pointers that can be seen not to be one.
///
/// # Safety
/// Unless the checks fail, `pointer` leads to at least 8 bytes, and if these are the tag, to a handle that is not freed
/// during `'a`.
pub(crate) unsafe fn get<'a, T: Handle>(argument: &str, pointer: *const T) -> Result<&'a T, Failure> {
    let tagged = pointer.cast::<Tagged<T>>();
    check_pointer(argument, tagged)?;
    // SAFETY: not NULL, aligned; the rest is the caller's word.
    let found = unsafe { (*tagged).tag.load(Ordering::Relaxed) };
    if found != const { tag::<T>() } {
        let reason = if found == FREED { "was freed" } else { "is a handle of another type, was freed, or is none" };
        return Err(Failure::invalid(argument, format!("{pointer:p} is no {}: it {reason}", T::NAME)));
    }
    // SAFETY: the tag says that this is what `create` made.
    Ok(unsafe { &(*tagged).value })
}

/// [`get`] for functions that return 0 or NULL where there is nothing: nothing for NULL, and nothing, with a message,
/// for what is refused.
///
/// # Safety
/// As [`get`].
pub(crate) unsafe fn peek<'a, T: Handle>(argument: &str, pointer: *const T) -> Option<&'a T> {
    if pointer.is_null() {
        return None;
    }
    // SAFETY: handed on from the caller.
    unsafe { get(argument, pointer) }.map_err(Failure::record).ok()
}

/// The handles in the caller's array of `count` pointers, whose number is the argument `count_argument`.
///
/// # Safety
/// Unless the checks fail, `pointers` leads to `count` pointers, each of them as in [`get`].
pub(crate) unsafe fn all<'a, T: Handle>(
    argument: &str,
    count_argument: &str,
    pointers: *const *const T,
    count: usize,
) -> Result<Vec<&'a T>, Failure> {
    // SAFETY: handed on from the caller.
    let pointers = unsafe { rows::<*const T, 1>(argument, pointers, count_argument, count) }?;
    // SAFETY: likewise.
    let handle = |(i, &[pointer]): (usize, &[*const T; 1])| unsafe { get(&format!("{argument}: [{i}]"), pointer) };
    pointers.iter().enumerate().map(handle).collect()
}

/// Gives a handle back; NULL is none. What is refused stays as it is, and the thread's last error tells the reason.
///
/// # Safety
/// As [`get`], and nothing uses the handle any more.
pub(crate) unsafe fn free<T: Handle>(argument: &str, pointer: *mut T) {
    boundary::call(|| {
        if pointer.is_null() {
            return Ok(());
        }
        // SAFETY: handed on from the caller.
        unsafe { get(argument, pointer.cast_const()) }?;
        // SAFETY: `create` made it of a box, and the caller gives it up.
        let tagged = unsafe { Box::from_raw(pointer.cast::<Tagged<T>>()) };
        retire(&tagged);
        drop(tagged);
        Ok(())
    });
}

/// The refusal of a call on a handle whose lock cannot be had.
pub(crate) fn locked<T>(argument: &str, error: &TryLockError<T>) -> Failure {
    match error {
        TryLockError::WouldBlock => Failure::new(AZULEJO_ERROR_BUSY, format!("{argument}: is in use by another call")),
        TryLockError::Poisoned(_) => {
            let reason = format!("{argument}: an internal error broke the set off; it can only be freed");
            Failure::new(AZULEJO_ERROR_INTERNAL, reason)
        }
    }
}

/// Overwrites the tag. The store must be made although the memory is given back right afterwards: an optimiser would
/// drop it, unless it is volatile.
fn retire<T>(tagged: &Tagged<T>) {
    // SAFETY: the word is there, and the handle is in no use any more.
    unsafe { tagged.tag.as_ptr().write_volatile(FREED) };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::call;
    use crate::status::{AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_OK};

    struct Apple(u32);
    struct Pear(#[allow(dead_code, reason = "it has the size of an apple")] u32);
    handle!(Apple);
    handle!(Pear);

    fn apple() -> *mut Apple {
        let mut made = std::ptr::null_mut();
        // SAFETY: the output is there.
        let out = unsafe { Out::new(&raw mut made) };
        assert_eq!(create(out, || Ok(Apple(3))), AZULEJO_OK);
        made
    }

    fn refused<T: Handle>(pointer: *const T) -> String {
        // SAFETY: the tests' pointers lead to handles, or are refused before they are read.
        let failure = unsafe { get("fruit", pointer) }.map(|_| "taken").unwrap_err();
        format!("{failure:?}")
    }

    #[test]
    fn a_handle_of_another_type_is_refused_and_not_freed() {
        let made = apple();
        // SAFETY: a handle of the library, which lives.
        unsafe {
            assert_eq!(get("fruit", made.cast_const()).unwrap().0, 3);
            assert!(refused(made.cast::<Pear>()).contains("is no Pear: it is a handle of another type"));
            free("fruit", made.cast::<Pear>());
            assert_eq!(peek("fruit", made.cast_const()).unwrap().0, 3);
            assert!(peek("fruit", made.cast_const().cast::<Pear>()).is_none());
            free("fruit", made);
            free("fruit", std::ptr::null_mut::<Apple>());
            assert!(peek::<Apple>("fruit", std::ptr::null()).is_none());
        }
    }

    #[test]
    fn a_retired_handle_is_refused() {
        let tagged = Tagged { tag: AtomicU64::new(tag::<Apple>()), value: Apple(3) };
        let pointer = (&raw const tagged).cast::<Apple>();
        // SAFETY: it has the tag of an apple and is one.
        assert_eq!(unsafe { get("fruit", pointer) }.unwrap().0, 3);
        retire(&tagged);
        assert!(refused(pointer).contains("is no Apple: it was freed"));
    }

    #[test]
    fn misaligned_handles_and_outputs_are_refused() {
        let made = apple();
        assert!(refused(made.wrapping_byte_add(1).cast_const()).contains("is not aligned to 8 bytes"));
        assert!(refused(std::ptr::null::<Apple>()).contains("fruit: is NULL"));
        let mut word = [made; 2];
        // SAFETY: refused before it is written.
        let out = unsafe { Out::new(word.as_mut_ptr().wrapping_byte_add(4)) };
        assert_eq!(create::<Apple>(out, || panic!("no work before the checks")), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(word, [made; 2]);
        let handles = [made.cast_const(), made.wrapping_byte_add(2)];
        // SAFETY: the first is a handle, the second is refused.
        let status = |count| call(|| unsafe { all("fruit", "count", handles.as_ptr(), count) }.map(drop));
        assert_eq!((status(1), status(2)), (AZULEJO_OK, AZULEJO_ERROR_INVALID_ARGUMENT));
        // SAFETY: a handle of the library, which nothing uses any more.
        unsafe { free("fruit", made) };
    }
}
