//! Statistics of sets of the plane: spacing, order, triangles and distances; and of cuboids.

use azulejo_core::Domain;
use azulejo_core::analysis::distribution::{radial_distribution, radial_distribution_3d};
use azulejo_core::analysis::figures::{Figures, figures_2d};
use azulejo_core::analysis::space::{SpaceFigures, figures_3d};
use azulejo_core::analysis::spacing::{nearest_distances_2d, nearest_histogram_2d, spacing_2d};

use crate::boundary::{self, check_pointer};
use crate::context::azulejo_context;
use crate::domain::{PlaneSet, SpaceSet, azulejo_plane_set, azulejo_space_set};
use crate::growing::{self, Growing, Output, growing};
use crate::status::{Failure, azulejo_status};

/// The result of azulejo_plane_measure. Distances between points are infinite for fewer than two.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_plane_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The number of points.
    pub count: u64,
    /// The smallest distance between two points.
    pub smallest_distance: f64,
    /// The mean distance from a point to its nearest neighbour.
    pub mean_distance: f64,
    /// d_max; infinite for no point.
    pub hexagonal_distance: f64,
    /// The smallest distance in units of d_max: about 0.77 for maximal sets, at most 1 on a torus.
    pub rho: f64,
    /// The covering radius: d_max / sqrt(3) for a hexagonal lattice; infinite for no point.
    pub covering_radius: f64,
    /// The bond order psi6: the mean over the points of |sum of exp(6 i angle)| / n for the n
    /// directions of Delaunay neighbours (Nelson, Halperin 1979). 1 in a lattice, 0.36 at random.
    pub bond_order: f64,
    /// The number of Delaunay triangles; in a bounded domain without those across its edges.
    pub triangles: u64,
    /// The fraction of triangles with an angle above 90 degrees.
    pub obtuse: f64,
    /// The fraction of triangles with an angle below 30 degrees.
    pub below_30_degrees: f64,
    /// The mean length of the triangles' edges.
    pub edge_mean: f64,
    /// The variance of the edges' lengths over their squared mean.
    pub edge_variation: f64,
    /// The variance of the triangles' areas over their squared mean.
    pub area_variation: f64,
    /// The fraction of all angles that are below 30 degrees.
    pub angles_below_30_degrees: f64,
    /// The fraction of triangles whose area is farther than 4 standard deviations from the mean.
    pub beyond_4_sigma: f64,
}

growing!(azulejo_plane_report requires count {
    reserved: 0,
    count: 0,
    smallest_distance: 0.0,
    mean_distance: 0.0,
    hexagonal_distance: 0.0,
    rho: 0.0,
    covering_radius: 0.0,
    bond_order: 0.0,
    triangles: 0,
    obtuse: 0.0,
    below_30_degrees: 0.0,
    edge_mean: 0.0,
    edge_variation: 0.0,
    area_variation: 0.0,
    angles_below_30_degrees: 0.0,
    beyond_4_sigma: 0.0,
});

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_report_init(
    report: *mut azulejo_plane_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Measures points of the plane: spacing, cover, bonds, Delaunay triangles. O(count * log count).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_measure(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    out: *mut azulejo_plane_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (out, set) = unsafe { (Output::required("out", out)?, PlaneSet::read(context, set)?) };
        let count = set.points.len() as u64;
        out.write(set.run(|context, domain, points, progress| {
            Ok(report(count, domain, &figures_2d(context, domain, points, progress)?))
        })?);
        Ok(())
    })
}

fn report(count: u64, domain: &Domain, figures: &Figures) -> azulejo_plane_report {
    let Figures { nearest, covering_radius, bond_order, triangles, .. } = figures;
    let spacing = spacing_2d(domain, nearest);
    azulejo_plane_report {
        count,
        smallest_distance: spacing.smallest,
        mean_distance: spacing.mean,
        hexagonal_distance: spacing.hexagonal,
        rho: if count == 0 { f64::INFINITY } else { spacing.smallest / spacing.hexagonal },
        covering_radius: *covering_radius,
        bond_order: *bond_order,
        triangles: triangles.triangles,
        obtuse: triangles.obtuse,
        below_30_degrees: triangles.below_30_degrees,
        edge_mean: triangles.edge_mean,
        edge_variation: triangles.edge_variation,
        area_variation: triangles.area_variation,
        angles_below_30_degrees: triangles.angles_below_30_degrees,
        beyond_4_sigma: triangles.beyond_4_sigma,
        ..azulejo_plane_report::DEFAULT
    }
}

