//! Measurements of sets.

use azulejo::analysis::coverage::{
    coverage_2d, coverage_3d, covering_radius_2d, surface_coverage, surface_covering_radius, surface_uncovered_fraction,
};
use azulejo::analysis::distribution::{radial_distribution, radial_distribution_3d};
use azulejo::analysis::figures::{Figures, figures_2d};
use azulejo::analysis::space::figures_3d;
use azulejo::analysis::spacing::{
    nearest_distances_2d, nearest_histogram_2d, smallest_distance_2d, smallest_distance_3d, spacing_2d,
};
use azulejo::{Boundary, Domain};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;
use crate::mesh::Handle;
use crate::watch::part;

/// The figures of a set of the plane: number, smallest and mean distance, hexagonal distance, covering radius, bond order, and
/// those of its Delaunay triangles.
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
    call(|context, progress| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        let figures = figures_2d(context, &domain, points, progress)?;
        let Figures { nearest, covering_radius, bond_order, triangles, .. } = figures;
        let spacing = spacing_2d(&domain, &nearest);
        Ok(Answer::default().and(vec![
            nearest.len() as f64,
            spacing.smallest,
            spacing.mean,
            spacing.hexagonal,
            covering_radius,
            bond_order,
            triangles.triangles as f64,
            triangles.obtuse,
            triangles.below_30_degrees,
            triangles.angles_below_30_degrees,
            triangles.edge_mean,
            triangles.edge_variation,
            triangles.area_variation,
            triangles.beyond_4_sigma,
        ]))
    })
}

/// The smallest distance of a set of the plane, or its covering radius.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_distance(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    points: *const [f32; 2],
    count: usize,
    is_covering: i32,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        let distance = match is_covering {
            0 => smallest_distance_2d(context, &domain, points, progress)?,
            _ => covering_radius_2d(context, &domain, points, progress)?,
        };
        Ok(Answer::default().and(vec![distance]))
    })
}

/// The histogram of the distances of the points of a set of the plane to their nearest neighbours.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_nearest_histogram(
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
    call(|context, progress| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        // Bad bins are refused before any work.
        nearest_histogram_2d(&domain, &[], reach, bins)?;
        let nearest = nearest_distances_2d(context, &domain, points, progress)?;
        let histogram = nearest_histogram_2d(&domain, &nearest, reach, bins)?;
        // No memory of 32 bits holds more points.
        Ok(Answer::default().and(histogram.into_iter().map(|count| count as u32).collect::<Vec<u32>>()))
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

/// The number of points of a set of a cuboid, the smallest distance, the mean of nearest neighbours, the distance in the densest
/// packing, rho, the covering radius and the relative one; the number of pairs nearer than a radius, and of the gaps of that
/// radius, which are none for 0.
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
    call(|context, progress| {
        let domain = cuboid.domain();
        let end = if radius == 0.0 { 1.0 } else { 0.5 };
        let figures = figures_3d(context, &domain, points, radius, Some(&part(progress, 0.0, end)))?;
        let gaps = match radius {
            0.0 => 0,
            _ => coverage_3d(context, &domain, points, radius, Some(&part(progress, end, 1.0)))?.gaps,
        };
        Ok(Answer::default().and(vec![
            figures.count as f64,
            figures.smallest,
            figures.mean,
            figures.packed,
            figures.rho(),
            figures.covering_radius,
            figures.relative_covering_radius(),
            figures.conflicts as f64,
            gaps as f64,
        ]))
    })
}

/// The radial distribution function of a set of a cuboid.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_radial_distribution(
    cuboid: &Cuboid,
    reach: f64,
    bins: usize,
    points: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let found = radial_distribution_3d(context, &cuboid.domain(), points, reach, bins, progress)?;
        Ok(Answer::default().and(found.density()))
    })
}

/// The covering radius of a set of a cuboid, and its gaps for a radius.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_coverage(
    cuboid: &Cuboid,
    radius: f64,
    points: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let found = coverage_3d(context, &cuboid.domain(), points, radius, progress)?;
        Ok(Answer::default().and(vec![found.farthest, found.gaps as f64]))
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
    call(|context, progress| {
        let smallest = smallest_distance_3d(context, positions, Some(&part(progress, 0.0, 0.1)))?;
        let rest = part(progress, 0.1, 1.0);
        Ok(Answer::default().and(vec![smallest, surface_covering_radius(context, &mesh.0, positions, Some(&rest))?]))
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
    call(|context, progress| {
        let found = coverage_2d(context, &domain(min_x, min_y, max_x, max_y, bounded), points, radius, progress)?;
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
    call(|context, progress| {
        let found = surface_coverage(context, &mesh.0, positions, radius, progress)?;
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
    call(|context, progress| Ok(Answer::default().and(vec![smallest_distance_3d(context, positions, progress)?])))
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
    call(|context, progress| {
        let share = surface_uncovered_fraction(context, &mesh.0, positions, radius, probes, seed, progress)?;
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
    call(|context, progress| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        Ok(Answer::default().and(radial_distribution(context, &domain, points, reach, bins, progress)?.density()))
    })
}
