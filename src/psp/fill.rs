//! Filling what the projectors left uncovered, until the set is maximal (departs from the thesis, which has no such step).
//!
//! Rounds of darts, as in the flat quadtree of Ebeida et al. 2012 ("A simple algorithm for maximal Poisson-disk sampling
//! in high dimensions") with patches of triangles for squares: one dart into each uncovered patch, the greedy choice
//! among the darts, and a new look at the patches, in which covered ones go and the others become smaller. Each block
//! of space does so for itself, in the colours of `blocks.rs`.
//!
//! *Order of the darts.* Darts that rain uniformly on the surface hit a patch of area a after a waiting time Exp(1) / a.
//! A patch's priority is that time: a weighted random order (Efraimidis and Spirakis 2006).
//!
//! *The end.* Floats cannot tell points apart that are closer than the float spacing at the mesh's largest coordinate.
//! The darts of patches no longer than that go to their centre. If it is rejected the patch is covered up to
//! rounding: that of the position (0.9 spacings), of the barycentrics (below 4.4, on a triangle that spans a mesh around
//! the origin) and the size of the patch (0.7). So no point of the surface is farther from all samples than the
//! radius and [`TOLERANCE`] float spacings.

use std::ops::AddAssign;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, next_below, round_barycentrics};
use crate::psp::coverage::{Coverage, Fragment, Patch};
use crate::psp::pieces::pieces;
use crate::psp::room::Room;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// How far beyond the radius a point of the surface can be from all samples of a maximal set, in spacings of floats at
/// the largest absolute coordinate of the mesh.
pub const TOLERANCE: f64 = 6.0;

/// The pieces that the search begins with, in radii: large enough to share their samples, small enough for a room.
const PIECE: f64 = 2.0;
/// How long, in radii, the sixteenths of a partly covered patch are when the first dart is thrown into them.
const FINE: f64 = 0.15;

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
    let pieces = pieces(&job.part(0.0, 0.2), mesh, PIECE * radius, |centre| samples.block(centre.to_array()))?;
    samples.grow(&job.part(0.2, 1.0), &pieces, |block, room, pieces| {
        fill_block(mesh, radius, Rng::at(seed, Draw::Fill, &block.key()), room, pieces)
    })
}

/// The samples that a block needs to be covered, and what that took.
fn fill_block(
    mesh: &Mesh,
    radius: f64,
    mut rng: Rng,
    room: &mut Room,
    pieces: &mut dyn Iterator<Item = &Fragment>,
) -> (Vec<Sample>, Filled) {
    let spacing = float_spacing(mesh);
    let (mut open, mut next) = (Vec::new(), Vec::new());
    let mut coverage = Coverage::new(mesh, room, FINE * radius, spacing);
    pieces.for_each(|piece| coverage.search(piece, &mut open));
    let open_area = open.iter().map(|patch| patch.open_area(mesh)).sum();
    let (mut accepted, mut darts) = (Vec::new(), 0);
    while !open.is_empty() {
        darts += open.len() as u64;
        for patch in in_order_of_arrival(mesh, &open, &mut rng) {
            let sample = dart(mesh, patch, spacing, &mut rng);
            if !room.rejects(sample.position) {
                room.add(sample.position);
                accepted.push(sample);
            }
        }
        // A dart into the centre of a patch decides about all of it.
        let mut coverage = Coverage::new(mesh, room, FINE * radius, spacing);
        open.iter().filter(|patch| patch.longest > spacing).for_each(|patch| coverage.refine(patch, &mut next));
        std::mem::swap(&mut open, &mut next);
        next.clear();
    }
    (accepted, Filled { darts, open_area })
}

impl Patch {
    /// The area of the open sixteenths.
    fn open_area(&self, mesh: &Mesh) -> f64 {
        self.fragment.area(mesh) * f64::from(self.open.count_ones()) / 16.0
    }
}

/// The spacing of floats at the largest absolute coordinate of a mesh.
pub(super) fn float_spacing(mesh: &Mesh) -> f64 {
    let largest = mesh.largest_coordinate();
    f64::from(largest) - f64::from(next_below(largest))
}

fn in_order_of_arrival<'a>(mesh: &Mesh, open: &'a [Patch], rng: &mut Rng) -> Vec<&'a Patch> {
    let arrival = |patch: &Patch, rng: &mut Rng| -(1.0 - rng.unit()).ln() / patch.open_area(mesh);
    let mut order: Vec<_> = open.iter().map(|patch| (arrival(patch, rng), patch)).collect();
    order.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    order.into_iter().map(|(_, patch)| patch).collect()
}

/// A patch's dart, uniform in its open sixteenths (in its centre, if it is no longer than `spacing`).
fn dart(mesh: &Mesh, patch: &Patch, spacing: f64, rng: &mut Rng) -> Sample {
    let place = if patch.longest <= spacing {
        patch.fragment.at([1.0 / 3.0; 2])
    } else {
        let skipped = rng.below(patch.open.count_ones().into());
        let rest = (0..skipped).fold(patch.open, |open, _| open & (open - 1));
        let [mut s, mut t] = [rng.unit(), rng.unit()];
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        patch.fragment.sixteenth(rest.trailing_zeros() as usize).at([s, t])
    };
    Sample::new(mesh, patch.fragment.triangle, round_barycentrics(place))
}
