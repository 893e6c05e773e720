//! A job: the threads that a long call runs on, its progress callback and its cancellation.
//!
//! All parallel code of the crate goes through [`Job::map`]: tasks that share nothing, results in the order of the
//! tasks. That is what makes every result independent of the number of threads.

use std::any::Any;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::io;
use std::mem::ManuallyDrop;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::host::process_id;
use crate::kept::Kept;
use crate::memory;

/// The polling interval of progress, on the calling thread.
const REPORT_INTERVAL: Duration = Duration::from_millis(20);

/// The number of results of [`Job::stream`] that each thread makes while those before them are visited.
const TASKS_AHEAD: usize = 4;

/// Called on the thread that made the call, with the fraction that is done, which grows from 0 to 1; `Break` cancels.
pub type Progress<'a> = dyn Fn(f64) -> ControlFlow<()> + 'a;

/// The threads of the library: a rayon pool of its own, never the global one.
///
/// With one thread no threads are started and all work happens in the caller's. Can be shared freely between threads.
/// Keeps patterns once a call has made them: the four that planes had last (see [`crate::kdrt`]), 0.9 MB each at most,
/// and one of 160 kB for meshes.
///
/// A process that is forked has none of the threads: a context with threads refuses to work there.
#[derive(Debug)]
pub struct Context {
    /// Taken by `drop` only.
    pool: Option<ManuallyDrop<rayon::ThreadPool>>,
    /// The process that the threads are in.
    process: u32,
    kept: Kept,
}

impl Context {
    /// A context with `num_threads` threads, or one per core for 0.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] above 4096 threads, [`Error::Threads`] if they cannot be started.
    pub fn new(num_threads: usize) -> Result<Self> {
        let mut started = 0;
        Self::with_threads(num_threads, |run| {
            let builder = thread::Builder::new().name(format!("azulejo-{started}"));
            started += 1;
            builder.spawn(run).map(drop)
        })
    }

    /// [`Context::new`], but `spawn` starts the threads: it is called once for each, on this thread, with what the new thread
    /// has to run, which returns after the context was dropped. For programs whose threads need other properties than the
    /// standard library gives them, or where it starts none, as on WebAssembly. Calls wait until the threads have come.
    ///
    /// # Errors
    /// As those of [`Context::new`]; [`Error::Threads`] if `spawn` fails.
    pub fn with_threads(
        num_threads: usize,
        mut spawn: impl FnMut(Box<dyn FnOnce() + Send>) -> io::Result<()>,
    ) -> Result<Self> {
        if num_threads > 4096 {
            return Err(Error::invalid("num_threads", format!("{num_threads} is above 4096")));
        }
        let threads = match num_threads {
            0 => thread::available_parallelism().map_or(1, usize::from),
            n => n,
        };
        let (process, kept) = (process_id(), Kept::default());
        if threads == 1 {
            return Ok(Self { pool: None, process, kept });
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|thread| spawn(Box::new(move || thread.run())))
            .build()
            .map_err(|error| Error::Threads { threads, reason: error.to_string() })?;
        if memory::has_address_limit() {
            // The first allocation of a thread reserves address space of its own. It must be there before memory is
            // asked for.
            pool.broadcast(|_| drop(std::hint::black_box(Box::new(0u8))));
        }
        Ok(Self { pool: Some(ManuallyDrop::new(pool)), process, kept })
    }

    /// The number of threads that work on a call.
    pub fn num_threads(&self) -> usize {
        self.pool.as_ref().map_or(1, |pool| pool.current_num_threads())
    }

    /// Runs a call to its end and reports the last `1.0`.
    pub(crate) fn run<T>(&self, progress: Option<&Progress>, call: impl FnOnce(&Job) -> Result<T>) -> Result<T> {
        if self.pool.is_some() && self.was_left_behind() {
            return Err(Error::Forked);
        }
        let job = Job { context: self, progress, from: 0.0, to: 1.0 };
        job.report(0.0)?;
        let result = call(&job)?;
        job.report(1.0)?;
        Ok(result)
    }

