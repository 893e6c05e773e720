//! Progress callbacks of the caller's.

use std::ffi::c_void;
use std::ops::ControlFlow;

use azulejo_core::Progress;

/// Called repeatedly during a call: see "Progress" in azulejo.h. Returns 0 to go on, else cancels.
///
/// user: the progress_user of the options or of azulejo_context_watch.
///
/// done: the fraction of the call that is done, from 0 to 1.
pub type azulejo_progress_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, done: f64) -> u32>;

/// A callback with its user, and the part of the caller's call that it is to see as a range of its
/// own.
#[derive(Clone, Copy)]
pub(crate) struct Watch {
    function: azulejo_progress_fn,
    user: *mut c_void,
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
    pub(crate) const NONE: Self = Self::new(None, std::ptr::null_mut());

    pub(crate) const fn new(function: azulejo_progress_fn, user: *mut c_void) -> Self {
        Self { function, user, from: 0.0, to: 1.0 }
    }

    /// The part of a call from one fraction of it to another.
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
