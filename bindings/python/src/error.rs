//! Errors of the library as Python's.

use azulejo_core::Error;
use pyo3::exceptions::{PyMemoryError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

pyo3::create_exception!(azulejo, Cancelled, pyo3::exceptions::PyException, "The progress callable returned False.");

/// Messages name the argument, its value and its range.
pub(crate) fn raised(error: Error) -> PyErr {
    match error {
        Error::InvalidArgument { .. } | Error::Format { .. } => PyValueError::new_err(error.to_string()),
        Error::TooLarge { .. } => PyMemoryError::new_err(error.to_string()),
        Error::Cancelled => Cancelled::new_err("the progress callable returned False"),
        // With a number OSError makes itself the class that goes with it, such as FileNotFoundError.
        Error::Io { path, source } => match source.raw_os_error() {
            Some(number) => {
                // The library's text repeats the number.
                let text = source.to_string();
                let text = text.split(" (os error").next().unwrap_or_default().to_owned();
                PyOSError::new_err((number, text, path.display().to_string()))
            }
            None => PyOSError::new_err(format!("{}: {source}", path.display())),
        },
        other => PyRuntimeError::new_err(other.to_string()),
    }
}

/// [`raised`] for a call in which an argument of the library has another name.
pub(crate) fn raised_as(error: Error, from: &str, to: &'static str) -> PyErr {
    raised(match error {
        Error::InvalidArgument { argument, reason } if argument == from => {
            Error::InvalidArgument { argument: to, reason }
        }
        other => other,
    })
}

pub(crate) fn invalid(argument: &str, reason: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(format!("{argument}: {reason}"))
}
