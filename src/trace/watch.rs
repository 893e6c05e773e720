//! Progress and cancelling while Embree builds a scene.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::ptr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, ThreadId};

use embree4_sys::{Embree, RTCScene};

use crate::error::{Error, Result};
use crate::job::Job;

/// Embree calls its monitor on all threads of a build; a job reports on the thread that waits for it, which is one of them.
pub(super) struct Watch<'a> {
    cancelled: AtomicBool,
    caller: ThreadId,
    // The fields below are touched by the caller's thread only.
    job: &'a Job<'a>,
    done: Cell<f64>,
    /// The payload of a panic in the user's callback: it must not unwind through Embree.
    panic: RefCell<Option<Box<dyn Any + Send>>>,
}

impl<'a> Watch<'a> {
    /// A watch for the calling thread.
    pub(super) fn new(job: &'a Job<'a>) -> Self {
        let caller = thread::current().id();
        Self { cancelled: AtomicBool::new(false), caller, job, done: Cell::new(0.0), panic: RefCell::new(None) }
    }

    /// Commits a scene by `commit`, on the calling thread.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the job was; the scene can then only be released.
    pub(super) fn during(&self, embree: &Embree, scene: RTCScene, commit: impl FnOnce()) -> Result<()> {
        let this = ptr::from_ref(self).cast_mut().cast();
        // SAFETY: the scene is alive; it forgets the watch before this function returns.
        unsafe { embree.rtcSetSceneProgressMonitorFunction(scene, Some(tell), this) };
        commit();
        // SAFETY: as above.
        unsafe { embree.rtcSetSceneProgressMonitorFunction(scene, None, ptr::null_mut()) };
        if let Some(panic) = self.panic.take() {
            resume_unwind(panic);
        }
        if self.cancelled.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { Ok(()) }
    }

    fn report(&self, done: f64) {
        // Embree's share may fall between the stages of a build.
        self.done.set(self.done.get().max(done.clamp(0.0, 1.0)));
        let verdict = catch_unwind(AssertUnwindSafe(|| self.job.report(self.done.get())));
        let go_on = matches!(verdict, Ok(Ok(())));
        if let Err(panic) = verdict {
            self.panic.replace(Some(panic));
        }
        if !go_on {
            self.cancelled.store(true, Ordering::Relaxed);
        }
    }
}

/// Embree's monitor: returns whether to go on.
///
/// # Safety
/// `watch` points to a [`Watch`] during the build that it was made for.
unsafe extern "C" fn tell(watch: *mut c_void, done: f64) -> bool {
    let watch = watch.cast::<Watch>().cast_const();
    // SAFETY: by the contract; of what is not `Sync`, nothing is touched but by the thread that it belongs to. The
    // fields are reached one by one, since other threads have no right to a reference to all of them.
    unsafe {
        if thread::current().id() == (*watch).caller && !(*watch).cancelled.load(Ordering::Relaxed) {
            (*watch).report(done);
        }
        !(*watch).cancelled.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::job::{Context, Progress};
    use crate::trace::Ray;
    use crate::trace::scene::Scene;

    /// A staircase of squares.
    fn build(threads: usize, progress: &Progress) -> Result<Scene> {
        let corner = |i: u32| [(i % 2) as f32, (i / 2 % 2) as f32, (i / 4) as f32 * 1e-5];
        let positions: Vec<_> = (0..400_000).map(corner).collect();
        let triangles: Vec<_> =
            (0..100_000).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 3], [4 * i, 4 * i + 3, 4 * i + 2]]).collect();
        Context::new(threads)?
            .run(Some(progress), |job| Scene::build(&job.part(0.2, 0.7), &positions, &triangles, threads))
    }

    #[test]
    fn a_build_is_told_on_the_calling_thread_and_can_be_cancelled() {
        for threads in [1, 3] {
            let told = RefCell::new(Vec::new());
            let scene = build(threads, &|share| {
                told.borrow_mut().push((share, thread::current().id()));
                ControlFlow::Continue(())
            });
            let mut hits = Vec::new();
            scene.unwrap().all_hits(&[Ray { origin: [0.3, 0.6, -1.0], direction: [0.0, 0.0, 1.0] }], &mut hits);
            assert_eq!(hits.len(), 100_000);
            let told = told.into_inner();
            // The number of calls between start and end is Embree's choice; `tests/embree_threads.rs` examines it.
            assert!(told.len() > 1 && told.iter().all(|&(_, id)| id == thread::current().id()));
            assert!(told.windows(2).all(|pair| pair[0].0 <= pair[1].0));
            assert!(told[1..told.len() - 1].iter().all(|&(share, _)| (0.2..=0.7).contains(&share)));

            let stop = |share| if share >= 0.2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
            assert!(matches!(build(threads, &stop), Err(Error::Cancelled)));
        }
    }

    #[test]
    fn what_a_callback_throws_passes_around_embree() {
        let thrown = catch_unwind(|| {
            build(2, &|share| if share > 0.0 { panic!("on purpose") } else { ControlFlow::Continue(()) })
        });
        assert_eq!(thrown.err().unwrap().downcast_ref(), Some(&"on purpose"));
    }
}
