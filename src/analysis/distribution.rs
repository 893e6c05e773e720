//! Radial distribution function g(r) of a set in the plane, also called pair correlation: the density of other points
//! at a distance r from a point, over the mean density (Illian et al. 2008, "Statistical Analysis and Modelling of
//! Spatial Point Patterns", ch. 4; Heck et al. 2013, "Blue noise sampling with controlled aliasing").
//!
//! 1 at every distance for a Poisson process. A hexagonal lattice has peaks at 1, sqrt(3), 2, ... in units of
//! `d_max = sqrt(2 A / (sqrt(3) N))`, the distance of its neighbours, which is the unit of all distances here.
//!
//! *Boundaries.* On a torus the distances wrap. In a bounded domain a pair counts by one over the share of the domain
//! that stays in it when it is moved by their difference (Ohser and Stoyan 1981, "On the second-order analysis of
//! stationary point processes"), which is unbiased.

use std::f64::consts::PI;

use crate::check;
use crate::error::{Error, Result};
use crate::index::{Entry, Grid2};
use crate::job::{Context, Progress, chunks_of};
use crate::points::{Boundary, Domain};

/// The largest number of bins.
pub const MAX_BINS: usize = 1 << 16;

/// The side of a cell of the search, in mean spacings: larger ones hold more points that are too far away, smaller ones
/// take longer to walk through.
const CELL: f64 = 1.5;

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
/// half the width or height of the domain; [`Error::Cancelled`].
pub fn radial_distribution(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    reach: f64,
    bins: usize,
    progress: Option<&Progress>,
) -> Result<RadialDistribution> {
    domain.check_set(points)?;
    if points.len() < 2 {
        return Err(Error::invalid("positions", format!("{} points have no distances", points.len())));
    }
    check_bins(reach, bins)?;
    let unit = domain.hexagonal_distance(points.len());
    let [width, height] = domain.extent();
    let limit = 0.5 * width.min(height) / unit;
    if reach > limit {
        let reason = format!("{reach} is above {limit}, half the width or height of the domain in units of d_max");
        return Err(Error::invalid("reach", reason));
    }
    let per_length = bins as f64 / (reach * unit);
    let ring = |bin: usize| PI * (2 * bin + 1) as f64 / (per_length * per_length);
    let pairs = points.len() as f64 * (points.len() - 1) as f64;
    let expected: Vec<f64> = (0..bins).map(|bin| pairs * ring(bin) / domain.area()).collect();
    if !expected[0].is_normal() {
        return Err(Error::invalid("reach", format!("{reach} is so small that the first bin has no area")));
    }
    let weight = |[x, y]: [f64; 2]| match domain.boundary {
        Boundary::Periodic => 1.0,
        Boundary::Bounded => 1.0 / ((1.0 - x.abs() / width) * (1.0 - y.abs() / height)),
    };
    let cell = CELL * (domain.area() / points.len() as f64).sqrt();
    let grid = Grid2::new(*domain, points.iter().map(|point| point.map(f64::from)), cell);
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
