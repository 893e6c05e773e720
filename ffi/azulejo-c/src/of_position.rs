//! Functions of a position that the caller gives: radii and densities.

use std::ffi::c_void;

/// Gives the radius at a position, from `smallest` to `largest`. See "Callbacks" in azulejo.h.
///
/// user: the radius_function_user of the options.
///
/// position: x y z of a place; for a sample, the floats that are returned.
pub type azulejo_radius_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, position: *const f64) -> f64>;

/// The caller's function of `N` coordinates and its user pointer, as the core calls it.
pub(crate) struct OfPosition<const N: usize> {
    function: unsafe extern "C-unwind" fn(*mut c_void, *const f64) -> f64,
    user: *mut c_void,
}

// SAFETY: guaranteed by the caller, as the types of these functions require: they may be called from several threads at
// once.
unsafe impl<const N: usize> Sync for OfPosition<N> {}

impl<const N: usize> OfPosition<N> {
    /// # Safety
    /// The caller gave the two for each other, to be called until this is dropped, with `N` coordinates.
    pub(crate) unsafe fn new(
        function: unsafe extern "C-unwind" fn(*mut c_void, *const f64) -> f64,
        user: *mut c_void,
    ) -> Self {
        Self { function, user }
    }

    pub(crate) fn call(&self, position: [f64; N]) -> f64 {
        // SAFETY: the word of whoever made this.
        unsafe { (self.function)(self.user, position.as_ptr()) }
    }
}
