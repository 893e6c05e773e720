//! Long calls: their threads, their progress, and how they are interrupted.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use azulejo_core::{Context, Error, Progress};
use pyo3::prelude::*;

use crate::argument::natural;
use crate::error::{invalid, raised};

/// The arguments `threads` and `progress`.
pub(crate) struct Watch<'py> {
    py: Python<'py>,
    context: Arc<Context>,
    progress: Option<Py<PyAny>>,
}

impl<'py> Watch<'py> {
    pub(crate) fn new(py: Python<'py>, threads: i128, progress: Option<Py<PyAny>>) -> PyResult<Self> {
        Ok(Self { py, context: context(natural("threads", threads)?)?, progress })
    }

    pub(crate) fn py(&self) -> Python<'py> {
        self.py
    }

    /// Makes a call of the library without the interpreter's lock.
    pub(crate) fn run<T: Send>(
        self,
        call: impl FnOnce(&Context, Option<&Progress>) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let Self { py, context, progress } = self;
        let (result, failed) = py.detach(|| {
            let looking = Looking { progress, last: Cell::new(Instant::now()), failed: RefCell::default() };
            let result = call(&context, Some(&|done| looking.look(done)));
            (result, looking.failed.into_inner())
        });
        // Relaxation returns its state when it is cancelled.
        failed.map_or(Ok(()), Err)?;
        result.map_err(raised)
    }
}

/// Makes a short call of the library without the interpreter's lock: one that needs no threads and is not interrupted.
pub(crate) fn unlocked<T: Send>(py: Python<'_>, call: impl FnOnce() -> Result<T, Error> + Send) -> PyResult<T> {
    py.detach(call).map_err(raised)
}

/// The interpreter's lock is taken no more often than this: another thread may take 5 ms to hand it over.
const INTERVAL: Duration = Duration::from_millis(20);

struct Looking {
    progress: Option<Py<PyAny>>,
    last: Cell<Instant>,
    /// The exception of a signal handler or of the callable.
    failed: RefCell<Option<PyErr>>,
}

impl Looking {
    fn look(&self, done: f64) -> ControlFlow<()> {
        let is_end = done == 0.0 || done == 1.0;
        if (is_end && self.progress.is_none()) || (!is_end && self.last.get().elapsed() < INTERVAL) {
            return ControlFlow::Continue(());
        }
        let goes_on = Python::attach(|py| match &self.progress {
            Some(progress) => ask(py, progress, done),
            None => py.check_signals().map(|()| true),
        });
        self.last.set(Instant::now());
        flow(goes_on, &mut self.failed.borrow_mut())
    }
}

/// Asks a callable, after Python's signal handlers, whether to go on. Anything but False does, so that it need not
/// return anything.
pub(crate) fn ask<'py>(py: Python<'py>, callable: &Py<PyAny>, argument: impl IntoPyObject<'py>) -> PyResult<bool> {
    py.check_signals()?;
    let answer = callable.bind(py).call1((argument,))?;
    Ok(answer.extract::<bool>().unwrap_or(true))
}

/// The answer as the library takes it; what was raised is kept.
pub(crate) fn flow(goes_on: PyResult<bool>, failed: &mut Option<PyErr>) -> ControlFlow<()> {
    match goes_on {
        Ok(true) => ControlFlow::Continue(()),
        Ok(false) => ControlFlow::Break(()),
        Err(error) => {
            *failed = Some(error);
            ControlFlow::Break(())
        }
    }
}

/// The context that was used last, with the threads asked for and the process that it was made in.
static LAST: Mutex<Option<(usize, u32, Arc<Context>)>> = Mutex::new(None);

/// A context of so many threads, in this process: a forked one has none of the threads of the other.
///
/// Called with the interpreter's lock, without which Python does not fork: the child does not inherit a mutex that is
/// taken.
fn context(threads: usize) -> PyResult<Arc<Context>> {
    let make = || match Context::new(threads) {
        Err(Error::InvalidArgument { reason, .. }) => Err(invalid("threads", reason)),
        made => made.map(Arc::new).map_err(raised),
    };
    if threads == 1 {
        return make();
    }
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    match &*last {
        Some((number, place, context)) if (*number, *place) == (threads, process) => Ok(context.clone()),
        _ => {
            let context = make()?;
            *last = Some((threads, process, context.clone()));
            Ok(context)
        }
    }
}
