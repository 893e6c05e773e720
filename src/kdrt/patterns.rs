//! Patterns that a context keeps.
//!
//! Calls for parts of one domain, and for domains of one seed and radius, have the same pattern, which takes as long to
//! make as tens of thousands of samples. A context keeps those made last.

use std::sync::{Arc, Mutex, PoisonError};

use crate::error::Result;
use crate::job::Job;

/// The number of patterns of a kind that a context keeps: of 0.9 MB each in the plane and 7 MB in space, as larger ones are
/// not kept.
pub const PATTERNS: usize = 4;

/// All that a pattern depends on: its lattice is the integers, and its separation follows from the radius.
#[derive(Clone, Copy, PartialEq)]
pub struct Key {
    side: i32,
    radius: u64,
    seed: u64,
}

impl Key {
    /// The key of a pattern whose side and radius are in lattice units.
    pub fn new(side: i32, radius: f64, seed: u64) -> Self {
        Self { side, radius: radius.to_bits(), seed }
    }
}

/// Patterns with their keys, from the one that was used last to the one that was not for longest.
pub struct Patterns<P>(Mutex<Vec<(Key, Arc<P>)>>);

impl<P: Send + Sync + 'static> Patterns<P> {
    /// The pattern of a key that the context keeps, or a new one, which is kept if it is small.
    pub fn kept(job: &Job, key: Key, is_small: bool, make: impl FnOnce() -> Result<P>) -> Result<Arc<P>> {
        let patterns = job.kept(|| Ok(Self(Mutex::default())))?;
        if let Some(pattern) = patterns.find(key) {
            return Ok(pattern);
        }
        // Two calls at once may both make it: none waits for another.
        let pattern = Arc::new(make()?);
        if is_small {
            patterns.keep(key, &pattern);
        }
        Ok(pattern)
    }

    fn find(&self, key: Key) -> Option<Arc<P>> {
        let mut patterns = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let index = patterns.iter().position(|(of, _)| *of == key)?;
        patterns[..=index].rotate_right(1);
        Some(patterns[0].1.clone())
    }

    fn keep(&self, key: Key, pattern: &Arc<P>) {
        let mut patterns = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        patterns.retain(|(of, _)| *of != key);
        patterns.truncate(PATTERNS - 1);
        patterns.insert(0, (key, pattern.clone()));
    }
}
