//! Structs of the header that can grow: options, which the library reads, and reports, which it writes.
//!
//! The rules are those of the kernel's extensible system calls (openat2, clone3): the size travels with the struct.
//! Fields that the caller's struct lacks take their defaults when it is read and are left out when it is written; a
//! longer struct is welcome as long as the part that is unknown here is zero when it is read. It is never written.

use std::slice;

use crate::boundary::{self, check_pointer, check_size};
use crate::status::{Failure, azulejo_status};

/// No struct of a caller is longer: a garbage `struct_size` is refused before the struct's tail is read.
const MAX_STRUCT_SIZE: usize = 4096;

/// A struct that begins with `struct_size` and can get fields at its end.
///
/// # Safety
/// `repr(C)` without padding, begins with `struct_size: u32`, and every bit pattern is valid for every field.
/// Implemented by [`growing!`], which checks the layout.
pub(crate) unsafe trait Growing: Copy {
    /// The name of the C type.
    const NAME: &str;
    /// The struct that the init function writes.
    const DEFAULT: Self;
    /// The end of each field, in order.
    const FIELD_ENDS: &[usize];
    /// The least `struct_size` that is accepted.
    const REQUIRED_END: usize;
}

/// The size of a field, from a function that projects to it.
pub(crate) const fn field_size<T, F>(_field: fn(&T) -> &F) -> usize {
    size_of::<F>()
}

/// Implements [`Growing`]: the last field that no caller may leave out, and all fields in order with what the init
/// function writes.
macro_rules! growing {
    ($name:ident requires $required:ident { $($field:ident: $default:expr),* $(,)? }) => {
        // SAFETY: the assertion below proves the layout; fields are integers, floats and nullable pointers only.
        unsafe impl $crate::growing::Growing for $name {
            const NAME: &str = stringify!($name);
            const DEFAULT: Self = Self { struct_size: size_of::<Self>() as u32, $($field: $default),* };
            const FIELD_ENDS: &[usize] = &[
                size_of::<u32>(),
                $(std::mem::offset_of!($name, $field) + $crate::growing::field_size(|s: &$name| &s.$field)),*
            ];
            const REQUIRED_END: usize =
                std::mem::offset_of!($name, $required) + $crate::growing::field_size(|s: &$name| &s.$required);
        }

        const _: () = {
            let ends = <$name as $crate::growing::Growing>::FIELD_ENDS;
            let starts = [$(std::mem::offset_of!($name, $field),)* size_of::<$name>()];
            let mut field = 0;
            while field < ends.len() {
                assert!(starts[field] == ends[field], "a gap between two fields, or the wrong order");
                field += 1;
            }
        };
    };
}
pub(crate) use growing;

/// Fills the caller's struct, as far as it goes, with the defaults, and the part that is not known here with zeros.
///
/// # Safety
/// Unless the checks fail, `pointer` leads to `struct_size` writable bytes.
pub(crate) unsafe fn init<T: Growing>(argument: &str, pointer: *mut T, struct_size: usize) -> azulejo_status {
    boundary::call(|| {
        check_pointer(argument, pointer)?;
        let known = known_size::<T>(argument, struct_size)?;
        let default = T::DEFAULT;
        // SAFETY: the caller owns `struct_size` bytes, `known` of which are not more than `T` has; T begins with a u32.
        unsafe {
            pointer.cast::<u8>().write_bytes(0, struct_size);
            (&raw const default).cast::<u8>().copy_to_nonoverlapping(pointer.cast(), known);
            pointer.cast::<u32>().write(struct_size as u32);
        }
        Ok(())
    })
}

/// The caller's struct, with defaults for the fields that it does not have.
///
/// # Safety
/// Unless the checks fail, `pointer` leads to as many bytes as its `struct_size` says.
pub(crate) unsafe fn read<T: Growing>(argument: &str, pointer: *const T) -> Result<T, Failure> {
    // SAFETY: handed on from the caller.
    let (struct_size, known) = unsafe { sizes(argument, pointer) }?;
    // SAFETY: the caller's struct has this size.
    let bytes = unsafe { slice::from_raw_parts(pointer.cast::<u8>(), struct_size) };
    if let Some(offset) = (size_of::<T>()..struct_size).find(|&offset| bytes[offset] != 0) {
        let (name, end) = (T::NAME, size_of::<T>());
        let reason = format!("struct_size is {struct_size} and byte {offset} is set, but {name} ends at {end} here");
        return Err(Failure::invalid(argument, reason));
    }
    let mut result = T::DEFAULT;
    // SAFETY: `known` is at most the size of `T`, and any bytes are valid for its fields.
    unsafe { bytes.as_ptr().copy_to_nonoverlapping((&raw mut result).cast(), known) };
    Ok(result)
}

