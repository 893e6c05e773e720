//! Radial distribution function g(r) of a set, also called pair correlation: the density of other points at a distance r
//! from a point, over the mean density (Illian et al. 2008, "Statistical Analysis and Modelling of
//! Spatial Point Patterns", ch. 4; Heck et al. 2013, "Blue noise sampling with controlled aliasing").
//!
//! 1 at every distance for a Poisson process. The unit of all distances here is `d_max`, that of neighbours in the densest
//! packing of as many points. In the plane that is a hexagonal lattice, with peaks at 1, sqrt(3), 2, ... and `d_max =
//! sqrt(2 A / (sqrt(3) N))`; in space the face-centred one, with peaks at 1, sqrt(2), sqrt(3), 2, ... and `d_max = cbrt(sqrt(2)
//! V / N)`.
//!
//! *Boundaries.* On a torus the distances wrap. In a bounded domain a pair counts by one over the share of the domain
//! that stays in it when it is moved by their difference (Ohser and Stoyan 1981, "On the second-order analysis of
//! stationary point processes"), which is unbiased. That share is exact: the product of those of the sides.

use std::f64::consts::PI;

use crate::check;
use crate::error::{Error, Result};
use crate::index::{Entry, SortedGrid};
use crate::job::{Context, Progress, chunks_of};
use crate::math::side;
use crate::memory;
use crate::points::{Boundary, Domain};

/// The largest number of bins.
pub const MAX_BINS: usize = 1 << 16;

/// The side of a cell of the search, in mean spacings: larger ones hold more points that are too far away, smaller ones
/// take longer to walk through.
const CELL: f64 = 1.5;

/// The most bytes per point, in the plane and in space.
const BYTES_PER_POINT: [f64; 2] = [30.0, 38.0];

/// The pairs of a set, or of several, by their distance.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialDistribution {
    reach: f64,
    /// The pairs in each bin, counted from both ends, and the number that a Poisson process would have.
    found: Vec<f64>,
    expected: Vec<f64>,
}

/// The radial distribution function of `points` in `bins` bins of equal width from 0 to `reach`, in units of `d_max`.
///
/// Takes O(points · (1 + reach²)) for points that are spread about evenly: there are 3.6 reach² pairs for each.
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid domain, for points outside it and for fewer than two (`positions`), for `bins`
/// outside of 1 to [`MAX_BINS`], and for a `reach` that is not above 0, so small that a bin has no area in `f64`, or above
/// half the width or height of the domain;
/// [`Error::TooLarge`] for more points than memory holds;
/// [`Error::Cancelled`].
pub fn radial_distribution(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    reach: f64,
    bins: usize,
    progress: Option<&Progress>,
) -> Result<RadialDistribution> {
    let unit = domain.hexagonal_distance(points.len());
    count_pairs(context, domain, points, Bins { unit, reach, count: bins, ring: |k| PI * (2 * k + 1) as f64 }, progress)
}

/// The radial distribution function of `points` of a cuboid in `bins` bins of equal width from 0 to `reach`, in units of
/// `d_max`, that of neighbours in the densest packing.
///
/// Takes O(points · (1 + reach³)) for points that are spread about evenly: there are 5.9 reach³ pairs for each.
///
/// # Errors
/// As [`radial_distribution`]; `reach` is at most half of the shortest side of the domain.
pub fn radial_distribution_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
    reach: f64,
    bins: usize,
    progress: Option<&Progress>,
) -> Result<RadialDistribution> {
    let unit = domain.packed_distance(points.len());
    let shell = |k| 4.0 / 3.0 * PI * (3.0 * k as f64 * (k + 1) as f64 + 1.0);
    count_pairs(context, domain, points, Bins { unit, reach, count: bins, ring: shell }, progress)
}

/// The bins of a distribution.
struct Bins {
    /// `d_max`, a length.
    unit: f64,
    /// Where the last bin ends, in units of `d_max`.
    reach: f64,
    count: usize,
    /// The area of the ring, or the volume of the shell, between `k` and `k + 1` from a point.
    ring: fn(usize) -> f64,
}

