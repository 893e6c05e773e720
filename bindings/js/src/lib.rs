//! azulejo for JavaScript: the functions that `index.js` calls, one call at a time.
//!
//! Arguments are numbers, and arrays in memory that [`memory::azulejo_take`] allocated. Every call returns whether it
//! succeeded; its results, or the text of its error, are read from the arrays of its [`answer`].

mod analysis;
mod answer;
mod density;
mod edit;
mod inside;
mod mask;
mod memory;
mod merge;
mod mesh;
mod plane;
mod relax;
mod spectrum;
mod stream;
mod surface;
mod surface_varying;
mod thin;
mod threads;
mod volume;
mod volume_varying;
mod watch;

use azulejo::{Boundary, Domain, Given, Order};

use crate::memory::rows;

/// The domain of five numbers: the corners of a rectangle, and whether it is bounded.
pub(crate) fn domain(min_x: f64, min_y: f64, max_x: f64, max_y: f64, bounded: i32) -> Domain {
    let boundary = if bounded == 0 { Boundary::Periodic } else { Boundary::Bounded };
    Domain { min: [min_x, min_y], max: [max_x, max_y], boundary }
}

/// The order that a flag selects.
pub(crate) fn order(progressive: i32) -> Order {
    if progressive == 0 { Order::Any } else { Order::Progressive }
}

/// Given samples; without clearances each keeps the radius of the set.
///
/// # Safety
/// As [`rows`] of both.
pub(crate) unsafe fn given<'a, const AXES: usize>(
    positions: *const [f32; AXES],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> Given<'a, AXES> {
    // SAFETY: guaranteed by the caller.
    unsafe { given_of(rows(positions, count), rows(clearances, clearance_count)) }
}

/// [`given`] of arrays.
pub(crate) fn given_of<'a, const AXES: usize>(positions: &'a [[f32; AXES]], clearances: &'a [f64]) -> Given<'a, AXES> {
    if clearances.is_empty() { Given::at(positions) } else { Given::with_clearances(positions, clearances) }
}
