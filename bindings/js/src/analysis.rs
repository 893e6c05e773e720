//! Measurements of sets.

use azulejo::analysis::coverage::{coverage_3d, covering_radius_2d, surface_covering_radius};
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
    let &Cuboid { min, max, bounded } = cuboid;
    call(|context| {
        let boundary = if bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
        let domain = Domain { min, max, boundary };
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
