//! The threads of `azulejo-threads.wasm`, where a thread is a worker with an instance of the module on the shared memory.
//!
//! The standard library starts none on WebAssembly: `pool.js` does, and each one fetches here what it has to run. In
//! `azulejo.wasm` nothing of this is called, and calls run on one thread.

use std::alloc::{Layout, alloc};
use std::ops::Deref;
use std::sync::{Mutex, OnceLock, PoisonError};

use azulejo::{Context, Result};

/// The context of all calls, of a module with threads.
static POOL: OnceLock<Context> = OnceLock::new();

/// The work of the threads that have not come yet.
static WAITING: Mutex<Vec<Box<dyn FnOnce() + Send>>> = Mutex::new(Vec::new());

/// The context of a call.
pub(crate) enum Threads {
    Pool(&'static Context),
    One(Context),
}

impl Deref for Threads {
    type Target = Context;

    fn deref(&self) -> &Context {
        match self {
            Self::Pool(context) => context,
            Self::One(context) => context,
        }
    }
}

/// The threads for a call.
pub(crate) fn context() -> Result<Threads> {
    POOL.get().map_or_else(|| Context::new(1).map(Threads::One), |pool| Ok(Threads::Pool(pool)))
}

/// Makes a pool of threads for all calls that follow: as many have to call [`azulejo_thread_run`]. Returns whether it succeeded.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_pool(threads: usize) -> i32 {
    let spawn = |run| {
        WAITING.lock().unwrap_or_else(PoisonError::into_inner).push(run);
        Ok(())
    };
    Context::with_threads(threads, spawn).is_ok_and(|pool| POOL.set(pool).is_ok()).into()
}

/// Memory for the stack of a thread and what is local to it, which it keeps; null if the allocation fails.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_thread_memory(bytes: usize, alignment: usize) -> *mut u8 {
    match Layout::from_size_align(bytes, alignment) {
        // SAFETY: the layout is not empty.
        Ok(layout) if bytes > 0 => unsafe { alloc(layout) },
        _ => std::ptr::null_mut(),
    }
}

/// The work of a thread of the pool. It does not return: the pool is never dropped, and threads end with their workers.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_thread_run() {
    let run = WAITING.lock().unwrap_or_else(PoisonError::into_inner).pop();
    if let Some(run) = run {
        run();
    }
}