    /// True if the process was forked since, and the threads are in another one.
    fn was_left_behind(&self) -> bool {
        self.process != process_id()
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // A thread that does not exist in a forked process may hold a lock for ever; the pool's memory is left alone.
        if let Some(pool) = self.pool.take()
            && !self.was_left_behind()
        {
            drop(ManuallyDrop::into_inner(pool));
        }
    }
}

/// A range of items cut into the tasks of [`Job::map`]: many items each, the same for any number of threads.
#[derive(Clone, Copy)]
pub(crate) struct Chunks {
    items: usize,
    size: usize,
}

/// Cuts `0..items` into chunks of the usual size.
pub(crate) fn chunks(items: usize) -> Chunks {
    chunks_of(items, 2048)
}

/// Cuts `0..items` into chunks of `size` items.
pub(crate) fn chunks_of(items: usize, size: usize) -> Chunks {
    Chunks { items, size }
}

impl Chunks {
    /// The number of chunks.
    pub(crate) fn len(self) -> usize {
        self.items.div_ceil(self.size)
    }

    /// The most items of a chunk.
    pub(crate) fn size(self) -> usize {
        self.size
    }

    /// The items of one chunk.
    pub(crate) fn range(self, chunk: usize) -> std::ops::Range<usize> {
        let start = chunk * self.size;
        start..(start + self.size).min(self.items)
    }
}

/// A call in progress, or a part of one.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    context: &'a Context,
    progress: Option<&'a Progress<'a>>,
    from: f64,
    to: f64,
}

