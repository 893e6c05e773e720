//! Maximal Poisson-disk sampling of a rectangle by a flat quadtree: unbiased, and the reference for everything else.
//!
//! Every accepted dart is uniform on the part of the domain that the samples before it leave uncovered, until none is
//! left: random sequential placement, run to completion. It makes about 0.6966 samples per r².
//!
//! Source: Ebeida et al. 2012 (see `plane/quadtree.rs`). Departures: all arithmetic is exact on the integer lattice of
//! the floats (see `plane/lattice.rs`), and a round throws its darts and prunes by them *before* it refines.

use crate::error::Result;
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::plane::{CellAxis, CellGrid, Disk, Lattice, Quadtree};
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, Rng};
use crate::setters::setters;

/// The most bytes of address space that a cell takes while it is sampled: its sample, its voxels of two levels, and their
/// copies while arrays grow.
const BYTES_PER_CELL: f64 = 100.0;

/// The options of a maximal set.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate. It may exceed the domain: one sample is the result.
    pub radius: f64,
    /// The domain to sample: any rectangle, even one thinner than the radius. On a torus whose period is below the
    /// radius a sample does not conflict with its own image.
    pub domain: Domain,
    /// The same options and seed give the same samples.
    pub seed: u64,
}

impl Options {
    /// This radius on the unit torus, with seed 0.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), seed: 0 }
    }
}

setters!(Options { radius: f64, domain: Domain, seed: u64 });

/// A maximal Poisson-disk set of a rectangle, unbiased.
///
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance. On a torus
///   they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 3 float spacings at the domain's
///   largest coordinate.
/// * `domain.min <= x < domain.max`; the order is by rows about 0.7 `radius` high.
///
/// O(n) for n samples: about a million samples a second on one thread, less where they exceed the caches; the samples
/// are the same for every number of threads. [`crate::kdrt`] is the fast sampler.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a radius or domain out of range or floats too coarse
/// for the radius, [`Error::TooLarge`](crate::Error::TooLarge) above 2^32 samples or the available memory, both before
/// any work; [`Error::Cancelled`](crate::Error::Cancelled).
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Points<2>> {
    let lattice = Lattice::new(&options.domain, options.radius)?;
    context.run(progress, |job| sample_lattice(job, &lattice, options.seed)).map(Points::from)
}

/// [`sample`] on a given lattice.
pub(crate) fn sample_lattice(job: &Job, lattice: &Lattice, seed: u64) -> Result<Vec<[f32; 2]>> {
    sample_lattice_around(job, lattice, seed, Vec::new())
}

/// [`sample_lattice`] around disks.
pub(crate) fn sample_lattice_around(
    job: &Job,
    lattice: &Lattice,
    seed: u64,
    disks: Vec<Disk>,
) -> Result<Vec<[f32; 2]>> {
    let samples = sample_points_around(job, lattice, seed, disks)?;
    Ok(samples.into_iter().map(|sample| lattice.position(sample)).collect())
}

/// The samples of [`sample`] as lattice points.
pub(crate) fn sample_points(job: &Job, lattice: &Lattice, seed: u64) -> Result<Vec<[i32; 2]>> {
    sample_points_around(job, lattice, seed, Vec::new())
}

/// [`sample_points`] around disks.
pub(crate) fn sample_points_around(job: &Job, lattice: &Lattice, seed: u64, disks: Vec<Disk>) -> Result<Vec<[i32; 2]>> {
    let rect = lattice.rect();
    let axes = lattice.size.map(|size| CellAxis::new(size, lattice.radius));
    let [columns, rows] = [0, 1].map(|axis: usize| axes[axis].count());
    let cells = f64::from(columns) * f64::from(rows);
    let expected = lattice.expected_samples();
    memory::require(cells * BYTES_PER_CELL, "radius", &format!("about {expected:.0} samples"))?;

    let mut grid = match lattice.boundary {
        Boundary::Periodic => CellGrid::torus(&axes, lattice.separation),
        Boundary::Bounded => CellGrid::new(&axes, &rect, lattice.separation),
    };
    grid.set_obstacles(disks);
    let mut quadtree = Quadtree::of_all(&job.part(0.0, 0.01), &grid)?;
    let mut rng = Rng::at(seed, Draw::Darts, &[]);
    quadtree.fill_domain(&job.part(0.01, 1.0), &mut grid, &mut rng, expected, |_| ())?;
    #[cfg(test)]
    grid.sanity_check();
    Ok(grid.samples_in(&rect).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A domain of few floats, in which every lattice point can be tested.
    #[test]
    fn every_lattice_point_is_covered_and_no_two_samples_conflict() {
        let spacing = f64::from(f32::EPSILON);
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (extent, radius) in [([500.0, 400.0], 64.0), ([300.0, 30.0], 70.7), ([50.0, 60.0], 99.0)] {
                for seed in 0..20 {
                    let domain = Domain { min: [1.0; 2], max: extent.map(|x: f64| 1.0 + x * spacing), boundary };
                    let lattice = Lattice::new(&domain, radius * spacing).unwrap();
                    assert_eq!(lattice.size.map(f64::from), extent);
                    let context = Context::new(1).unwrap();
                    let samples = context.run(None, |job| sample_points(job, &lattice, seed)).unwrap();
                    let nearest = |[x, y]: [i32; 2]| {
                        let distance = |sample: &[i32; 2]| {
                            let [dx, dy] = [(x - sample[0]).abs(), (y - sample[1]).abs()];
                            match boundary {
                                Boundary::Periodic => [dx.min(lattice.size[0] - dx), dy.min(lattice.size[1] - dy)],
                                Boundary::Bounded => [dx, dy],
                            }
                        };
                        let squares = samples.iter().map(distance).map(|[dx, dy]| i64::from(dx * dx + dy * dy));
                        squares.filter(|&d2| d2 > 0 || !samples.contains(&[x, y])).min().unwrap_or(i64::MAX)
                    };
                    for (y, x) in (0..lattice.size[1]).flat_map(|y| (0..lattice.size[0]).map(move |x| (y, x))) {
                        let conflicts = nearest([x, y]) < lattice.separation.threshold;
                        assert_eq!(conflicts, !samples.contains(&[x, y]), "at {x}, {y}");
                    }
                }
            }
        }
    }
}
