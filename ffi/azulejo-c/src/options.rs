//! Options structs that can grow: what of the caller's struct exists, and what the rest defaults to.
//!
//! The rules are those of the kernel's extensible system calls (openat2, clone3): the size travels with the struct,
//! missing fields take their defaults, and a longer struct is welcome as long as the unknown part is zero.

use std::ffi::c_void;
use std::ops::ControlFlow;
use std::slice;

use azulejo_core::Progress;

use crate::boundary::{self, check_pointer};
use crate::status::{Failure, azulejo_status};

/// Called now and then during a long call, on the thread that made it. See "Progress" in the conventions.
///
/// user: the progress_user of the options or of azulejo_context_watch.
///
/// done: the finished share of the call, from 0 to 1; it never falls.
///
/// Returns 0 to go on, anything else to cancel.
pub type azulejo_progress_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, done: f64) -> i32>;

/// No struct of a caller is longer: a garbage `struct_size` is refused before the struct's tail is read.
const MAX_STRUCT_SIZE: usize = 4096;

/// An options struct.
///
/// # Safety
/// `repr(C)` without padding, begins with `struct_size: u32`, and every bit pattern is valid for every field.
/// Implemented by [`options!`], which checks the layout.
pub(crate) unsafe trait Options: Copy {
    /// The name of the C type.
    const NAME: &str;
    /// What the init function writes.
    const DEFAULT: Self;
    /// Where each field ends, in order.
    const FIELD_ENDS: &[usize];
    /// How much no caller may leave out.
    const REQUIRED_END: usize;
}

/// The size of a field, from a function that projects to it.
pub(crate) const fn field_size<T, F>(_field: fn(&T) -> &F) -> usize {
    size_of::<F>()
}

/// Implements [`Options`]: the fields in order with their defaults, and the last one that no caller may leave out.
macro_rules! options {
    ($name:ident requires $required:ident { $($field:ident: $default:expr),* $(,)? }) => {
        // SAFETY: the assertion below proves the layout; options have integers, floats and nullable pointers only.
        unsafe impl $crate::options::Options for $name {
            const NAME: &str = stringify!($name);
            const DEFAULT: Self = Self { struct_size: size_of::<Self>() as u32, $($field: $default),* };
            const FIELD_ENDS: &[usize] = &[
                size_of::<u32>(),
                $(std::mem::offset_of!($name, $field) + $crate::options::field_size(|o: &$name| &o.$field)),*
            ];
            const REQUIRED_END: usize =
                std::mem::offset_of!($name, $required) + $crate::options::field_size(|o: &$name| &o.$required);
        }

        const _: () = {
            let ends = <$name as $crate::options::Options>::FIELD_ENDS;
            let starts = [$(std::mem::offset_of!($name, $field),)* size_of::<$name>()];
            let mut field = 0;
            while field < ends.len() {
                assert!(starts[field] == ends[field], "a gap between two fields, or the wrong order");
                field += 1;
            }
        };
    };
}
pub(crate) use options;

/// Fills the caller's struct, as far as it goes, with the defaults, and the part that is not known here with zeros.
///
/// # Safety
/// Unless the checks fail, `options` leads to `struct_size` writable bytes.
pub(crate) unsafe fn init<T: Options>(options: *mut T, struct_size: usize) -> azulejo_status {
    boundary::call(|| {
        check_pointer("options", options)?;
        let known = known_size::<T>(struct_size)?;
        let default = T::DEFAULT;
        // SAFETY: the caller owns `struct_size` bytes, `known` of which are not more than `T` has; T begins with a u32.
        unsafe {
            options.cast::<u8>().write_bytes(0, struct_size);
            (&raw const default).cast::<u8>().copy_to_nonoverlapping(options.cast(), known);
            options.cast::<u32>().write(struct_size as u32);
        }
        Ok(())
    })
}

/// The caller's options, with defaults for the fields that the caller's struct does not have.
///
/// # Safety
/// Unless the checks fail, `options` leads to as many bytes as its `struct_size` says.
pub(crate) unsafe fn read<T: Options>(options: *const T) -> Result<T, Failure> {
    check_pointer("options", options)?;
    // SAFETY: not NULL, aligned, and every options struct begins with its size.
    let struct_size = unsafe { options.cast::<u32>().read() } as usize;
    let known = known_size::<T>(struct_size)?;
    // SAFETY: the caller's struct has this size.
    let bytes = unsafe { slice::from_raw_parts(options.cast::<u8>(), struct_size) };
    if let Some(offset) = (size_of::<T>()..struct_size).find(|&offset| bytes[offset] != 0) {
        let reason = format!("byte {offset} is set, but {} ends at {} in this version", T::NAME, size_of::<T>());
        return Err(Failure::invalid("struct_size", reason));
    }
    let mut result = T::DEFAULT;
    // SAFETY: `known` is at most the size of `T`, and any bytes are valid for its fields.
    unsafe { bytes.as_ptr().copy_to_nonoverlapping((&raw mut result).cast(), known) };
    Ok(result)
}

