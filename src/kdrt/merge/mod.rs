//! Merging (thesis §2.4.4, figure 2.14): sets that were made independently, on rectangles that do not overlap, become
//! one maximal set by the elimination and insertion of KDRT. Only the seams change.
//!
//! Where two pieces meet, the sample of the piece of higher rank survives (`eliminate.rs`), as between the leaves of
//! `conquer.rs`; the gaps are filled by blocks (`insert.rs`), as those of a plane. Samples that are given beforehand
//! and must stay are a piece of the highest rank.
//!
//! # Exactness
//! What is given are any floats of the domain; they are returned as they are. The lattice of the domain cannot carry
//! them all: a piece near the origin may be finer. So conflicts *between given points* are decided on their own
//! coordinates, in `f64`, as the user's check does it. Conflicts *with new samples* are decided on the lattice, where a
//! given point stands for itself as the nearest lattice point, and the radius is longer by [`WIDENING`].
//!
//! Units are float spacings at the domain's largest coordinate, distances are those of the domain (on a torus wrapped
//! with its own period). Two facts carry everything, each per axis: a given point is at most 1 from its lattice point
//! ([`Lattice::nearest`]), and the distance of two lattice points is their distance on the lattice or up to 1 more, on
//! a torus only ([`Lattice::of_any_size`]).
//!
//! * A new sample is at least r + 1.5 on the lattice from a given point's lattice point, so more than r + 1.5 - √2 > r
//!   from the given point. From other new samples it is r + 1.5 away.
//! * Every lattice point is within r + 1.5 on the lattice of a sample's lattice point; so within r + 1.5 + 2√2 of the
//!   sample. Every point of the domain is within 1 per axis of a lattice point. This adds up to r + 1.5 + 3√2, less than
//!   **r + 6 float spacings**.
//! * Two given points without conflict are more than r - 2√2 apart on the lattice, so that cells for the radius r - 3
//!   ([`NARROWING`]) hold one of them at most.
//! * A piece that covers every lattice point of its rectangle within r covers it on the lattice of the domain within
//!   r + √2, less than r + 1.5: nothing is inserted where its samples survive.

mod eliminate;
mod given;
mod insert;

use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::memory;
use crate::plane::lattice::Lattice;
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, hash};
use crate::setters::setters;

use eliminate::survivors;
use given::Given;
use insert::insert;

/// How much longer the radius is for new samples, in float spacings.
const WIDENING: f64 = 1.5;

/// How much shorter the radius is of which cells hold one sample, in float spacings.
const NARROWING: f64 = 3.0;

/// The most bytes that a sample of the result takes, three cells among them, and those of a given point.
const BYTES_PER_SAMPLE: f64 = 40.0;
const BYTES_PER_GIVEN: f64 = 40.0;

/// The share of the progress until the given points are sorted, and until their conflicts are found.
const SORT_SHARE: f64 = 0.15;
const ELIMINATE_SHARE: f64 = 0.3;

/// How to merge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MergeOptions {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate: that of the pieces.
    pub radius: f64,
    /// What the result covers: any rectangle that holds the pieces and fixed points.
    pub domain: Domain,
    /// The same input and seed give the same samples.
    pub seed: u64,
}

impl MergeOptions {
    /// This radius on the unit torus, with seed 0.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), seed: 0 }
    }
}

setters!(MergeOptions { radius: f64, domain: Domain, seed: u64 });

/// A set of samples that was made by itself, such as by [`sample`](super::sample) on a bounded domain or by
/// [`sample_window`](super::sample_window).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<'a> {
    /// Samples in `min <= x < max`, no two of them in conflict: any floats, in any number, maximal or not.
    pub samples: &'a [[f32; 2]],
    /// The lower corner of the piece's rectangle.
    pub min: [f64; 2],
    /// Its upper corner.
    pub max: [f64; 2],
}

/// What became of the samples of the pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct MergeReport {
    /// Samples of the pieces that are in the result.
    pub kept: usize,
    /// Samples of the pieces that are not.
    pub eliminated: usize,
    /// New samples.
    pub inserted: usize,
}

