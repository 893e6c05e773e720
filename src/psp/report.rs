//! The report of a call: its counts, its times and the guarantees of its set.

use crate::host::Stopwatch;
use crate::mesh::Mesh;

/// The counts and times of a call, and the guarantees of its set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of samples after the call.
    pub samples: u64,
    /// The number of samples that the call added.
    pub accepted: u64,
    /// The number of iterations that the call made.
    pub iterations: u32,
    /// Rays traced: those that meet the mesh's box. With the rasteriser, the points of its tiles (at most 48 radii
    /// wide) that have triangles near them.
    pub rays: u64,
    /// Hits on the rays.
    pub hits: u64,
    /// Hits lost to an earlier hit on the same ray.
    pub restart_conflicts: u64,
    /// Darts thrown at uncovered surface by a fill.
    pub darts: u64,
    /// Hits and darts lost to other samples or candidates.
    pub conflicts: u64,
    /// Wall time of the call.
    pub seconds: f64,
    /// The part of `seconds` in which the pattern and, for Embree, the scene were made: in the first iteration only.
    pub prepare_seconds: f64,
    /// The part of `seconds` in which the hits were found.
    pub project_seconds: f64,
    /// The part of `seconds` in which samples were chosen among the hits; with local projectors that is a part of
    /// `project_seconds`.
    pub merge_seconds: f64,
    /// The part of `seconds` in which uncovered surface was searched and filled.
    pub fill_seconds: f64,
    /// The relative radius of the set after the call, `radius / d_max`: `d_max = sqrt(2 A / (sqrt(3) N))` would be the
    /// distance of N neighbours in hexagonal order on the area A. 0.78 for darts until nothing fits (thesis §1.4); 0
    /// for no samples. The smallest distance is taken to be the radius; that of a large set is less than a millionth
    /// above. Given samples do not count.
    pub rho: f64,
    /// For a fill, the share of the mesh's area that neither samples nor given ones covered before it, estimated with
    /// random points on the parts of the surface that no single sample covers when the search reaches them: at least
    /// 1,024 points, or above about 25,000 samples 64 for each cube of 24 radii.
    pub uncovered_before: Option<f64>,
    /// For a fill, the share of the area that is uncovered after it: 0, up to [`TOLERANCE`](super::TOLERANCE).
    pub uncovered_after: Option<f64>,
    /// A lower bound of the distance of two samples: the radius that was requested or, for a count, the one that was
    /// found. Where radii vary it is 0, or in progressive order their factor: 1, or for a density the radius at density
    /// 1.
    pub radius: f64,
    /// A bound of the covering radius, where one is known: every place of the surface is within it of a sample, up to
    /// [`TOLERANCE`](super::TOLERANCE). The radius itself after a fill; for a count a little more (mostly below 1.1
    /// times the radius), in progressive order at most [`Options::quotient`](super::Options::quotient) times the
    /// radius, from [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples on. Where radii vary, a bound of their
    /// factor.
    pub covering_radius: Option<f64>,
}

impl Report {
    /// Adds the counts and times of a part of the call.
    pub(crate) fn add(&mut self, part: &Self) {
        self.accepted += part.accepted;
        self.iterations = self.iterations.max(part.iterations);
        self.rays += part.rays;
        self.hits += part.hits;
        self.restart_conflicts += part.restart_conflicts;
        self.darts += part.darts;
        self.conflicts += part.conflicts;
        self.prepare_seconds += part.prepare_seconds;
        self.project_seconds += part.project_seconds;
        self.merge_seconds += part.merge_seconds;
        self.fill_seconds += part.fill_seconds;
    }

    /// The report of a set that was filled from nothing with so many samples and darts.
    pub(crate) fn of_fill(samples: usize, darts: u64, stopwatch: &Stopwatch) -> Self {
        Self::default().with_fill(samples, darts, stopwatch)
    }

    /// The report of a set that was projected first, as this report says, and filled: with so many samples and darts in
    /// all.
    pub(crate) fn with_fill(self, samples: usize, darts: u64, stopwatch: &Stopwatch) -> Self {
        let (samples, seconds) = (samples as u64, stopwatch.seconds());
        let conflicts = darts + self.hits - self.restart_conflicts - samples;
        let fill_seconds = seconds - self.prepare_seconds - self.project_seconds - self.merge_seconds;
        Self { samples, accepted: samples, darts, conflicts, seconds, fill_seconds, ..self }
    }
}

/// The relative radius of so many samples on a mesh.
pub fn rho(mesh: &Mesh, count: usize, radius: f64) -> f64 {
    rho_on(mesh.area(), count, radius)
}

/// The relative radius of so many samples on an area.
pub fn rho_on(area: f64, count: usize, radius: f64) -> f64 {
    let hexagonal = (2.0 * area / (3f64.sqrt() * count as f64)).sqrt();
    if count == 0 { 0.0 } else { radius / hexagonal }
}
