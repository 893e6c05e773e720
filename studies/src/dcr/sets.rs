//! The sets that are relaxed, and the methods.

use azulejo::dcr::{Neighbourhood, Options};
use azulejo::kdrt::{self, CountOptions};
use azulejo::mesh::Mesh;
use azulejo::{Context, Domain, Result, psp};

use crate::kdrt::radius;
use crate::reference;

/// The seed of the first set of each kind. No setting of a method was chosen by what sets of these seeds gave; take
/// other seeds to tune one.
pub const FIRST_SEED: u64 = 31_000;

/// A method, with its default options.
#[derive(Clone, Copy)]
pub struct Method {
    pub name: &'static str,
    pub neighbourhood: Neighbourhood,
    pub is_thesis: bool,
}

pub const METHODS: [Method; 4] = [
    Method { name: "momentum, Delaunay", neighbourhood: Neighbourhood::Delaunay, is_thesis: false },
    Method { name: "momentum, nearest", neighbourhood: Neighbourhood::Nearest, is_thesis: false },
    Method { name: "thesis, Delaunay", neighbourhood: Neighbourhood::Delaunay, is_thesis: true },
    Method { name: "thesis, nearest", neighbourhood: Neighbourhood::Nearest, is_thesis: true },
];

impl Method {
    pub fn options(&self, domain: Domain, seed: u64) -> Options {
        let options = if self.is_thesis { Options::thesis } else { Options::new };
        options(domain, self.neighbourhood).seed(seed)
    }

    /// The name of its picture.
    pub fn picture(&self) -> String {
        self.name.replace(", ", "-").to_lowercase()
    }
}

/// A set before relaxation.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    Random,
    /// A maximal Poisson-disk set.
    Kdrt,
    /// The thesis's projections onto a square, without filling. They have no torus.
    Psp,
}

/// Iterations of [`Start::Psp`]: as many as the thesis's reference has (§3.4.1).
const PROJECTIONS: u32 = 50;

pub const STARTS: [Start; 2] = [Start::Random, Start::Kdrt];

impl Start {
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Kdrt => "KDRT",
            Self::Psp => "PSP",
        }
    }

    /// So many points of a unit square, or about as many of PSP's.
    pub fn points(self, context: &Context, domain: Domain, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        match self {
            Self::Random => Ok(reference::random(count, seed)),
            Self::Kdrt => {
                let leaf_size = kdrt::DEFAULT_LEAF_SIZE;
                let options = CountOptions::new(count as u64).domain(domain).leaf_size(leaf_size).seed(seed);
                Ok(kdrt::sample_count(context, &options, None)?.0.positions)
            }
            Self::Psp => {
                let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
                let square = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])?.into();
                let options = psp::ProjectionOptions::new(radius(count as f64)).seed(seed);
                let (samples, _) = psp::project(context, &square, &options, PROJECTIONS, false, None)?;
                let inside = |&[x, y]: &[f32; 2]| x < 1.0 && y < 1.0;
                Ok(samples.positions.iter().map(|&[x, y, _]| [x, y]).filter(inside).collect())
            }
        }
    }
}