/// The bytes of a struct of this size that are whole fields known here.
fn known_size<T: Options>(struct_size: usize) -> Result<usize, Failure> {
    if !(T::REQUIRED_END..=MAX_STRUCT_SIZE).contains(&struct_size) {
        let (name, required) = (T::NAME, T::REQUIRED_END);
        let reason = format!(
            "{struct_size} is not in {required}..={MAX_STRUCT_SIZE}; call {name}_init(&options, sizeof options)"
        );
        return Err(Failure::invalid("struct_size", reason));
    }
    let ends = T::FIELD_ENDS;
    Ok(ends[ends.partition_point(|&end| end <= struct_size) - 1])
}

/// A progress callback of the caller's.
#[derive(Clone, Copy)]
pub(crate) struct Watch {
    function: azulejo_progress_fn,
    user: *mut c_void,
    /// What share of the caller's call is finished when this part of it begins and ends.
    from: f64,
    to: f64,
}

// SAFETY: the two are only ever used by a thread of the caller's, in a call that it makes with what holds them: whether
// that may happen on several threads is the caller's word, as for every callback of C.
unsafe impl Send for Watch {}
// SAFETY: likewise.
unsafe impl Sync for Watch {}

impl Watch {
    /// No callback.
    pub(crate) const NOBODY: Self = Self::new(None, std::ptr::null_mut());

    pub(crate) const fn new(function: azulejo_progress_fn, user: *mut c_void) -> Self {
        Self { function, user, from: 0.0, to: 1.0 }
    }

    /// The part of a call that lies between two shares of it.
    pub(crate) fn part(self, from: f64, to: f64) -> Self {
        Self { from, to, ..self }
    }

    /// This callback, or another one if there is none.
    pub(crate) fn or(self, other: Self) -> Self {
        if self.function.is_some() { self } else { other.part(self.from, self.to) }
    }

    /// Runs `call` with the callback as the core wants it.
    pub(crate) fn run<T>(self, call: impl FnOnce(Option<&Progress>) -> T) -> T {
        let Some(function) = self.function else { return call(None) };
        let progress = |done: f64| {
            // SAFETY: the caller gave the two for each other, to be called on this thread during this call.
            match unsafe { function(self.user, self.from + (self.to - self.from) * done) } {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        };
        call(Some(&progress))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Version2 {
        struct_size: u32,
        kind: i32,
        radius: f64,
        seed: u64,
        limit: f64,
    }
    options!(Version2 requires radius { kind: 1, radius: 2.0, seed: 3, limit: 4.0 });

    /// A caller's memory, larger than any version of the struct.
    type Memory = [u64; 8];

    fn read_sized(memory: &mut Memory, struct_size: u32) -> Result<Version2, Failure> {
        let options = memory.as_mut_ptr().cast::<Version2>();
        // SAFETY: the memory is larger than the sizes that the tests use and that are not refused.
        unsafe {
            options.cast::<u32>().write(struct_size);
            read(options)
        }
    }

    #[test]
    fn a_field_exists_iff_the_size_reaches_its_end() {
        let mut memory: Memory = [0, 0, 50, 60, 0, 0, 0, 0];
        let seed = |memory: &mut Memory, size| read_sized(memory, size).unwrap().seed;
        assert_eq!(seed(&mut memory, 16), 3);
        assert_eq!(seed(&mut memory, 23), 3, "half a field is none");
        assert_eq!(seed(&mut memory, 24), 50);
        let limit = read_sized(&mut memory, 24).unwrap().limit;
        assert_eq!(limit, 4.0);
    }

    #[test]
    fn a_longer_struct_is_read_iff_its_tail_is_zero() {
        let mut memory: Memory = [0; 8];
        assert!(read_sized(&mut memory, 64).is_ok());
        memory[7] = 1 << 63;
        assert!(read_sized(&mut memory, 63).is_ok());
        assert!(read_sized(&mut memory, 64).is_err());
        memory[4] = 1;
        assert!(read_sized(&mut memory, 32).is_ok());
        assert!(read_sized(&mut memory, 33).is_err());
    }

    #[test]
    fn sizes_that_no_caller_can_have_are_refused() {
        for size in [0, 4, 15, 4097, u32::MAX] {
            assert!(read_sized(&mut [0; 8], size).is_err(), "{size}");
        }
        // SAFETY: both are refused before anything is read.
        unsafe {
            assert!(read::<Version2>(std::ptr::null()).is_err());
            assert!(read([0u64; 8].as_ptr().wrapping_byte_add(2).cast::<Version2>()).is_err());
        }
    }

    #[test]
    fn init_fills_what_the_caller_has_and_no_more() {
        for size in [16, 20, 32, 40] {
            let mut memory: Memory = [u64::MAX; 8];
            // SAFETY: the memory is larger.
            assert_eq!(unsafe { init(memory.as_mut_ptr().cast::<Version2>(), size) }, 0);
            assert_eq!(memory[size.div_ceil(8)], u64::MAX, "nothing behind the struct is touched");
            assert_eq!(memory[0], 1 << 32 | size as u64);
            let options = read_sized(&mut memory, size as u32).unwrap();
            assert_eq!(options, Version2 { struct_size: size as u32, ..Version2::DEFAULT });
        }
    }
}
