//! Status codes, and the last error of each thread.

use std::cell::RefCell;
use std::ffi::{CStr, c_char};

use azulejo_core::Error;

/// The result of a call: AZULEJO_OK or a negative AZULEJO_ERROR_ code. Later versions may add some.
pub type azulejo_status = i32;

/// The call succeeded.
pub const AZULEJO_OK: i32 = 0;
/// An argument or option is outside its documented range.
pub const AZULEJO_ERROR_INVALID_ARGUMENT: i32 = -1;
/// More than can be indexed or held in memory. The message has the estimate.
pub const AZULEJO_ERROR_TOO_LARGE: i32 = -2;
/// A file could not be read.
pub const AZULEJO_ERROR_IO: i32 = -3;
/// A file was read, but its content is not valid.
pub const AZULEJO_ERROR_FORMAT: i32 = -4;
/// A callback of the caller cancelled the call.
pub const AZULEJO_ERROR_CANCELLED: i32 = -5;
/// There is no memory for a copy of the caller's arrays.
pub const AZULEJO_ERROR_OUT_OF_MEMORY: i32 = -6;
/// Embree failed: it is not there, has no memory, or cannot build a scene.
pub const AZULEJO_ERROR_EMBREE: i32 = -7;
/// Threads could not be started, or the context's are left in the parent of a forked process.
pub const AZULEJO_ERROR_THREADS: i32 = -8;
/// The handle is in use by another call, or by the one whose callback makes this one: try later.
pub const AZULEJO_ERROR_BUSY: i32 = -9;
/// The library was built without Embree: see azulejo_has_embree.
pub const AZULEJO_ERROR_UNSUPPORTED: i32 = -10;
/// A bug in the library; please report it. Handles that took part in the call can only be freed.
pub const AZULEJO_ERROR_INTERNAL: i32 = -100;

/// A call that was refused or could not be finished: its status and its message.
#[derive(Debug)]
pub(crate) struct Failure {
    status: azulejo_status,
    message: String,
}

impl Failure {
    pub(crate) fn new(status: azulejo_status, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    pub(crate) fn invalid(argument: &str, reason: impl std::fmt::Display) -> Self {
        Self::new(AZULEJO_ERROR_INVALID_ARGUMENT, format!("{argument}: {reason}"))
    }

    pub(crate) fn too_large(argument: &str, reason: impl std::fmt::Display) -> Self {
        Self::new(AZULEJO_ERROR_TOO_LARGE, format!("{argument}: {reason}"))
    }

    /// Keeps the message as this thread's last error and gives the status.
    pub(crate) fn record(self) -> azulejo_status {
        // A thread that is being torn down has no last error any more, but still gets the status.
        let _ = LAST_ERROR.try_with(|last| last.replace(self.message));
        self.status
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::InvalidArgument { .. } => AZULEJO_ERROR_INVALID_ARGUMENT,
            Error::TooLarge { .. } => AZULEJO_ERROR_TOO_LARGE,
            Error::Io { .. } => AZULEJO_ERROR_IO,
            Error::Format { .. } => AZULEJO_ERROR_FORMAT,
            Error::Cancelled => AZULEJO_ERROR_CANCELLED,
            Error::Embree(_) => AZULEJO_ERROR_EMBREE,
            Error::Threads { .. } | Error::Forked => AZULEJO_ERROR_THREADS,
            Error::Unsupported(_) => AZULEJO_ERROR_UNSUPPORTED,
            // The enum may grow inside the workspace; an error without a code of its own is a bug of this crate.
            _ => AZULEJO_ERROR_INTERNAL,
        };
        Self::new(status, error.to_string())
    }
}

