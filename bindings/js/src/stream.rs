//! Planes that are passed on part by part.

use azulejo::kdrt::Plane;

use crate::answer::{Answer, call};
use crate::given;
use crate::plane::PlaneOptions;
use crate::watch::{part, visit};

/// The share of the progress that the plane takes.
const PATTERN_SHARE: f64 = 0.05;

/// Passes the samples to JavaScript, part by part; the answer is empty.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_stream(
    options: &PlaneOptions,
    seed: u64,
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|context, progress| {
        let options = options.by_radius(seed, given);
        let plane = Plane::new(context, &options, Some(&part(progress, 0.0, PATTERN_SHARE)))?;
        plane.stream(context, visit, Some(&part(progress, PATTERN_SHARE, 1.0)))?;
        Ok(Answer::default())
    })
}
