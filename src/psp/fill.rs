//! Filling what the projectors left uncovered, until the set is maximal (departs from the thesis, which has no such step).
//!
//! Rounds of darts, as in the flat quadtree of Ebeida et al. 2012 ("A simple algorithm for maximal Poisson-disk sampling
//! in high dimensions") with fragments of triangles for squares: one dart into each uncovered fragment, the greedy choice
//! among the darts, and a new look at the fragments, in which covered ones go and the others become smaller.
//!
//! *Order of the darts.* Darts that rain uniformly on the surface hit a fragment of area a after a waiting time Exp(1) / a.
//! A dart's priority is that time: a weighted random order without a shared draw (Efraimidis and Spirakis 2006).
//!
//! *The end.* Floats cannot tell points apart that are closer than the float spacing at the mesh's largest coordinate.
//! The darts of fragments no longer than that go to their centre. If it is rejected the fragment is covered up to
//! rounding: that of the position (0.9 spacings), of the barycentrics (below 4.4, on a triangle that spans a mesh around
//! the origin) and the size of the fragment (0.7). So no point of the surface is farther from all samples than the
//! radius and [`TOLERANCE`] float spacings.

use std::collections::HashSet;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, next_below, round_barycentrics};
use crate::psp::coverage::{Coverage, Fragment};
use crate::psp::pieces::pieces;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// How far beyond the radius a point of the surface can be from all samples of a maximal set, in spacings of floats at
/// the largest absolute coordinate of the mesh.
pub const TOLERANCE: f64 = 6.0;

/// Fragments per task.
const CHUNK: usize = 512;
/// The pieces of the first search, in radii: large enough to share their samples, small enough to share the work.
const PIECE: f64 = 4.0;
/// How small, in radii, a partly covered fragment is when the first dart is thrown into it.
const FIRST: f64 = 0.5;
/// By how much a fragment becomes smaller when its dart was no success.
const SHRINK: f64 = 0.5;

/// Counts of a fill.
#[derive(Default)]
pub(super) struct Filled {
    pub darts: u64,
    pub accepted: u64,
}

/// Adds samples until the set is maximal.
pub(super) fn fill(job: &Job, mesh: &Mesh, samples: &mut SampleSet, seed: u64) -> Result<Filled> {
    let spacing = float_spacing(mesh);
    let radius = samples.radius();
    let mut filled = Filled::default();
    let mut open = pieces(mesh, PIECE * radius);
    open = search(&job.part(0.0, 0.4), mesh, samples, &open, |_| FIRST * radius)?;

    let mut rest = job.part(0.4, 1.0);
    for round in 0.. {
        if open.is_empty() {
            break;
        }
        let throw = |fragment: &Fragment| {
            let sample = dart(mesh, fragment, spacing, seed, round);
            (!samples.rejects(&sample.1)).then_some(sample)
        };
        let chunks = chunks_of(open.len(), CHUNK);
        let darts = rest
            .part(0.0, 0.1)
            .flat_map(chunks.len(), |chunk| open[chunks.range(chunk)].iter().filter_map(throw).collect())?;
        filled.darts += open.len() as u64;
        filled.accepted += samples.merge(&rest.part(0.1, 0.2), &first_of_each_cell(mesh, radius, darts))? as u64;

        open = search(&rest.part(0.2, 0.4), mesh, samples, &open, |longest| SHRINK * longest)?;
        rest = rest.part(0.4, 1.0);
    }
    Ok(filled)
}

/// The spacing of floats at the largest absolute coordinate of a mesh.
pub(super) fn float_spacing(mesh: &Mesh) -> f64 {
    let largest = mesh.largest_coordinate();
    f64::from(largest) - f64::from(next_below(largest))
}

/// The uncovered parts of fragments, in order; `finest` says how small they become, from the length of the fragment.
///
/// A fragment no longer than the float spacing counts as covered once a dart in its centre would be rejected.
fn search(
    job: &Job,
    mesh: &Mesh,
    samples: &SampleSet,
    fragments: &[Fragment],
    finest: impl Fn(f64) -> f64 + Sync,
) -> Result<Vec<Fragment>> {
    let spacing = float_spacing(mesh);
    let chunks = chunks_of(fragments.len(), CHUNK);
    job.flat_map(chunks.len(), |chunk| {
        let (mut coverage, mut uncovered) = (Coverage::new(mesh, samples), Vec::new());
        for fragment in &fragments[chunks.range(chunk)] {
            let longest = fragment.shape(mesh).longest;
            if longest > spacing || !samples.rejects(&centre(mesh, fragment)) {
                coverage.uncovered(fragment, finest(longest).max(spacing), &mut uncovered);
            }
        }
        uncovered
    })
}

/// The sample in the centre of a fragment.
fn centre(mesh: &Mesh, fragment: &Fragment) -> Sample {
    Sample::new(mesh, fragment.triangle, round_barycentrics(fragment.at(1.0 / 3.0, 1.0 / 3.0)))
}

/// A fragment's dart of a round, uniform in the fragment (in its centre, if it is no longer than `spacing`), and the time
/// at which it arrives.
fn dart(mesh: &Mesh, fragment: &Fragment, spacing: f64, seed: u64, round: u64) -> (f64, Sample) {
    let mut rng = Rng::at(seed, Draw::Fill, &[fragment.triangle.into(), fragment.path, round]);
    let arrival = -(1.0 - rng.unit()).ln() / fragment.area(mesh);
    if fragment.shape(mesh).longest <= spacing {
        return (arrival, centre(mesh, fragment));
    }
    let [mut s, mut t] = [rng.unit(), rng.unit()];
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    (arrival, Sample::new(mesh, fragment.triangle, round_barycentrics(fragment.at(s, t))))
}

/// The first dart of each cell of a grid in which two darts of a cell always conflict, in order of arrival.
///
/// That bounds the rivals of a dart however many triangles share a small space. The others have another round.
fn first_of_each_cell(mesh: &Mesh, radius: f64, mut darts: Vec<(f64, Sample)>) -> Vec<Sample> {
    darts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let origin = mesh.bounds().0;
    // A little less than the side of a cube whose diagonal is the radius.
    let side = radius / 1.7321;
    let cell = |position: [f32; 3]| -> [i64; 3] {
        std::array::from_fn(|axis| ((f64::from(position[axis]) - f64::from(origin[axis])) / side).floor() as i64)
    };
    let mut taken = HashSet::with_capacity(darts.len());
    darts.into_iter().map(|(_, sample)| sample).filter(|sample| taken.insert(cell(sample.position))).collect()
}