impl<'a> Job<'a> {
    /// The part of this job that lies between two shares of it. Parts follow each other; they do not overlap.
    pub(crate) fn part(&self, from: f64, to: f64) -> Job<'a> {
        Job { from: self.done(from), to: self.done(to), ..*self }
    }

    /// The share of the whole job that is done when `share` of this part is: no more than its end, whatever the rounding.
    fn done(&self, share: f64) -> f64 {
        (self.from + (self.to - self.from) * share).min(self.to)
    }

    /// The threads that the job runs on.
    pub(crate) fn context(&self) -> &'a Context {
        self.context
    }

    /// A value that the context keeps for all calls, made by `make` if it is not there yet. It must depend on nothing but its
    /// type.
    pub(crate) fn kept<T: Any + Send + Sync>(&self, make: impl FnOnce() -> Result<T>) -> Result<Arc<T>> {
        self.context.kept.get(|| self.report(0.0), make)
    }

    /// Reports to the caller that `share` of this part is done.
    pub(crate) fn report(&self, share: f64) -> Result<()> {
        let Some(progress) = self.progress else { return Ok(()) };
        match progress(self.done(share)) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Error::Cancelled),
        }
    }

    /// `[task(0), .., task(count - 1)]`, in parallel; the order of the result never depends on the threads.
    pub(crate) fn map<T: Send>(&self, count: usize, task: impl Fn(usize) -> T + Sync) -> Result<Vec<T>> {
        self.map_each((0..count).collect(), task)
    }

    /// [`Job::map`] over any items, such as the parts of memory that the tasks write in place, one each.
    pub(crate) fn map_each<I: Send, T: Send>(&self, items: Vec<I>, task: impl Fn(I) -> T + Sync) -> Result<Vec<T>> {
        // Each task finds its item and leaves its result in a slot of its own, so that the code that calls the pool is
        // compiled once and not for each type.
        let slots: Vec<_> = items.into_iter().map(|item| Mutex::new((Some(item), None))).collect();
        self.run_all(slots.len(), &|i| {
            let mut slot = slots[i].lock().unwrap_or_else(PoisonError::into_inner);
            slot.1 = slot.0.take().map(&task);
        })?;
        let result = |slot: Mutex<(Option<I>, Option<T>)>| slot.into_inner().unwrap_or_else(PoisonError::into_inner).1;
        Ok(slots.into_iter().map(|slot| result(slot).expect("every task has run")).collect())
    }

    /// The pool, if there are several tasks: one that sleeps takes longer to wake than a small task.
    fn pool_for(&self, count: usize) -> Option<&'a rayon::ThreadPool> {
        self.context.pool.as_deref().filter(|_| count > 1)
    }

    /// Runs `task(0), .., task(count - 1)`, each once, in any order and in parallel.
    fn run_all(&self, count: usize, task: &(dyn Fn(usize) + Sync)) -> Result<()> {
        let share = |finished: usize| finished as f64 / count.max(1) as f64;
        match (self.pool_for(count), self.progress) {
            (None, _) => (0..count).try_for_each(|i| {
                task(i);
                self.report(share(i + 1))
            }),
            (Some(pool), None) => {
                pool.install(|| (0..count).into_par_iter().for_each(task));
                Ok(())
            }
            (Some(pool), Some(_)) => self.run_watched(pool, count, &share, task),
        }
    }

    /// The tasks run on the pool while the calling thread reports how many are finished.
    fn run_watched(
        &self,
        pool: &rayon::ThreadPool,
        count: usize,
        share: &dyn Fn(usize) -> f64,
        task: &(dyn Fn(usize) + Sync),
    ) -> Result<()> {
        let (finished, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
        let watched = |i| {
            if !cancelled.load(Ordering::Relaxed) {
                task(i);
                finished.fetch_add(1, Ordering::Relaxed);
            }
        };
        let mut verdict = Ok(());
        run_behind(pool, count, &watched, &mut |end| {
            while !end.is_reached_soon() {
                if verdict.is_ok() {
                    verdict = self.report(share(finished.load(Ordering::Relaxed)));
                    cancelled.store(verdict.is_err(), Ordering::Relaxed);
                }
            }
            Ok(())
        })?;
        verdict?;
        self.report(1.0)
    }

    /// Hands `task(0), .., task(count - 1)` to `visit`, in this order and on the calling thread, while the pool makes
    /// the next ones. Whatever the count, at most 2 · [`TASKS_AHEAD`] results per thread exist at a time.
    pub(crate) fn stream<T: Send>(
        &self,
        count: usize,
        task: impl Fn(usize) -> T + Sync,
        mut visit: impl FnMut(T) -> Result<()>,
    ) -> Result<()> {
        let visited = Cell::new(0);
        let report = || self.report(visited.get() as f64 / count as f64);
        let mut visit = |result| {
            visit(result)?;
            visited.set(visited.get() + 1);
            report()
        };
        let Some(pool) = self.pool_for(count) else {
            return (0..count).try_for_each(|i| visit(task(i)));
        };
        let size = TASKS_AHEAD * pool.current_num_threads();
        let mut waiting = Vec::new();
        // One round more than there are batches: the first has nothing to visit yet, the last nothing to make.
        for start in (0..count + size).step_by(size) {
            let batch = (start + size).min(count).saturating_sub(start);
            let slots: Vec<Mutex<Option<T>>> = (0..batch).map(|_| Mutex::new(None)).collect();
            let fill = |i: usize| {
                let result = task(start + i);
                *slots[i].lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
            };
            run_behind(pool, batch, &fill, &mut |end| {
                std::mem::take(&mut waiting).into_iter().try_for_each(&mut visit)?;
                while !end.is_reached_soon() {
                    report()?;
                }
                Ok(())
            })?;
            let result = |slot: Mutex<Option<T>>| slot.into_inner().unwrap_or_else(PoisonError::into_inner);
            waiting = slots.into_iter().map(|slot| result(slot).expect("every task has run")).collect();
        }
        Ok(())
    }

    /// [`Job::map`] for tasks that give any number of results each, concatenated in the order of the tasks.
    pub(crate) fn flat_map<T: Send>(&self, count: usize, task: impl Fn(usize) -> Vec<T> + Sync) -> Result<Vec<T>> {
        let parts = self.map(count, task)?;
        let mut all = Vec::with_capacity(parts.iter().map(Vec::len).sum());
        parts.into_iter().for_each(|part| all.extend(part));
        Ok(all)
    }

    /// [`Job::flat_map`] where there are so many results that the copy takes time, and the first use of memory as much:
    /// one thread copies each part while it is in the cache, several share the copy.
    pub(crate) fn concat<T: Copy + Default + Send + Sync>(
        &self,
        count: usize,
        task: impl Fn(usize) -> Vec<T> + Sync,
    ) -> Result<Vec<T>> {
        if self.pool_for(count).is_none() {
            let mut all = Vec::new();
            self.stream(count, task, |part| {
                all.extend_from_slice(&part);
                Ok(())
            })?;
            return Ok(all);
        }
        let parts = self.map(count, task)?;
        let mut all = vec![T::default(); parts.iter().map(Vec::len).sum()];
        let (mut rest, mut places) = (all.as_mut_slice(), Vec::with_capacity(parts.len()));
        for part in parts {
            let (place, behind) = rest.split_at_mut(part.len());
            places.push((place, part));
            rest = behind;
        }
        // The copies are no share of the call.
        let silent = Job { progress: None, ..*self };
        silent.map_each(places, |(place, part)| place.copy_from_slice(&part))?;
        Ok(all)
    }

    /// [`Job::concat`] where there will be about `expected` results: they are put in their place while others are made,
    /// so that memory holds them once, and no part waits for all of them. More or fewer than expected cost a copy or
    /// memory that is never touched.
    pub(crate) fn concat_about<T: Copy + Default + Send + Sync>(
        &self,
        expected: usize,
        count: usize,
        task: impl Fn(usize) -> Vec<T> + Sync,
    ) -> Result<Vec<T>> {
        // Memory that is zero comes from the operating system page by page, when it is first used.
        let mut all = vec![T::default(); expected];
        let placing = Placing::new(&mut all);
        // The pool takes its items from many places at once; tasks that are numbered in turn end about in order.
        let turn = AtomicUsize::new(0);
        self.map(count, |_| {
            let i = turn.fetch_add(1, Ordering::Relaxed);
            placing.put(i, task(i));
        })?;
        let (left, beyond) = placing.finish();
        all.truncate(expected - left);
        beyond.into_iter().for_each(|part| all.extend(part));
        all.shrink_to_fit();
        Ok(all)
    }
}

