//! Sets of the plane that follow the density of an image.

use azulejo::dcr::{DelaunayOptions, Density, relax_with_density, scatter};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;
use crate::relax::relaxation;

/// Random points with the density of an image.
///
/// # Safety
/// `values` is valid for reads of `value_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_scatter(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    count: u32,
    seed: u64,
    values: *const f32,
    value_count: usize,
    width: usize,
    height: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let values = unsafe { rows(values, value_count) };
    call(|context, progress| {
        let (domain, image) = (domain(min_x, min_y, max_x, max_y, bounded), Density::Image { values, width, height });
        Ok(Answer::default().and(scatter(context, &domain, &image, count as usize, seed, progress)?))
    })
}

/// The relaxed points, and the numbers of `azulejo_dcr_relax`.
///
/// # Safety
/// The pointers are valid for reads of so many numbers and points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_density(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 2],
    count: usize,
    values: *const f32,
    value_count: usize,
    width: usize,
    height: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (points, values) = unsafe { (rows(points, count), rows(values, value_count)) };
    call(|context, progress| {
        let options = DelaunayOptions::new(domain(min_x, min_y, max_x, max_y, bounded))
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let image = Density::Image { values, width, height };
        let (relaxed, report) = relax_with_density(context, &options, &image, points, progress)?;
        Ok(Answer::default().and(relaxed).and(relaxation(&report)))
    })
}
