//! Work that is shared, watched and cancelled.

use crate::job::*;
use std::cell::{Cell, RefCell};
use std::thread::{self, ThreadId};

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
fn too_many_threads_are_refused() {
    assert!(matches!(Context::new(5000), Err(Error::InvalidArgument { argument: "num_threads", .. })));
}