/// Runs `task(0), .., task(count - 1)` on the pool, behind `meanwhile`, which the calling thread runs and which can wait for
/// their end. Returns when both have ended.
fn run_behind(
    pool: &rayon::ThreadPool,
    count: usize,
    task: &(dyn Fn(usize) + Sync),
    meanwhile: &mut dyn FnMut(&End) -> Result<()>,
) -> Result<()> {
    let end = End::default();
    pool.in_place_scope(|scope| {
        scope.spawn(|_| {
            let _running = Running(&end);
            (0..count).into_par_iter().for_each(task);
        });
        meanwhile(&end)
    })
}

/// The end of tasks on the pool, by their return or by a panic, for which the calling thread waits. A condition variable knows
/// it without a clock, which a channel with a timeout asks for and WebAssembly has not.
#[derive(Default)]
struct End {
    is_reached: Mutex<bool>,
    changed: Condvar,
}

impl End {
    /// True if the end is reached. Waits for it, but no longer than about the interval of progress.
    pub fn is_reached_soon(&self) -> bool {
        let is_reached = self.is_reached.lock().unwrap_or_else(PoisonError::into_inner);
        *is_reached || *self.changed.wait_timeout(is_reached, REPORT_INTERVAL).unwrap_or_else(PoisonError::into_inner).0
    }
}

/// Held by the tasks until they end.
struct Running<'a>(&'a End);

impl Drop for Running<'_> {
    fn drop(&mut self) {
        *self.0.is_reached.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.0.changed.notify_one();
    }
}

/// The vector that the parts become, while they are made.
struct Placing<'a, T>(Mutex<State<'a, T>>);

struct State<'a, T> {
    /// The unused rest of the vector's memory.
    free: &'a mut [T],
    /// The number of parts that have a place.
    placed: usize,
    /// Parts that were made before their turn.
    early: BTreeMap<usize, Vec<T>>,
    /// The parts from the first one on that the memory was too short for.
    beyond: Vec<Vec<T>>,
}

impl<'a, T: Copy> Placing<'a, T> {
    /// No parts yet, and memory for them.
    pub fn new(memory: &'a mut [T]) -> Self {
        Self(Mutex::new(State { free: memory, placed: 0, early: BTreeMap::new(), beyond: Vec::new() }))
    }

