//! Filling what the projectors left uncovered, until the set is maximal (departs from the thesis, which has no such step).
//! Each cube of space does so for itself, in the colours of `cubes.rs`, by the rain of `rain.rs`.

use std::ops::AddAssign;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::patches::PatchSearch;
use crate::psp::pieces::pieces;
use crate::psp::rain::rain;
use crate::psp::samples::{Sample, SampleSet};
use crate::psp::surroundings::Surroundings;
use crate::psp::uniform_cover::UniformCover;
use crate::rng::{Draw, Rng};

/// The pieces that the search begins with, in radii: large enough to share their samples, small enough for
/// [`Surroundings`].
const PIECE: f64 = 4.0;

/// Counts of a fill, or of a part of it.
#[derive(Default)]
pub(super) struct Filled {
    pub darts: u64,
    /// The area of the sixteenths that were open at first.
    pub open_area: f64,
}

impl AddAssign for Filled {
    fn add_assign(&mut self, part: Self) {
        self.darts += part.darts;
        self.open_area += part.open_area;
    }
}

/// Adds samples until the set is maximal.
pub(super) fn fill(job: &Job, mesh: &Mesh, samples: &mut SampleSet, seed: u64) -> Result<Filled> {
    let radius = samples.radius();
    let cube = |_: &Fragment, shape: &Shape| samples.cube(shape.centre.to_array());
    let pieces = pieces(&job.part(0.0, 0.2), mesh, |_, _| PIECE * radius, cube)?;
    samples.grow(&job.part(0.2, 1.0), &pieces, |cube, surroundings, pieces| {
        fill_cube(mesh, Rng::at(seed, Draw::Fill, &cube.key()), surroundings, pieces)
    })
}

/// The samples that a cube needs to be covered, and what that took.
fn fill_cube(
    mesh: &Mesh,
    rng: Rng,
    surroundings: &mut Surroundings,
    pieces: &mut dyn Iterator<Item = &Fragment>,
) -> (Vec<Sample>, Filled) {
    let test = UniformCover::new(surroundings);
    let mut search = PatchSearch { mesh, test, finest: mesh.float_spacing() };
    let mut patches = Vec::new();
    pieces.for_each(|piece| search.search(piece, &mut patches));
    let open_area = patches.iter().map(|patch| patch.open_area(mesh)).sum();
    let rained = rain(search, patches, rng);
    (rained.accepted, Filled { darts: rained.darts, open_area })
}
