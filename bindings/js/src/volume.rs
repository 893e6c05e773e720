//! Sets of cuboids, and their relaxation.

use azulejo::dcr::volume as dcr;
use azulejo::volume::{Amount, ClassesOptions, Options, sample, sample_classes};
use azulejo::{Boundary, Classes, Domain};

use crate::analysis::Cuboid;
use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::{given, order};

/// The options of a set, as JavaScript lays them out.
#[repr(C)]
pub struct VolumeOptions {
    radius: f64,
    count: f64,
    min: [f64; 3],
    max: [f64; 3],
    bounded: f64,
    progressive: f64,
    quotient: f64,
    leaf_size: f64,
}

/// The samples, their ranks, the radius and a bound of the covering radius.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample(
    options: &VolumeOptions,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    let &VolumeOptions { radius, count, min, max, bounded, progressive, quotient, leaf_size } = options;
    call(|context, progress| {
        let boundary = if bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
        let amount = if count > 0.0 { Amount::Count(count as usize) } else { Amount::Radius(radius) };
        let options = Options::of(amount)
            .domain(Domain { min, max, boundary })
            .seed(seed)
            .order(order((progressive != 0.0).into()))
            .quotient(quotient)
            .given(given)
            .leaf_size(leaf_size);
        let (samples, report) = sample(context, &options, progress)?;
        let report = vec![report.radius, report.covering_radius];
        Ok(Answer::default().and(samples.positions).and(samples.ranks).and(report))
    })
}

/// The samples of several classes, and the class of each.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample_classes(
    cuboid: &Cuboid,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    radii: *const f64,
    radius_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (given, radii) = unsafe { (given(positions, count, clearances, clearance_count), rows(radii, radius_count)) };
    call(|context, progress| {
        let classes = Classes::new(radii.len().isqrt(), radii)?;
        let options = ClassesOptions::default().domain(cuboid.domain()).seed(seed).given(given);
        let samples = sample_classes(context, &options, &classes, progress)?;
        Ok(Answer::default().and(samples.positions).and(samples.classes))
    })
}

/// The relaxed points; the number of iterations, the reason for stopping, motion, smallest distance and rho.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax(
    cuboid: &Cuboid,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let options = dcr::Options::new(cuboid.domain()).max_iterations(max_iterations).tolerance(tolerance).seed(seed);
        let (relaxed, report) = dcr::relax(context, &options, points, progress)?;
        Ok(relaxation(relaxed, &report))
    })
}

/// Relaxed points and their report.
pub fn relaxation(relaxed: Vec<[f32; 3]>, report: &dcr::Report) -> Answer {
    let &dcr::Report { motion, smallest_distance, rho, .. } = report;
    let numbers = vec![report.iterations.into(), f64::from(report.stopped as u8), motion, smallest_distance, rho];
    Answer::default().and(relaxed).and(numbers)
}
