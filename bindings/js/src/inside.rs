//! Sets of the inside of meshes, and their relaxation.

use azulejo::dcr::volume as dcr;
use azulejo::volume::{Amount, InsideOptions, Surface, sample_inside};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::mesh::Handle;
use crate::volume::relaxation;
use crate::{given, order};

/// The options of a set, as JavaScript lays them out.
#[repr(C)]
pub struct VolumeInsideOptions {
    radius: f64,
    count: f64,
    surface_first: f64,
    tolerance: f64,
    progressive: f64,
    quotient: f64,
    thickness: f64,
}

/// The samples, their ranks, the radius, a bound of the covering radius, the depth and the number of samples of the surface.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample_inside(
    mesh: &Handle,
    options: &VolumeInsideOptions,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    let &VolumeInsideOptions { radius, count, surface_first, tolerance, progressive, quotient, thickness } = options;
    call(|context, progress| {
        let amount = if count > 0.0 { Amount::Count(count as usize) } else { Amount::Radius(radius) };
        let options = InsideOptions::of(amount)
            .surface(if surface_first == 0.0 { Surface::Open } else { Surface::First })
            .tolerance(tolerance)
            .thickness(thickness)
            .seed(seed)
            .order(order((progressive != 0.0).into()))
            .quotient(quotient)
            .given(given);
        let (samples, report) = sample_inside(context, &mesh.0, &options, progress)?;
        let report = vec![report.radius, report.covering_radius, report.depth, report.surface_samples as f64];
        Ok(Answer::default().and(samples.positions).and(samples.ranks).and(report))
    })
}

/// The relaxed points; the number of iterations, the reason for stopping, motion, smallest distance and rho.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax_inside(
    mesh: &Handle,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 3],
    count: usize,
    fixed: *const u8,
    fixed_count: usize,
    sliding: *const u8,
    sliding_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (points, fixed) = unsafe { (rows(points, count), rows(fixed, fixed_count)) };
    // SAFETY: guaranteed by the caller.
    let sliding = unsafe { rows(sliding, sliding_count) };
    call(|context, progress| {
        let [fixed, sliding] = [fixed, sliding].map(|of| of.iter().map(|&entry| entry != 0).collect::<Vec<bool>>());
        let options = dcr::InsideOptions::default().max_iterations(max_iterations).tolerance(tolerance).seed(seed);
        let options = options.fixed(&fixed).sliding(&sliding);
        let (relaxed, report) = dcr::relax_inside(context, &mesh.0, &options, points, progress)?;
        Ok(relaxation(relaxed, &report))
    })
}
