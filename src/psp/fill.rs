//! Filling what the projectors left uncovered, until the set is maximal (departs from the thesis, which has no such step).
//!
//! A dart into each uncovered patch, a new look at the patch, and so on, as in the flat quadtree of Ebeida et al. 2012
//! ("A simple algorithm for maximal Poisson-disk sampling in high dimensions") with patches of triangles for squares. Each
//! block of space does so for itself, in the colours of `blocks.rs`.
//!
//! *Order of the darts.* There are no rounds: darts rain uniformly on the surface. The next one that hits a patch of area
//! a comes after a waiting time Exp(1) / a, and darts are thrown in the order in which they arrive. So the accepted ones
//! are distributed as if all of the surface had been rained on, however it is cut. A patch of which other samples have
//! covered something since waits anew, for what is left of it; one that is still as it was is cut up.
//!
//! *The end.* Floats cannot tell points apart that are closer than the float spacing at the mesh's largest coordinate.
//! The darts of patches no longer than that go to their centre. If it is rejected the patch is covered up to
//! rounding: that of the position (0.9 spacings), of the barycentrics (below 4.4, on a triangle that spans a mesh around
//! the origin) and the size of the patch (0.7). So no point of the surface is farther from all samples than the
//! radius and [`TOLERANCE`] float spacings.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::AddAssign;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, next_below, round_barycentrics};
use crate::psp::coverage::{Coverage, Fragment, Patch, Shape};
use crate::psp::pieces::pieces;
use crate::psp::room::Room;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// How far beyond the radius a point of the surface can be from all samples of a maximal set, in spacings of floats at
/// the largest absolute coordinate of the mesh.
pub const TOLERANCE: f64 = 6.0;

/// The pieces that the search begins with, in radii: large enough to share their samples, small enough for a room.
const PIECE: f64 = 4.0;
/// How long, in radii, the sixteenths of a partly covered patch are, whose sixteenths in turn it tells apart.
const FINE: f64 = 0.25;

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
    let place = |_: &Fragment, shape: &Shape| samples.block(shape.centre.to_array());
    let pieces = pieces(&job.part(0.0, 0.2), mesh, |_, _| PIECE * radius, place)?;
    samples.grow(&job.part(0.2, 1.0), &pieces, |block, room, pieces| {
        fill_block(mesh, radius, Rng::at(seed, Draw::Fill, &block.key()), room, pieces)
    })
}

/// Darts on their way to the patches of a block, in the order in which they arrive: a patch of area a waits Exp(1) / a.
struct Rain<'a> {
    mesh: &'a Mesh,
    rng: Rng,
    /// When the next dart arrives (the bits of floats that are not negative are in the order of the floats), and where.
    darts: BinaryHeap<Reverse<(u64, usize)>>,
}

impl Rain<'_> {
    /// Sends the next dart to a patch that has been waiting since `time`.
    fn send(&mut self, time: f64, number: usize, patch: &Patch) {
        let arrival = time - (1.0 - self.rng.unit()).ln() / patch.open_area(self.mesh);
        self.darts.push(Reverse((arrival.to_bits(), number)));
    }

    /// The next dart to arrive: when, and at which patch.
    fn next(&mut self) -> Option<(f64, usize)> {
        self.darts.pop().map(|Reverse((arrival, number))| (f64::from_bits(arrival), number))
    }

    /// One of the open parts of a patch: a sixteenth, and a sixteenth of it.
    fn open_part(&mut self, patch: &Patch) -> [usize; 2] {
        let mut skipped = self.rng.below(patch.open_parts().into()) as u32;
        let mut part = 0;
        while skipped >= patch.open[part].count_ones() {
            skipped -= patch.open[part].count_ones();
            part += 1;
        }
        let rest = (0..skipped).fold(patch.open[part], |open, _| open & (open - 1));
        [part, rest.trailing_zeros() as usize]
    }

    /// A point of a fragment.
    fn point(&mut self, fragment: &Fragment) -> Sample {
        let [mut s, mut t] = [self.rng.unit(), self.rng.unit()];
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        self.sample(fragment, [s, t])
    }

    fn sample(&self, fragment: &Fragment, place: [f64; 2]) -> Sample {
        Sample::new(self.mesh, fragment.triangle, round_barycentrics(fragment.at(place)))
    }
}

/// The samples that a block needs to be covered, and what that took.
fn fill_block(
    mesh: &Mesh,
    radius: f64,
    rng: Rng,
    room: &mut Room,
    pieces: &mut dyn Iterator<Item = &Fragment>,
) -> (Vec<Sample>, Filled) {
    let spacing = float_spacing(mesh);
    let mut coverage = Coverage::new(mesh, room, FINE * radius, spacing);
    let mut patches = Vec::new();
    pieces.for_each(|piece| coverage.search(piece, &mut patches));
    let open_area = patches.iter().map(|patch| patch.open_area(mesh)).sum();
    let mut rain = Rain { mesh, rng, darts: BinaryHeap::new() };
    patches.iter().enumerate().for_each(|(number, patch)| rain.send(0.0, number, patch));
    let (mut accepted, mut darts) = (Vec::new(), 0);
    while let Some((time, number)) = rain.next() {
        let before = patches[number];
        let [part, of_part] = rain.open_part(&before);
        let patch = &mut patches[number];
        coverage.update(patch);
        let is_last = patch.longest <= spacing;
        let dart = if is_last && patch.open_parts() > 0 {
            Some(rain.sample(&patch.fragment, [1.0 / 3.0; 2]))
        } else if patch.open[part] >> of_part & 1 == 1 {
            Some(rain.point(&patch.fragment.sixteenth(part).sixteenth(of_part)))
        } else {
            None
        };
        darts += u64::from(dart.is_some());
        if let Some(sample) = dart.filter(|sample| coverage.add(sample.position)) {
            accepted.push(sample);
            coverage.update(patch);
        }
        if is_last || patch.open_parts() == 0 {
            continue;
        }
        if patch.open != before.open {
            rain.send(time, number, patch);
        } else {
            let first = patches.len();
            coverage.refine(&before, &mut patches);
            (first..patches.len()).for_each(|number| rain.send(time, number, &patches[number]));
        }
    }
    (accepted, Filled { darts, open_area })
}

/// The spacing of floats at the largest absolute coordinate of a mesh.
pub(super) fn float_spacing(mesh: &Mesh) -> f64 {
    let largest = mesh.largest_coordinate();
    f64::from(largest) - f64::from(next_below(largest))
}
