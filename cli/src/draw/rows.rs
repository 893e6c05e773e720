//! The rows of a picture, made by several threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use azulejo::{Error, Progress, Result};

/// `[row(0), .., row(count - 1)]`, each made by one of `num_threads` threads.
pub fn in_parallel<T: Send>(
    num_threads: usize,
    count: usize,
    progress: &Progress,
    row: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>> {
    let next = AtomicUsize::new(0);
    let mut rows: Vec<Option<T>> = (0..count).map(|_| None).collect();
    thread::scope(|scope| {
        let (finished, made) = mpsc::channel();
        for _ in 0..num_threads.min(count) {
            let (finished, next, row) = (finished.clone(), &next, &row);
            scope.spawn(move || {
                let rows = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed)).take_while(|&i| i < count);
                for i in rows {
                    // This fails when the receiver has stopped listening: the rest is not needed.
                    if finished.send((i, row(i))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(finished);
        for (done, (i, row)) in made.into_iter().enumerate() {
            rows[i] = Some(row);
            if progress((done + 1) as f64 / count as f64).is_break() {
                return Err(Error::Cancelled);
            }
        }
        Ok(())
    })?;
    Ok(rows.into_iter().map(|row| row.expect("every row is made, or its thread's panic is passed on")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    #[test]
    fn rows_are_in_order_for_any_number_of_threads() {
        for threads in [1, 3, 100] {
            let rows = in_parallel(threads, 50, &|_| ControlFlow::Continue(()), |i| i * i).unwrap();
            assert_eq!(rows, (0..50).map(|i| i * i).collect::<Vec<_>>());
        }
        assert!(in_parallel(2, 0, &|_| ControlFlow::Continue(()), |i| i).unwrap().is_empty());
    }

    #[test]
    fn stops_when_it_is_cancelled() {
        let stop = |done| if done >= 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        assert!(matches!(in_parallel(2, 10, &stop, |i| i), Err(Error::Cancelled)));
    }
}
