//! The one error type of the library.

use std::path::PathBuf;

/// The result of every fallible call of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// The reason why a call was refused or could not be finished.
///
/// Every message names the argument (or the file) and its value, so that it can be shown to a user as it is.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument is outside its documented range.
    #[error("{argument}: {reason}")]
    InvalidArgument {
        /// The name of the argument, as the caller wrote it.
        argument: &'static str,
        /// Its value and the range that it misses.
        reason: String,
    },
    /// The call would make more samples than can be indexed or held; refused before memory is taken.
    #[error("{argument}: {reason}")]
    TooLarge {
        /// The name of the argument that asks for too much.
        argument: &'static str,
        /// The estimate and the limit.
        reason: String,
    },
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A file was read, but is not what it should be.
    #[error("{}: {reason}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The defect, with its line where the reader knows it.
        reason: String,
    },
    /// A callback of the caller asked to stop.
    #[error("cancelled by the callback")]
    Cancelled,
    /// Embree refused: its library is not there, it has no memory, or it cannot build a scene.
    #[error("Embree: {0}")]
    Embree(String),
    /// The call needs what this build of the library lacks: Embree.
    #[error("{0}")]
    Unsupported(&'static str),
    /// Threads could not be started.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// The number of threads that were asked for.
        threads: usize,
        /// The message of the thread pool.
        reason: String,
    },
    /// The process was forked after the context was made: the threads are in another process.
    #[error("context: its threads are in the process that this one was forked from; make a context after the fork")]
    Forked,
}

impl Error {
    pub(crate) fn invalid(argument: &'static str, reason: impl Into<String>) -> Self {
        Self::InvalidArgument { argument, reason: reason.into() }
    }

    pub(crate) fn too_large(argument: &'static str, reason: impl Into<String>) -> Self {
        Self::TooLarge { argument, reason: reason.into() }
    }
}