fn count_pairs<const D: usize>(
    context: &Context,
    domain: &Domain<D>,
    points: &[[f32; D]],
    Bins { unit, reach, count: bins, ring }: Bins,
    progress: Option<&Progress>,
) -> Result<RadialDistribution> {
    domain.check_set(points)?;
    if points.len() < 2 {
        return Err(Error::invalid("positions", format!("{} points have no distances", points.len())));
    }
    check_bins(reach, bins)?;
    let extent = domain.extent();
    let limit = 0.5 * extent.into_iter().fold(f64::INFINITY, f64::min) / unit;
    if reach > limit {
        let half_of = if D == 2 { "the width or height" } else { "the shortest side" };
        let reason = format!("{reach} is above {limit}, half {half_of} of the domain in units of d_max");
        return Err(Error::invalid("reach", reason));
    }
    let per_length = bins as f64 / (reach * unit);
    let scale: f64 = [per_length; D].into_iter().product();
    let pairs = points.len() as f64 * (points.len() - 1) as f64;
    let expected: Vec<f64> = (0..bins).map(|bin| pairs * (ring(bin) / scale) / domain.content()).collect();
    if !expected[0].is_normal() {
        let content = if D == 2 { "area" } else { "volume" };
        return Err(Error::invalid("reach", format!("{reach} is so small that the first bin has no {content}")));
    }
    let weight = |offset: [f64; D]| match domain.boundary {
        Boundary::Periodic => 1.0,
        Boundary::Bounded => 1.0 / (0..D).map(|axis| 1.0 - offset[axis].abs() / extent[axis]).product::<f64>(),
    };
    memory::require_points("positions", points.len(), BYTES_PER_POINT[D - 2])?;
    let cell = CELL * side::<D>(domain.content() / points.len() as f64);
    let grid = SortedGrid::new(*domain, points.iter().map(|point| point.map(f64::from)), cell);
    // Many bins take time of their own; many points, perhaps, since most may be in one cell.
    let chunks = chunks_of(points.len(), (bins / 8).clamp(256, 2048));
    // Along the cells of the grid, so that points which follow each other meet the same others.
    let count = |chunk: usize| {
        let mut counts = vec![0.0; bins];
        for &Entry { id, point } in &grid.entries()[chunks.range(chunk)] {
            grid.for_each_within(point, reach * unit, |other, offset, squared| {
                let bin = (squared.sqrt() * per_length) as usize;
                if other != id && bin < bins {
                    counts[bin] += weight(offset);
                }
            });
        }
        counts
    };
    let mut found = vec![0.0; bins];
    let add = |counts: Vec<f64>| {
        found.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        Ok(())
    };
    context.run(progress, |job| job.stream(chunks.len(), count, add))?;
    Ok(RadialDistribution { reach, found, expected })
}

/// Refuses invalid bins.
pub(super) fn check_bins(reach: f64, bins: usize) -> Result<()> {
    check::range("bins", bins, 1..=MAX_BINS)?;
    check::positive("reach", reach)
}

impl RadialDistribution {
    /// g(r) of each bin; 1 for a Poisson process.
    pub fn density(&self) -> Vec<f64> {
        std::iter::zip(&self.found, &self.expected).map(|(found, expected)| found / expected).collect()
    }

    /// The pairs that a Poisson process would have in each bin, counted from both ends: its g(r) has a standard
    /// error of about sqrt(2 / expected), since each pair comes twice.
    pub fn expected(&self) -> &[f64] {
        &self.expected
    }

    /// The middle of each bin, in units of `d_max`.
    pub fn distances(&self) -> Vec<f64> {
        let width = self.reach / self.found.len() as f64;
        (0..self.found.len()).map(|bin| (bin as f64 + 0.5) * width).collect()
    }

    /// The mean of sets of one kind, each weighted by its pairs; noise fades with the square root of their number.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no set, and for bins that differ.
    pub fn mean(of: &[Self]) -> Result<Self> {
        let Some((first, others)) = of.split_first() else {
            return Err(Error::invalid("distributions", "there is none"));
        };
        let mut mean = first.clone();
        for other in others {
            if (other.reach, other.found.len()) != (first.reach, first.found.len()) {
                return Err(Error::invalid("distributions", "their bins differ"));
            }
            mean.found.iter_mut().zip(&other.found).for_each(|(sum, count)| *sum += count);
            mean.expected.iter_mut().zip(&other.expected).for_each(|(sum, count)| *sum += count);
        }
        Ok(mean)
    }
}
