//! Measurements of sets.

use azulejo::analysis::coverage::{
    coverage_2d, coverage_3d, covering_radius_2d, surface_coverage, surface_covering_radius, surface_uncovered_fraction,
};
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::space::figures_3d;
use azulejo::analysis::spacing::{smallest_distance_2d, smallest_distance_3d};
use azulejo::analysis::spectrum::periodogram;
use azulejo::{Boundary, Domain};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;
use crate::surface::Handle;

/// The smallest distance and the covering radius of a set of the plane.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_measure(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    points: *const [f32; 2],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        let smallest = smallest_distance_2d(context, &domain, points, None)?;
        Ok(Answer::default().and(vec![smallest, covering_radius_2d(context, &domain, points, None)?]))
    })
}

/// The corners of a cuboid, from the caller's numbers.
#[repr(C)]
pub struct Cuboid {
    min: [f64; 3],
    max: [f64; 3],
    bounded: f64,
}

impl Cuboid {
    pub(crate) fn domain(&self) -> Domain<3> {
        let boundary = if self.bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
        Domain { min: self.min, max: self.max, boundary }
    }
}

/// The smallest distance, the mean of nearest neighbours, rho and the covering radius of a set of a cuboid; the number of pairs
/// nearer than a radius, and of the gaps of that radius, which are none for 0.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_measure(
    cuboid: &Cuboid,
    radius: f64,
    points: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let domain = cuboid.domain();
        let figures = figures_3d(context, &domain, points, radius, None)?;
        let gaps = if radius == 0.0 { 0 } else { coverage_3d(context, &domain, points, radius, None)?.gaps };
        Ok(Answer::default().and(vec![
            figures.smallest,
            figures.mean,
            figures.rho(),
            figures.covering_radius,
            figures.conflicts as f64,
            gaps as f64,
        ]))
    })
}

/// The smallest straight distance and the covering radius of positions on a mesh.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_measure(mesh: &Handle, positions: *const [f32; 3], count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|context| {
        let smallest = smallest_distance_3d(context, positions, None)?;
        Ok(Answer::default().and(vec![smallest, surface_covering_radius(context, &mesh.0, positions, None)?]))
    })
}

/// The covering radius of a set of the plane, and its gaps for a radius.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_coverage(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    radius: f64,
    points: *const [f32; 2],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let found = coverage_2d(context, &domain(min_x, min_y, max_x, max_y, bounded), points, radius, None)?;
        Ok(Answer::default().and(vec![found.farthest, found.gaps as f64]))
    })
}

/// The covering radius of positions on a mesh, and their gaps for a radius.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_coverage(
    mesh: &Handle,
    radius: f64,
    positions: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|context| {
        let found = surface_coverage(context, &mesh.0, positions, radius, None)?;
        Ok(Answer::default().and(vec![found.farthest, found.gaps as f64]))
    })
}

/// The smallest straight distance of positions in space.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_smallest_distance(positions: *const [f32; 3], count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|context| Ok(Answer::default().and(vec![smallest_distance_3d(context, positions, None)?])))
}

/// The share of a mesh that is farther than `radius` from positions, by random probes.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_uncovered_fraction(
    mesh: &Handle,
    radius: f64,
    probes: u64,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|context| {
        let share = surface_uncovered_fraction(context, &mesh.0, positions, radius, probes, seed, None)?;
        Ok(Answer::default().and(vec![share]))
    })
}

/// The radial distribution function of a set of the plane.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_radial_distribution(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    points: *const [f32; 2],
    count: usize,
    reach: f64,
    bins: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        Ok(Answer::default().and(radial_distribution(context, &domain, points, reach, bins, None)?.density()))
    })
}

/// The power of each frequency; the frequency, power, anisotropy and number of frequencies of each annulus.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    points: *const [f32; 2],
    count: usize,
    size: usize,
    width: f64,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        let spectrum = periodogram(context, &domain, points, size, None)?;
        let annuli = spectrum.radial(width)?;
        let annuli = annuli.iter().flat_map(|ring| [ring.frequency, ring.power, ring.anisotropy, ring.count as f64]);
        Ok(Answer::default().and(spectrum.power().to_vec()).and(annuli.collect::<Vec<f64>>()))
    })
}