/// The result of azulejo_space_measure. Distances between points are infinite for fewer than two.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_space_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The number of points.
    pub count: u64,
    /// The smallest distance between two points.
    pub smallest_distance: f64,
    /// The mean distance from a point to its nearest neighbour.
    pub mean_distance: f64,
    /// The number of pairs of points that are nearer to each other than `radius`.
    pub conflicts: u64,
    /// cbrt(sqrt(2) * volume / count), that of neighbours in the densest packing.
    pub packed_distance: f64,
    /// The same in units of packed_distance: about 0.80 for maximal sets, at most 1 on a torus.
    pub rho: f64,
    /// The covering radius, too small by less than a billionth of it; infinite for no point.
    pub covering_radius: f64,
    /// The same in units of packed_distance: 0.71 for the densest packing, 0.63 for the
    /// body-centred cubic lattice, which covers best.
    pub relative_covering_radius: f64,
}

growing!(azulejo_space_report requires count {
    reserved: 0,
    count: 0,
    smallest_distance: 0.0,
    mean_distance: 0.0,
    conflicts: 0,
    packed_distance: 0.0,
    rho: 0.0,
    covering_radius: 0.0,
    relative_covering_radius: 0.0,
});

impl From<SpaceFigures> for azulejo_space_report {
    fn from(figures: SpaceFigures) -> Self {
        Self {
            count: figures.count as u64,
            smallest_distance: figures.smallest,
            mean_distance: figures.mean,
            conflicts: figures.conflicts,
            packed_distance: figures.packed,
            rho: figures.rho(),
            covering_radius: figures.covering_radius,
            relative_covering_radius: figures.relative_covering_radius(),
            ..Self::DEFAULT
        }
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_report_init(
    report: *mut azulejo_space_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Measures points of a cuboid: spacing, conflicts, cover. O(count * log count + conflicts).
///
/// radius: pairs of points that are nearer are conflicts; 0 counts none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_measure(
    context: *const azulejo_context,
    set: *const azulejo_space_set,
    radius: f64,
    out: *mut azulejo_space_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (out, set) = unsafe { (Output::required("out", out)?, SpaceSet::read(context, set)?) };
        out.write(set.run(|context, domain, points, progress| figures_3d(context, domain, points, radius, progress))?);
        Ok(())
    })
}

/// The histogram of the distances from points of the plane to their nearest neighbours. Histograms
/// of several sets may be added. O(count) time.
///
/// reach: where the last bin ends, above 0, in units of d_max.
///
/// bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers: how many points have their nearest neighbour at such a
/// distance. Distances of `reach` and more, and a single point, are in no bin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_nearest_histogram(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    reach: f64,
    bins: usize,
    out: *mut u64,
) -> azulejo_status {
    boundary::call(|| {
        check_bins(out, bins)?;
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        let histogram = set.run(|context, domain, points, progress| {
            // Bad bins are refused before any work.
            nearest_histogram_2d(domain, &[], reach, bins)?;
            let nearest = nearest_distances_2d(context, domain, points, progress)?;
            nearest_histogram_2d(domain, &nearest, reach, bins)
        })?;
        // SAFETY: one number for each of the caller's bins.
        unsafe { boundary::write(out, &histogram) };
        Ok(())
    })
}

/// The radial distribution function g of points of the plane, also called pair correlation: the
/// density of other points at a distance from a point, over the mean density. 1 for a Poisson
/// process; a hexagonal lattice has peaks at 1, sqrt(3), 2, ... d_max. In a bounded domain pairs
/// are weighted to correct for the edges (Ohser and Stoyan 1981). O(count * (1 + reach^2)) time.
///
/// set: the points, at least 2.
///
/// reach: where the last bin ends, in units of d_max: above 0, at most half of either side.
///
/// bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers: the mean of g in each bin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_radial_distribution(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    reach: f64,
    bins: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        check_bins(out, bins)?;
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        let distribution = set.run(|context, domain, points, progress| {
            radial_distribution(context, domain, points, reach, bins, progress)
        })?;
        // SAFETY: one number for each of the caller's bins.
        unsafe { boundary::write(out, &distribution.density()) };
        Ok(())
    })
}

/// The radial distribution function of points of a cuboid, in units of packed_distance, of which
/// `reach` is at most half of the shortest side. O(count * (1 + reach^3)) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_radial_distribution(
    context: *const azulejo_context,
    set: *const azulejo_space_set,
    reach: f64,
    bins: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        check_bins(out, bins)?;
        // SAFETY: handed on from the caller.
        let set = unsafe { SpaceSet::read(context, set) }?;
        let distribution = set.run(|context, domain, points, progress| {
            radial_distribution_3d(context, domain, points, reach, bins, progress)
        })?;
        // SAFETY: one number for each of the caller's bins.
        unsafe { boundary::write(out, &distribution.density()) };
        Ok(())
    })
}

/// The caller's array, one element for each bin; no bins at all are refused as such.
fn check_bins<T>(out: *mut T, bins: usize) -> Result<(), Failure> {
    if bins > 0 { check_pointer("out", out.cast_const()) } else { Ok(()) }
}