    /// Puts a part in its place, or keeps it until those before it have one. The copy happens outside of the lock, by
    /// the thread that has the part in its cache: so the page faults of new memory are shared as well.
    pub fn put(&self, index: usize, part: Vec<T>) {
        // A panic in another thread ends the call; parts that are placed after it do not matter.
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.early.insert(index, part);
        let mut ready = Vec::new();
        while let Some((place, part)) = state.next() {
            ready.push((place, part));
        }
        drop(state);
        ready.into_iter().for_each(|(place, part)| place.copy_from_slice(&part));
    }

    /// The length of the unused memory, and the parts that found no place in it.
    pub fn finish(self) -> (usize, Vec<Vec<T>>) {
        let state = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        (state.free.len(), state.beyond)
    }
}

impl<'a, T> State<'a, T> {
    /// The part whose turn it is, if it is made, and its place.
    fn next(&mut self) -> Option<(&'a mut [T], Vec<T>)> {
        loop {
            let part = self.early.remove(&self.placed)?;
            self.placed += 1;
            if self.beyond.is_empty() && part.len() <= self.free.len() {
                let (place, free) = std::mem::take(&mut self.free).split_at_mut(part.len());
                self.free = free;
                return Some((place, part));
            }
            self.beyond.push(part);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::thread::ThreadId;

    use super::*;

    fn squares(context: &Context, progress: Option<&Progress>) -> Result<Vec<usize>> {
        context.run(progress, |job| {
            let first = job.part(0.0, 0.5).map(100, |i| i * i)?;
            let second = job.part(0.5, 1.0).flat_map(100, |i| {
                thread::sleep(Duration::from_millis(1));
                vec![i * i; i % 3]
            })?;
            Ok(first.into_iter().chain(second).collect())
        })
    }

    #[test]
    fn results_do_not_depend_on_the_threads() {
        let expected = squares(&Context::new(1).unwrap(), None).unwrap();
        for threads in [2, 3, 8] {
            let context = Context::new(threads).unwrap();
            assert_eq!(context.num_threads(), threads);
            assert_eq!(squares(&context, None).unwrap(), expected);
            assert_eq!(squares(&context, Some(&|_| ControlFlow::Continue(()))).unwrap(), expected);
        }
    }

    /// The first parts take the longest, so that others come before their turn.
    #[test]
    fn no_part_ends_after_the_next_begins() {
        let latest = Cell::new(0.0);
        let progress = |done: f64| {
            assert!(done >= latest.replace(done));
            ControlFlow::Continue(())
        };
        let all = |job: &Job| {
            // 0.03 + (0.29 - 0.03) is above 0.29.
            for [from, to] in [[0.0, 0.03], [0.03, 0.29], [0.29, 1.0]] {
                let part = job.part(from, to);
                part.report(0.0)?;
                part.report(1.0)?;
            }
            Ok(())
        };
        Context::new(1).unwrap().run(Some(&progress), all).unwrap();
    }

    #[test]
    fn parts_are_put_in_order_whatever_is_expected_of_them() {
        let part = |i: usize| {
            thread::sleep(Duration::from_micros(if i.is_multiple_of(8) { 500 } else { 10 }));
            (0..i % 5).map(|j| 1 + 10 * i + j).collect::<Vec<_>>()
        };
        let expected: Vec<_> = (0..50).flat_map(part).collect();
        for threads in [1, 2, 5] {
            let context = Context::new(threads).unwrap();
            for about in [0, 1, 30, expected.len() - 1, expected.len(), 500] {
                for progress in [None, Some(&(|_| ControlFlow::Continue(())) as &Progress)] {
                    let found = context.run(progress, |job| job.concat_about(about, 50, part)).unwrap();
                    assert_eq!(found, expected, "{threads} threads, {about} expected");
                }
            }
            assert!(context.run(None, |job| job.concat_about(9, 0, part)).unwrap().is_empty());
        }
    }

    #[test]
    fn progress_is_told_on_the_calling_thread_and_grows_from_zero_to_one() {
        for threads in [1, 3] {
            let told: RefCell<Vec<(f64, ThreadId)>> = RefCell::default();
            let progress = |share| {
                told.borrow_mut().push((share, thread::current().id()));
                ControlFlow::Continue(())
            };
            squares(&Context::new(threads).unwrap(), Some(&progress)).unwrap();
            let told = told.into_inner();
            assert!(told.iter().all(|&(_, id)| id == thread::current().id()));
            assert!(told.windows(2).all(|pair| pair[0].0 <= pair[1].0));
            assert_eq!((told[0].0, told[told.len() - 1].0), (0.0, 1.0));
        }
    }

    #[test]
    fn a_call_can_be_cancelled_at_its_start_in_its_middle_and_at_its_end() {
        for threads in [1, 3] {
            for limit in [0.0, 0.4, 0.8, 1.0] {
                let stopped = Cell::new(false);
                let progress = |share| {
                    assert!(!stopped.get(), "called after it was cancelled");
                    stopped.set(share >= limit);
                    if stopped.get() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                };
                let result = squares(&Context::new(threads).unwrap(), Some(&progress));
                assert!(matches!(result, Err(Error::Cancelled)), "{threads} threads, limit {limit}");
            }
        }
    }

    #[test]
    fn a_stream_is_visited_in_order_on_the_calling_thread_and_never_far_behind() {
        for threads in [1, 3] {
            let context = Context::new(threads).unwrap();
            for count in [0, 1, 11, 12, 13, 100] {
                let (made, mut visited) = (AtomicUsize::new(0), 0);
                let (caller, told) = (thread::current().id(), Cell::new(0.0));
                let progress = |share| {
                    assert!(share >= told.replace(share) && thread::current().id() == caller);
                    ControlFlow::Continue(())
                };
                let task = |i| {
                    made.fetch_add(1, Ordering::Relaxed);
                    i
                };
                let visit = |i| {
                    assert!(i == visited && thread::current().id() == caller);
                    assert!(made.load(Ordering::Relaxed) - visited <= 2 * TASKS_AHEAD * threads);
                    visited += 1;
                    Ok(())
                };
                context.run(Some(&progress), |job| job.stream(count, task, visit)).unwrap();
                assert_eq!((visited, told.get()), (count, 1.0));
            }
        }
    }

    #[test]
    fn a_stream_ends_where_a_visit_fails_or_panics() {
        for threads in [1, 3] {
            let context = Context::new(threads).unwrap();
            for last in [0, 40, 99] {
                let mut seen = 0;
                let failing = |i| {
                    seen += 1;
                    if i == last { Err(Error::Cancelled) } else { Ok(()) }
                };
                let result = context.run(None, |job| job.stream(100, |i| i, failing));
                assert!(matches!(result, Err(Error::Cancelled)) && seen == last + 1);
                let panicking = |i| if i == last { panic!("on purpose") } else { Ok(()) };
                let panicking = || context.run(None, |job| job.stream(100, |i| i, panicking));
                assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(panicking)).is_err());
            }
        }
    }

