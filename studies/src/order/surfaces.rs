//! Prefixes of progressive sets on a mesh, and sets of exactly so many samples there.

use std::sync::Arc;

use azulejo::analysis::coverage::surface_covering_radius;
use azulejo::analysis::spacing::smallest_distance_3d;
use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options};
use azulejo::{Context, Order, Progress, Result};

use super::prefixes::counts;
use super::{Effort, QUOTIENTS, Quotient};
use crate::psp::scenes::radius;
use azulejo_cli::summary::Summary;

/// The numbers of prefixes of a set whose distances are measured.
pub const PREFIXES: u32 = 20;

/// The measurements on a mesh.
pub struct Surface {
    /// The mesh's name.
    pub mesh: &'static str,
    pub prefixes: Vec<Prefixes>,
    pub exact: Vec<Exact>,
}

/// The prefixes of the sets of a quotient.
pub struct Prefixes {
    pub quotient: Quotient,
    /// N·r² per area of the whole set.
    pub density: f64,
    /// The covering radius over the smallest distance.
    pub ratio: Summary,
    /// The smallest distance in units of the hexagonal one.
    pub rho: Summary,
}

/// Sets of one exact number of samples.
pub struct Exact {
    pub count: usize,
    /// The number of sets that have it, and the number of all.
    pub right: usize,
    pub sets: usize,
    /// The smallest distance in units of the hexagonal one.
    pub rho: Summary,
    /// The covering radius over the smallest distance: 1 in maximal sets of a radius.
    pub ratio: Summary,
    /// The bound of the covering radius in the report over the radius in it.
    pub bound: Summary,
    /// The largest excess of the covering radius over its bound, relative to it.
    pub beyond: f64,
}

impl Surface {
    pub fn measure(
        context: &Context,
        (name, mesh): (&'static str, &Arc<Mesh>),
        effort: &Effort,
        progress: &Progress,
    ) -> Result<Self> {
        let measure = Measure { context, mesh, effort };
        let prefixes = QUOTIENTS.map(|quotient| measure.prefixes(quotient)).into_iter().collect::<Result<_>>()?;
        _ = progress(0.5);
        let exact = effort.exact.iter().map(|&count| measure.exact(count)).collect::<Result<_>>()?;
        Ok(Self { mesh: name, prefixes, exact })
    }
}

struct Measure<'a> {
    context: &'a Context,
    mesh: &'a Arc<Mesh>,
    effort: &'a Effort,
}

impl Measure<'_> {
    fn prefixes(&self, quotient: Quotient) -> Result<Prefixes> {
        let Self { context, mesh, effort } = self;
        let radius = radius(mesh, effort.count);
        let (mut samples, mut ratio, mut rho) = (0, Vec::new(), Vec::new());
        for seed in 0..effort.sets {
            let options = Options::new(radius).order(Order::Progressive).quotient(quotient.value).seed(seed);
            let set = psp::sample(context, mesh, &options, None)?.0.positions;
            samples += set.len();
            for count in counts(set.len(), PREFIXES) {
                let [covering, smallest] = self.distances(&set[..count])?;
                ratio.push(covering / smallest);
                rho.push(smallest / self.hexagonal(count));
            }
        }
        let density = samples as f64 / effort.sets as f64 * radius * radius / mesh.area();
        Ok(Prefixes { quotient, density, ratio: Summary::of(&ratio), rho: Summary::of(&rho) })
    }

    fn exact(&self, count: usize) -> Result<Exact> {
        let (mut ratio, mut rho, mut bound, mut right, mut beyond) = (vec![], vec![], vec![], 0, f64::NEG_INFINITY);
        for seed in 0..self.effort.sets {
            let (set, report) = psp::sample(self.context, self.mesh, &Options::by_count(count).seed(seed), None)?;
            let [covering, smallest] = self.distances(&set.positions)?;
            let covered = report.covering_radius.unwrap_or(f64::INFINITY);
            right += usize::from(set.len() == count);
            ratio.push(covering / smallest);
            rho.push(smallest / self.hexagonal(count));
            bound.push(covered / report.radius);
            beyond = beyond.max(covering / covered - 1.0);
        }
        let [rho, ratio, bound] = [rho, ratio, bound].map(|values| Summary::of(&values));
        Ok(Exact { count, right, sets: self.effort.sets as usize, rho, ratio, bound, beyond })
    }

    /// The covering radius and the smallest distance.
    fn distances(&self, set: &[[f32; 3]]) -> Result<[f64; 2]> {
        let covering = surface_covering_radius(self.context, self.mesh, set, None)?;
        Ok([covering, smallest_distance_3d(self.context, set, None)?])
    }

    fn hexagonal(&self, count: usize) -> f64 {
        (2.0 * self.mesh.area() / (3f64.sqrt() * count as f64)).sqrt()
    }
}
