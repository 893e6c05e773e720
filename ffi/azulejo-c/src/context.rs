//! The threads that calls run on.

use std::ffi::c_void;
use std::sync::Arc;

use azulejo_core::{Context, Progress};

use crate::boundary::Out;
use crate::handles::{self, handle};
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// A pool of threads, passed to every call that does long work. One context for a whole program is
/// usual; several threads may use it at once.
#[derive(Clone)]
pub struct azulejo_context {
    pub(crate) shared: Arc<Context>,
    /// The callback of calls whose options have none.
    watch: Watch,
}

handle!(azulejo_context);

impl azulejo_context {
    /// Runs a call. Its progress goes to `own`, the callback of its options, or else to that of the
    /// context. Handles that the callback frees live until the end of the call.
    pub(crate) fn run<T>(
        &self,
        own: Watch,
        call: impl FnOnce(&Context, Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        let (shared, watch) = (self.shared.clone(), own.or(self.watch));
        Ok(watch.run(|progress| call(&shared, progress))?)
    }
}

/// Makes a context and starts its threads.
///
/// num_threads: 1 to 4096, or 0 for one per core. With 1 all work happens on the calling thread.
///
/// Embree's scenes are built by as many threads, at most one per core. While a mesh exists that
/// Embree has traced, the bound on threads of a device of the program's own is suspended.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_context_create(num_threads: u32, out: *mut *mut azulejo_context) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        Ok(azulejo_context { shared: Arc::new(Context::new(num_threads as usize)?), watch: Watch::NONE })
    })
}

/// Makes a context that shares the threads of another one and adds a progress callback, for all
/// calls with it, or with a handle made with it, whose options have none: so calls without options,
/// such as the analysis, can report progress and be cancelled.
///
/// context: it may be freed before this one. Its callback is not inherited.
///
/// progress: the callback, or NULL for none. Each thread that calls with the context calls it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_context_watch(
    context: *const azulejo_context,
    progress: azulejo_progress_fn,
    progress_user: *mut c_void,
    out: *mut *mut azulejo_context,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let shared = unsafe { handles::get("context", context) }?.shared.clone();
        Ok(azulejo_context { shared, watch: Watch::new(progress, progress_user) })
    })
}

/// The number of threads that work on a call; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_context_num_threads(context: *const azulejo_context) -> u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("context", context) }.map_or(0, |context| context.shared.num_threads() as u32)
}

/// Frees a context. Its threads end when no call and no handle uses them any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_context_free(context: *mut azulejo_context) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("context", context) };
}