/// A struct of the caller's that is to be written when the call has succeeded: checked before any work begins.
pub(crate) struct Output<T> {
    to: *mut T,
    /// The bytes of it that are whole fields known here.
    known: usize,
}

impl<T: Growing> Output<T> {
    /// The caller's struct.
    ///
    /// # Safety
    /// Unless the checks fail, `pointer` leads to as many writable bytes as its `struct_size` says, until the output is
    /// dropped.
    pub(crate) unsafe fn required(argument: &str, pointer: *mut T) -> Result<Self, Failure> {
        // SAFETY: handed on from the caller.
        let (_, known) = unsafe { sizes(argument, pointer) }?;
        Ok(Self { to: pointer, known })
    }

    /// The caller's struct, or none for NULL.
    ///
    /// # Safety
    /// As [`Output::required`], unless `pointer` is NULL.
    pub(crate) unsafe fn optional(argument: &str, pointer: *mut T) -> Result<Option<Self>, Failure> {
        // SAFETY: handed on from the caller.
        if pointer.is_null() { Ok(None) } else { unsafe { Self::required(argument, pointer) }.map(Some) }
    }

    /// Writes the fields that the caller's struct has, but for its size.
    pub(crate) fn write(self, value: impl Into<T>) {
        let value = value.into();
        let skipped = size_of::<u32>();
        // SAFETY: `known` is neither more than the caller's struct has nor more than `T` has.
        unsafe {
            let from = (&raw const value).cast::<u8>().add(skipped);
            from.copy_to_nonoverlapping(self.to.cast::<u8>().add(skipped), self.known - skipped);
        }
    }
}

/// A copy of the caller's array of structs, whose size is an argument of the call instead of a field: elements that are
/// shorter than here are refused, in longer ones the part that is unknown here must be zero.
///
/// # Safety
/// Unless the checks fail, `elements` leads to `count` elements of `size` bytes each, and any bytes are valid for a `T`.
pub(crate) unsafe fn elements<T: Copy>(
    [argument, count_argument, size_argument]: [&str; 3],
    elements: *const T,
    count: usize,
    size: usize,
) -> Result<Vec<T>, Failure> {
    check_element_size::<T>(size_argument, size)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    check_pointer(argument, elements)?;
    let bytes = check_size(count_argument, count, count.checked_mul(size))?;
    // SAFETY: not NULL, of a possible size; the rest is the caller's word.
    let bytes = unsafe { slice::from_raw_parts(elements.cast::<u8>(), bytes) };
    let element = |(i, bytes): (usize, &[u8])| {
        let (known, unknown) = bytes.split_at(size_of::<T>());
        if unknown.iter().any(|&byte| byte != 0) {
            let reason =
                format!("[{i}]: {size_argument} is {size}, and what is set beyond {} is not known here", known.len());
            return Err(Failure::invalid(argument, reason));
        }
        // SAFETY: as many bytes as a `T` has, and any bytes are valid for it.
        Ok(unsafe { known.as_ptr().cast::<T>().read_unaligned() })
    };
    bytes.chunks_exact(size).enumerate().map(element).collect()
}

/// Refuses a size of elements that is too small, too large, or leaves the second one misaligned.
pub(crate) fn check_element_size<T>(argument: &str, size: usize) -> Result<(), Failure> {
    let least = size_of::<T>();
    if (least..=MAX_STRUCT_SIZE).contains(&size) && size.is_multiple_of(align_of::<T>()) {
        return Ok(());
    }
    Err(Failure::invalid(argument, format!("{size} is not the size of the struct, which has {least} bytes here")))
}

/// The size that the caller's struct says it has, and the bytes of it that are whole fields known here.
///
/// # Safety
/// Unless the check fails, `pointer` leads to at least 4 bytes.
unsafe fn sizes<T: Growing>(argument: &str, pointer: *const T) -> Result<(usize, usize), Failure> {
    check_pointer(argument, pointer)?;
    // SAFETY: not NULL, aligned, and every growing struct begins with its size.
    let struct_size = unsafe { pointer.cast::<u32>().read() } as usize;
    Ok((struct_size, known_size::<T>(argument, struct_size)?))
}

