//! Data made on first use, and kept with a mesh or a context for the calls that follow.
//!
//! Data are identified by their type, so that their owner need not know who keeps them: with a mesh Embree's scene (psp),
//! with a context the patterns of planes and that of local projectors.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, ThreadId};
use std::time::Duration;

use crate::error::Result;
use crate::host::process_id;

/// The interval at which a thread that waits for another one's work asks whether to go on.
const INTERVAL: Duration = Duration::from_millis(20);

/// Values of different types, each made once.
#[derive(Debug, Default)]
pub struct Kept {
    slots: Mutex<HashMap<TypeId, Slot>>,
    /// Signalled when one of them was made, or failed to be.
    changed: Condvar,
}

// A panic while something is made leaves its slot empty.
impl UnwindSafe for Kept {}
impl RefUnwindSafe for Kept {}

#[derive(Debug)]
enum Slot {
    /// The process and the thread that make it: in a forked process the thread does not exist.
    BeingMade(u32, ThreadId),
    Made(Arc<dyn Any + Send + Sync>),
}

impl Kept {
    /// The value that was made before, or is made now. A thread that has to wait while another one makes it asks `wait`
    /// now and then whether to go on.
    ///
    /// A thread of a rayon pool, the caller's or another, does not wait but makes a value of its own: the one that makes it may
    /// be waiting for tasks of its pool, of which this one is doing one.
    ///
    /// # Errors
    /// Those of `make`, after which the next call makes it, and of `wait`.
    pub fn get<T: Any + Send + Sync>(
        &self,
        mut wait: impl FnMut() -> Result<()>,
        make: impl FnOnce() -> Result<T>,
    ) -> Result<Arc<T>> {
        let (process, thread, kind) = (process_id(), thread::current().id(), TypeId::of::<T>());
        let is_worker = rayon::current_thread_index().is_some();
        let mut slots = self.slots();
        loop {
            match slots.get(&kind) {
                Some(Slot::Made(thing)) => return Ok(thing.clone().downcast().expect("a slot has things of its type")),
                // Asked for by a callback of the making, this cannot wait for itself; nor may a worker wait.
                Some(&Slot::BeingMade(its, by)) if its == process && (by == thread || is_worker) => {
                    drop(slots);
                    return make().map(Arc::new);
                }
                Some(&Slot::BeingMade(its, _)) if its == process => {
                    drop(self.changed.wait_timeout(slots, INTERVAL).unwrap_or_else(PoisonError::into_inner));
                    wait()?;
                    slots = self.slots();
                }
                _ => break,
            }
        }
        slots.insert(kind, Slot::BeingMade(process, thread));
        drop(slots);
        let making = Making { kept: self, kind };
        let thing = Arc::new(make()?);
        self.slots().insert(kind, Slot::Made(thing.clone()));
        drop(making);
        Ok(thing)
    }

    fn slots(&self) -> MutexGuard<'_, HashMap<TypeId, Slot>> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Ends the making of something, successful or not.
struct Making<'a> {
    kept: &'a Kept,
    kind: TypeId,
}

impl Drop for Making<'_> {
    fn drop(&mut self) {
        let mut slots = self.kept.slots();
        if let Some(Slot::BeingMade(..)) = slots.get(&self.kind) {
            slots.remove(&self.kind);
        }
        self.kept.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::error::Error;

    fn go_on() -> Result<()> {
        Ok(())
    }

    #[test]
    fn a_thing_is_made_once_whoever_asks() {
        let (kept, made, barrier) = (Kept::default(), AtomicUsize::new(0), Barrier::new(4));
        let ask = || {
            barrier.wait();
            let make = || {
                thread::sleep(Duration::from_millis(50));
                Ok(made.fetch_add(1, Ordering::Relaxed))
            };
            *kept.get(go_on, make).unwrap()
        };
        thread::scope(|scope| {
            let threads = [(); 4].map(|()| scope.spawn(ask));
            threads.into_iter().for_each(|thread| assert_eq!(thread.join().unwrap(), 0));
        });
        assert_eq!(made.into_inner(), 1);
        assert_eq!(*kept.get(go_on, || Ok("of another type")).unwrap(), "of another type");
        assert_eq!(*kept.get::<usize>(go_on, || unreachable!()).unwrap(), 0);
    }

    #[test]
    fn what_fails_is_made_by_the_next_call() {
        let kept = Kept::default();
        assert!(matches!(kept.get::<u8>(go_on, || Err(Error::Cancelled)), Err(Error::Cancelled)));
        assert!(catch_unwind(AssertUnwindSafe(|| kept.get::<u8>(go_on, || panic!("on purpose")))).is_err());
        assert_eq!(*kept.get(go_on, || Ok(7u8)).unwrap(), 7);
    }

    #[test]
    fn a_call_within_the_making_does_not_wait_for_itself() {
        let kept = Kept::default();
        let inner = || kept.get(|| panic!("waits"), || Ok(1u8)).map(|thing| *thing + 1);
        assert_eq!(*kept.get(go_on, inner).unwrap(), 2);
        assert_eq!(*kept.get::<u8>(go_on, || unreachable!()).unwrap(), 2);
    }

    #[test]
    fn a_worker_of_a_pool_does_not_wait_for_another_thread() {
        let (kept, begun, over) = (Kept::default(), Barrier::new(2), Barrier::new(2));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        thread::scope(|scope| {
            let maker = scope.spawn(|| {
                let make = || {
                    begun.wait();
                    over.wait();
                    Ok(1u8)
                };
                *kept.get(go_on, make).unwrap()
            });
            begun.wait();
            assert_eq!(*pool.install(|| kept.get(|| panic!("waits"), || Ok(2u8))).unwrap(), 2);
            over.wait();
            assert_eq!(maker.join().unwrap(), 1);
        });
        assert_eq!(*pool.install(|| kept.get::<u8>(go_on, || unreachable!())).unwrap(), 1);
    }

    #[test]
    fn waiting_can_be_cancelled_and_what_has_failed_elsewhere_is_made_here() {
        let (kept, begun, over) = (Kept::default(), Barrier::new(3), Barrier::new(2));
        thread::scope(|scope| {
            let maker = scope.spawn(|| {
                kept.get::<u8>(go_on, || {
                    begun.wait();
                    over.wait();
                    Err(Error::Cancelled)
                })
            });
            let patient = scope.spawn(|| {
                begun.wait();
                *kept.get(go_on, || Ok(3u8)).unwrap()
            });
            begun.wait();
            assert!(matches!(kept.get(|| Err(Error::Forked), || Ok(4u8)), Err(Error::Forked)));
            over.wait();
            assert!(maker.join().unwrap().is_err());
            assert_eq!(patient.join().unwrap(), 3);
        });
    }
}
