//! Thinning of clouds.

use azulejo::thin::{Options, thin};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::order;

/// Indices of the selected points, and their ranks.
///
/// # Safety
/// `positions` is valid for reads of `count` points of `dimensions` numbers each, 2 or 3.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_thin(
    positions: *const f32,
    count: usize,
    dimensions: u32,
    radius: f64,
    most: u32,
    progressive: i32,
    seed: u64,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count * dimensions as usize) };
    call(|context, progress| {
        let options = Options::by_radius(radius).count(most as usize).order(order(progressive)).seed(seed);
        let selection = match dimensions {
            2 => thin(context, &options, positions.as_chunks::<2>().0, progress)?,
            _ => thin(context, &options, positions.as_chunks::<3>().0, progress)?,
        };
        Ok(Answer::default().and(selection.indices).and(selection.ranks))
    })
}