/// The bytes of a struct of this size that are whole fields known here.
fn known_size<T: Growing>(argument: &str, struct_size: usize) -> Result<usize, Failure> {
    if !(T::REQUIRED_END..=MAX_STRUCT_SIZE).contains(&struct_size) {
        let (name, required) = (T::NAME, T::REQUIRED_END);
        let reason = format!(
            "struct_size {struct_size} is not in {required}..={MAX_STRUCT_SIZE}; call {name}_init before, with the size \
             of the struct"
        );
        return Err(Failure::invalid(argument, reason));
    }
    let ends = T::FIELD_ENDS;
    Ok(ends[ends.partition_point(|&end| end <= struct_size) - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Version2 {
        struct_size: u32,
        kind: u32,
        radius: f64,
        seed: u64,
        limit: f64,
    }
    growing!(Version2 requires radius { kind: 1, radius: 2.0, seed: 3, limit: 4.0 });

    /// A caller's memory, larger than any version of the struct.
    type Memory = [u64; 8];

    fn read_sized(memory: &mut Memory, struct_size: u32) -> Result<Version2, Failure> {
        let options = memory.as_mut_ptr().cast::<Version2>();
        // SAFETY: the memory is larger than the sizes that the tests use and that are not refused.
        unsafe {
            options.cast::<u32>().write(struct_size);
            read("options", options)
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
    fn elements_are_read_by_the_caller_s_size() {
        let names = ["pieces", "piece_count", "piece_size"];
        let memory: Memory = [1, 2, 0, 3, 4, 0, 0, 7];
        let read = |count: usize, size: usize| {
            // SAFETY: the memory is larger than what is read.
            unsafe { elements::<[u64; 2]>(names, memory.as_ptr().cast(), count, size) }
        };
        assert_eq!(read(2, 16).unwrap(), [[1, 2], [0, 3]]);
        assert_eq!(read(2, 24).unwrap(), [[1, 2], [3, 4]]);
        for (count, size) in [(2, 8), (2, 20), (2, 4104), (1, 64), (0, 0)] {
            assert!(read(count, size).is_err(), "{count} elements of {size} bytes");
        }
        assert!(read(0, 16).unwrap().is_empty());
        // SAFETY: refused before anything is read.
        unsafe {
            assert!(elements::<[u64; 2]>(names, std::ptr::null(), 1, 16).is_err());
            assert!(elements::<[u64; 2]>(names, memory.as_ptr().cast(), usize::MAX, 16).is_err());
        }
    }

    #[test]
    fn sizes_that_no_caller_can_have_are_refused() {
        for size in [0, 4, 15, 4097, u32::MAX] {
            assert!(read_sized(&mut [0; 8], size).is_err(), "{size}");
            let mut memory: Memory = [u64::from(size); 8];
            // SAFETY: refused before anything but the size is read.
            assert!(unsafe { Output::<Version2>::required("report", memory.as_mut_ptr().cast()) }.is_err(), "{size}");
        }
        // SAFETY: all are refused before anything is read.
        unsafe {
            let misaligned = [0u64; 8].as_mut_ptr().wrapping_byte_add(2).cast::<Version2>();
            assert!(read::<Version2>("options", std::ptr::null()).is_err());
            assert!(read("options", misaligned.cast_const()).is_err());
            assert!(Output::required("report", misaligned).is_err());
            assert!(Output::<Version2>::required("report", std::ptr::null_mut()).is_err());
            assert!(Output::<Version2>::optional("report", std::ptr::null_mut()).unwrap().is_none());
        }
    }

    #[test]
    fn init_fills_what_the_caller_has_and_no_more() {
        for size in [16, 20, 32, 40] {
            let mut memory: Memory = [u64::MAX; 8];
            // SAFETY: the memory is larger.
            assert_eq!(unsafe { init("options", memory.as_mut_ptr().cast::<Version2>(), size) }, 0);
            assert_eq!(memory[size.div_ceil(8)], u64::MAX, "nothing behind the struct is touched");
            assert_eq!(memory[0], 1 << 32 | size as u64);
            let options = read_sized(&mut memory, size as u32).unwrap();
            assert_eq!(options, Version2 { struct_size: size as u32, ..Version2::DEFAULT });
        }
    }

    #[test]
    fn an_output_gets_the_fields_that_it_has() {
        let value = Version2 { struct_size: 7, kind: 8, radius: 9.0, seed: 10, limit: 11.0 };
        for (size, words) in [(16, 2), (23, 2), (24, 3), (32, 4), (64, 4)] {
            let mut memory: Memory = [u64::MAX; 8];
            memory[0] = size;
            // SAFETY: the memory has the size that it says.
            unsafe { Output::<Version2>::required("report", memory.as_mut_ptr().cast()) }.unwrap().write(value);
            let expected = [8 << 32 | size, 9f64.to_bits(), 10, 11f64.to_bits()];
            assert_eq!(memory[..words], expected[..words], "{size}");
            assert_eq!(memory[words..], [u64::MAX; 8][words..], "{size}");
        }
    }
}