/// Glues sets on rectangles that do not overlap, and points that must stay, into one maximal Poisson-disk set of the
/// domain.
///
/// The result has first all of `fixed`, then the samples of the pieces that survive, piece by piece, then new ones; what
/// is given is returned bit by bit and in its order.
///
/// * Conflict-free: all distances, computed in `f64` as `sqrt(dx² + dy²)`, are at least `radius`, without tolerance. On a
///   torus they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 6 float spacings at the domain's
///   largest coordinate, whatever the pieces covered: pieces that are thinned, holes between them, and no piece at all
///   are filled.
/// * Only the seams change. A sample of a piece goes only if it is closer than `radius` to a fixed point, or to a sample
///   that stays of another piece, or of its own over the seam of a torus. If the pieces are maximal as
///   [`sample`](super::sample) makes them, new samples lie within `radius` of a sample that went or of the boundary of a
///   piece's rectangle.
/// * Which of two pieces loses samples to the other depends on `seed` and their places in `pieces`.
/// * The same for every number of threads.
///
/// O(n) for the n samples given and made, and O(p²) at most for p pieces. A torus narrower than about 10 radii is filled
/// on one thread.
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range; for `pieces`, by index, if a rectangle is empty, leaves the
/// domain or overlaps another one, a sample lies outside its rectangle, or two samples of a piece are in conflict; for
/// `fixed`, by index, if a point lies outside the domain or two of them are in conflict, because then no set that has
/// both is conflict-free. [`Error::TooLarge`] for more than 2^32 samples or the available memory. All of them before any
/// sample is made. [`Error::Cancelled`].
///
/// ```
/// use azulejo::{Boundary, Context, Domain, kdrt};
///
/// let context = Context::new(0)?;
/// let half = |min: [f64; 2], max: [f64; 2], seed| {
///     let domain = Domain { min, max, boundary: Boundary::Bounded };
///     kdrt::sample(&context, &kdrt::Options::new(0.01).domain(domain).seed(seed), None)
/// };
/// let (left, right) = (half([0.0, 0.0], [0.5, 1.0], 1)?, half([0.5, 0.0], [1.0, 1.0], 2)?);
/// let pieces = [
///     kdrt::Piece { samples: &left.positions, min: [0.0, 0.0], max: [0.5, 1.0] },
///     kdrt::Piece { samples: &right.positions, min: [0.5, 0.0], max: [1.0, 1.0] },
/// ];
/// let options = kdrt::MergeOptions::new(0.01).seed(7);
/// let (points, report) = kdrt::merge(&context, &options, &pieces, &[[0.25, 0.75]], None)?;
/// assert_eq!(points.positions[0], [0.25, 0.75]);
/// assert_eq!(points.len(), 1 + report.kept + report.inserted);
/// # Ok::<(), azulejo::Error>(())
/// ```
pub fn merge(
    context: &Context,
    options: &MergeOptions,
    pieces: &[Piece],
    fixed: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Points<2>, MergeReport)> {
    let &MergeOptions { radius, domain, seed } = options;
    let lattice = Lattice::new(&domain, radius)?;
    check_points("fixed", "point", &domain, fixed)?;
    check_pieces(&domain, pieces)?;
    let sets: Vec<&[[f32; 2]]> = std::iter::once(fixed).chain(pieces.iter().map(|piece| piece.samples)).collect();
    let count: usize = sets.iter().map(|set| set.len()).sum();
    if count > u32::MAX as usize {
        return Err(Error::too_large("pieces", format!("{count} samples; the limit is {}", u32::MAX)));
    }
    let expected = lattice.expected_samples();
    let bytes = expected * BYTES_PER_SAMPLE + count as f64 * BYTES_PER_GIVEN;
    memory::require(bytes, "radius", &format!("about {expected:.0} samples"))?;

    let seed = hash(seed, Draw::Merge, &[]);
    context.run(progress, |job| {
        let given = Given::new(&job.part(0.0, SORT_SHARE), domain, &lattice, radius, &sets)?;
        let survives = survivors(&job.part(SORT_SHARE, ELIMINATE_SHARE), &given, seed)?;
        let inserted = insert(&job.part(ELIMINATE_SHARE, 1.0), &given, &survives, &lattice, seed)?;
        let mut samples = given.in_order(&survives);
        let kept = samples.len() - fixed.len();
        let report = MergeReport { kept, eliminated: count - samples.len(), inserted: inserted.len() };
        samples.extend(inserted);
        Ok((samples.into(), report))
    })
}

fn check_pieces(domain: &Domain, pieces: &[Piece]) -> Result<()> {
    for (i, piece) in pieces.iter().enumerate() {
        let Piece { samples, min, max } = *piece;
        for axis in 0..2 {
            // Not the negation of an overlap: a NaN is inside of nothing.
            let inside = domain.min[axis] <= min[axis] && min[axis] < max[axis] && max[axis] <= domain.max[axis];
            if !inside {
                let (min, max, from, to) = (min[axis], max[axis], domain.min[axis], domain.max[axis]);
                let reason =
                    format!("[{i}] reaches on axis {axis} from {min} to {max}, which is no part of {from} to {to}");
                return Err(Error::invalid("pieces", reason));
            }
        }
        let rectangle = Domain { min, max, boundary: Boundary::Bounded };
        check_points("pieces", &format!("[{i}]: sample"), &rectangle, samples)?;
    }
    match first_overlap(pieces) {
        Some([i, j]) => Err(Error::invalid("pieces", format!("the rectangles of [{i}] and [{j}] overlap"))),
        None => Ok(()),
    }
}

/// Refuses a point that does not lie in the rectangle.
fn check_points(argument: &'static str, what: &str, rectangle: &Domain, points: &[[f32; 2]]) -> Result<()> {
    let Some(index) = points.iter().position(|&point| !rectangle.contains(point)) else { return Ok(()) };
    let ([x, y], Domain { min, max, .. }) = (points[index], rectangle);
    Err(Error::invalid(argument, format!("{what} {index} is ({x}, {y}), outside the rectangle {min:?} to {max:?}")))
}

/// Two pieces whose rectangles overlap, from left to right.
fn first_overlap(pieces: &[Piece]) -> Option<[usize; 2]> {
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&i, &j| pieces[i].min[0].total_cmp(&pieces[j].min[0]));
    order.iter().enumerate().find_map(|(place, &i)| {
        let beside = order[place + 1..].iter().take_while(|&&j| pieces[j].min[0] < pieces[i].max[0]);
        let overlaps = |j: usize| pieces[i].min[1] < pieces[j].max[1] && pieces[j].min[1] < pieces[i].max[1];
        beside.copied().find(|&j| overlaps(j)).map(|j| [i.min(j), i.max(j)])
    })
}