    #[test]
    fn a_panic_in_a_task_reaches_the_caller() {
        for progress in [None, Some(&(|_| ControlFlow::Continue(())) as &Progress)] {
            let context = Context::new(2).unwrap();
            let call = || context.run(progress, |job| job.map(10, |i| assert_ne!(i, 5)));
            assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(call)).is_err());
        }
    }

    #[test]
    fn the_threads_are_those_of_the_caller() {
        let expected = squares(&Context::new(1).unwrap(), None).unwrap();
        let mut waiting = Vec::new();
        let context = Context::with_threads(3, |run| {
            waiting.push(run);
            Ok(())
        });
        let threads: Vec<_> = waiting.into_iter().map(thread::spawn).collect();
        assert_eq!(threads.len(), 3);
        assert_eq!(squares(context.as_ref().unwrap(), Some(&|_| ControlFlow::Continue(()))).unwrap(), expected);
        drop(context);
        threads.into_iter().for_each(|thread| thread.join().unwrap());
        let refused = Context::with_threads(2, |_| Err(io::Error::other("on purpose")));
        assert!(matches!(refused, Err(Error::Threads { threads: 2, reason }) if reason.contains("on purpose")));
        assert_eq!(Context::with_threads(1, |_| unreachable!()).unwrap().num_threads(), 1);
    }

    #[test]
    fn too_many_threads_are_refused() {
        assert!(matches!(Context::new(5000), Err(Error::InvalidArgument { argument: "num_threads", .. })));
    }
}
