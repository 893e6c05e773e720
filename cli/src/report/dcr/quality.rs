//! What relaxed sets are like.

use std::time::Instant;

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::spacing::nearest_distances_2d;
use azulejo::analysis::spectrum::periodogram;
use azulejo::analysis::triangles::triangle_statistics;
use azulejo::dcr::relax;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::Effort;
use super::sets::{FIRST_SEED, Method, STARTS, Start};
use crate::report::statistics::Summary;

/// Power below this frequency, in units of sqrt(density), is low.
pub const LOW: f64 = 0.25;

/// The figures of a set. Lengths are in units of `d_max`, the distance of neighbours in the hexagonal arrangement.
#[derive(Clone, Copy)]
pub struct Quality {
    /// The smallest distance, and the mean of the distances to the nearest neighbour.
    pub rho: f64,
    pub mean_distance: f64,
    /// The largest distance of a place from the set.
    pub cover: f64,
    /// The bond order ψ6.
    pub order: f64,
    /// The mean power below [`LOW`].
    pub low_power: f64,
    /// The share of obtuse triangles.
    pub obtuse: f64,
    /// The variance of the edge lengths over their squared mean.
    pub edge_variation: f64,
}

impl Quality {
    /// The figures of points of the unit torus.
    fn of(context: &Context, points: &[[f32; 2]], cover: f64) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let unit = domain.hexagonal_distance(points.len());
        let distances = nearest_distances_2d(context, &domain, points)?;
        let half = (LOW * (points.len() as f64).sqrt()).ceil() as usize;
        let spectrum = periodogram(context, &domain, points, 2 * half + 1, None)?;
        let triangles = triangle_statistics(context, &domain, points)?;
        Ok(Self {
            rho: distances.iter().copied().fold(f64::INFINITY, f64::min) / unit,
            mean_distance: distances.iter().sum::<f64>() / (distances.len() as f64 * unit),
            cover,
            order: bond_order(context, &domain, points)?,
            // The first annulus holds all frequencies below its width but 0.
            low_power: spectrum.radial(LOW)?.first().map_or(0.0, |annulus| annulus.power),
            obtuse: triangles.obtuse,
            edge_variation: triangles.edge_variation,
        })
    }
}

/// The sets of one size and start, relaxed by one method.
pub struct Measured {
    pub method: Method,
    pub start: Start,
    pub count: usize,
    /// The figures of each set.
    pub sets: Vec<Quality>,
    /// Steps and seconds of a set, in the mean.
    pub steps: f64,
    pub seconds: f64,
    /// The first set.
    pub first: Vec<[f32; 2]>,
}

impl Measured {
    /// All sizes and starts of a method.
    pub fn all(context: &Context, method: Method, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let sizes = if method.is_best { effort.best } else { effort.thesis };
        let kinds = sizes.iter().flat_map(|size| STARTS.map(|start| (size, start)));
        let weight = |count: usize, sets: u64| count as f64 * sets as f64;
        let all: f64 = 2.0 * sizes.iter().map(|&(count, sets)| weight(count, sets)).sum::<f64>();
        let mut done = 0.0;
        let mut measured = Vec::new();
        for (&(count, sets), start) in kinds {
            measured.push(Self::kind(context, method, start, count, sets)?);
            done += weight(count, sets);
            _ = progress(done / all);
        }
        Ok(measured)
    }

    fn kind(context: &Context, method: Method, start: Start, count: usize, sets: u64) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let mut measured = Self { method, start, count, sets: Vec::new(), steps: 0.0, seconds: 0.0, first: Vec::new() };
        for seed in FIRST_SEED..FIRST_SEED + sets {
            let points = start.points(context, domain, count, seed)?;
            let options = method.options(domain, seed);
            let clock = Instant::now();
            let (relaxed, report) = relax(context, &options, &points, None)?;
            measured.seconds += clock.elapsed().as_secs_f64() / sets as f64;
            measured.steps += f64::from(report.iterations) / sets as f64;
            measured.sets.push(Quality::of(context, &relaxed, report.coverage)?);
            if seed == FIRST_SEED {
                measured.first = relaxed;
            }
        }
        Ok(measured)
    }

    /// A figure over the sets.
    pub fn summary(&self, figure: impl Fn(&Quality) -> f64) -> Summary {
        Summary::of(&self.sets.iter().map(figure).collect::<Vec<_>>())
    }
}