thread_local! {
    static LAST_ERROR: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Copies the message of this thread's last failed call, which calls that succeed leave as it is:
/// one line of UTF-8, terminated by a NUL; empty if no call has failed. Returns the size of the
/// whole message in bytes, including the NUL.
///
/// buffer: receives at most `capacity` bytes including the NUL; a longer message is cut between two
/// characters. May be NULL if `capacity` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_last_error_message(buffer: *mut c_char, capacity: usize) -> usize {
    let copy = |message: &RefCell<String>| {
        let message = message.borrow();
        if !buffer.is_null() && capacity > 0 {
            let length = (0..capacity).rev().find(|&end| message.is_char_boundary(end)).unwrap_or(0);
            // SAFETY: the caller owns `capacity` bytes at `buffer`, and `length` is below `capacity`.
            unsafe {
                buffer.copy_from_nonoverlapping(message.as_ptr().cast(), length);
                buffer.add(length).write(0);
            }
        }
        message.len() + 1
    };
    LAST_ERROR.try_with(copy).unwrap_or(0)
}

/// The names of the codes, from the constants themselves.
macro_rules! names {
    ($($name:ident),* $(,)?) => {
        /// The name of a status.
        fn name(status: azulejo_status) -> Option<&'static CStr> {
            match status {
                $($name => Some(const {
                    match CStr::from_bytes_with_nul(concat!(stringify!($name), "\0").as_bytes()) {
                        Ok(name) => name,
                        Err(_) => unreachable!(),
                    }
                }),)*
                _ => None,
            }
        }

        #[cfg(test)]
        const ALL: &[(&str, azulejo_status)] = &[$((stringify!($name), $name)),*];
    };
}

names! {
    AZULEJO_OK,
    AZULEJO_ERROR_INVALID_ARGUMENT,
    AZULEJO_ERROR_TOO_LARGE,
    AZULEJO_ERROR_IO,
    AZULEJO_ERROR_FORMAT,
    AZULEJO_ERROR_CANCELLED,
    AZULEJO_ERROR_OUT_OF_MEMORY,
    AZULEJO_ERROR_EMBREE,
    AZULEJO_ERROR_THREADS,
    AZULEJO_ERROR_BUSY,
    AZULEJO_ERROR_UNSUPPORTED,
    AZULEJO_ERROR_INTERNAL,
}

/// The name of a status, such as "AZULEJO_ERROR_BUSY"; NULL for any other number. Never freed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_status_name(status: azulejo_status) -> *const c_char {
    name(status).map_or(std::ptr::null(), CStr::as_ptr)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_of_the_header_has_its_name() {
        let header = include_str!("../../../include/azulejo/base.h");
        let defined = header.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
        let defined: Vec<_> = defined
            .filter(|(name, _)| *name == "AZULEJO_OK" || name.starts_with("AZULEJO_ERROR_"))
            .map(|(name, value)| (name, value.split(' ').next().unwrap().parse().unwrap()))
            .collect();
        assert_eq!(defined, ALL);
        for &(text, status) in ALL {
            // SAFETY: a static text with a NUL at its end.
            assert_eq!(unsafe { CStr::from_ptr(azulejo_status_name(status)) }.to_str(), Ok(text));
        }
        assert!(azulejo_status_name(1).is_null() && azulejo_status_name(-99).is_null());
    }

    fn last_error(capacity: usize) -> (usize, String) {
        let mut buffer = vec![b'x' as c_char; 64];
        // SAFETY: the buffer has at least `capacity` bytes.
        let needed = unsafe { azulejo_last_error_message(buffer.as_mut_ptr(), capacity) };
        let text = buffer.iter().map(|&byte| byte as u8).take_while(|&byte| byte != 0).collect();
        (needed, String::from_utf8(text).unwrap())
    }

    #[test]
    fn the_message_is_cut_between_characters_and_its_size_is_told() {
        assert_eq!(last_error(64), (1, String::new()));
        assert_eq!(Failure::invalid("path", "é").record(), AZULEJO_ERROR_INVALID_ARGUMENT);
        assert_eq!(last_error(64), (9, "path: é".into()));
        assert_eq!(last_error(9), (9, "path: é".into()));
        assert_eq!(last_error(8), (9, "path: ".into()));
        assert_eq!(last_error(1), (9, String::new()));
        // SAFETY: nothing is written to NULL, or with a capacity of 0.
        assert_eq!(unsafe { azulejo_last_error_message(std::ptr::null_mut(), 0) }, 9);
        assert_eq!(std::thread::spawn(|| last_error(64)).join().unwrap(), (1, String::new()));
    }
}
