//! The memory of a relaxation.

use crate::error::Result;
use crate::memory;

/// Memory for a point or a sample and all that is known of it, at the peak.
const BYTES_PER_POINT: f64 = 300.0;

/// Refuses more points than memory holds.
pub(in crate::dcr) fn require_memory(argument: &'static str, count: usize) -> Result<()> {
    memory::require(BYTES_PER_POINT * count as f64, argument, &format!("{count} points"))
}
