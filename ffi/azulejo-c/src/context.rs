//! The threads that calls run on.

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::sync::Arc;

use azulejo_core::{Context, Progress};

use crate::boundary::{self, required};
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// A pool of threads of its own; give it to every call that works for long. One context for a whole program is usual.
/// It can be used by several threads at once.
#[derive(Clone)]
pub struct azulejo_context {
    pub(crate) shared: Arc<Context>,
    /// Who is told of calls whose options name nobody.
    watch: Watch,
}

impl azulejo_context {
    /// Runs a call, which `own`, the callback of its options, is told of, or else that of the context. What the callback
    /// frees meanwhile is kept.
    pub(crate) fn run<T>(
        &self,
        own: Watch,
        call: impl FnOnce(&Context, Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        let (shared, watch) = (self.shared.clone(), own.or(self.watch));
        Ok(watch.run(|progress| call(&shared, progress))?)
    }
}

/// Starts the threads.
///
/// num_threads: 1 to 4096, or 0 for one per core. With 1 no thread is made: all work happens in the caller's. This bounds
/// Embree's threads, too; but Embree knows one bound for a process, the largest that one of its devices has, and sets it
/// for all that uses TBB. Beside a device of the program's that has more threads, a build of this library can use as many;
/// a device with fewer can use `num_threads` while a psp handle that has made iterations lives, and has its own number
/// again after that. TBB may leave threads of its own behind, also with 1, which do no work. AZULEJO_ENGINE_RASTERISER
/// makes no device and wakes nobody.
///
/// out: the context, to be freed with azulejo_context_free.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_context_create(
    num_threads: u32,
    out: Option<&mut MaybeUninit<Box<azulejo_context>>>,
) -> azulejo_status {
    boundary::create(out, || {
        Ok(azulejo_context { shared: Arc::new(Context::new(num_threads as usize)?), watch: Watch::NONE })
    })
}

/// Makes a context that has the threads of another one and a progress callback: it is told of each call that is made with
/// this context, or with a psp handle made with it, and whose options have no callback of their own. So calls without
/// options, as those of the analysis, can be watched and cancelled.
///
/// context: the other one, which may be freed before. A callback that it has is not taken over.
///
/// progress, progress_user: the callback, or NULL for none, and what it is handed. See "Progress" in the conventions. When
/// several threads use the context, each calls it.
///
/// out: the context, to be freed with azulejo_context_free. No thread is made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_context_watch(
    context: Option<&azulejo_context>,
    progress: azulejo_progress_fn,
    progress_user: *mut c_void,
    out: Option<&mut MaybeUninit<Box<azulejo_context>>>,
) -> azulejo_status {
    boundary::create(out, || {
        let shared = required("context", context)?.shared.clone();
        Ok(azulejo_context { shared, watch: Watch::new(progress, progress_user) })
    })
}

/// The number of threads that work on a call; 0 for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_context_num_threads(context: Option<&azulejo_context>) -> u32 {
    context.map_or(0, |context| context.shared.num_threads() as u32)
}

/// Ends the threads, once no call and no psp handle uses them any more. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_context_free(context: Option<Box<azulejo_context>>) {
    boundary::free(context);
}
