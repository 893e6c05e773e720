//! Progressive order: nested maximal sets, coarse to fine, each filled around the one before.
//!
//! Not in the thesis. The radii of the levels fall by a quotient (`ladder.rs`); the coarsest level is a set of KDRT or
//! [`maximal`](crate::maximal), every other one fills what those before leave uncovered (`level.rs`). The *rank* of a
//! sample is its distance to the nearest sample that was there when it was accepted, and a set is sorted by falling
//! rank.
//!
//! # What holds for every prefix
//! Of two samples of a prefix one was there before the other, which then has a rank of at most their distance: no two
//! are closer than the last rank. A level covers the domain within its radius R, and all ranks of the next one are at
//! least R / quotient: what lies in the middle of the next level, and has a last rank of at least that, covers within
//! the quotient times the last rank. The ranks of a level are below the radius of the one before, so they never rise.
//! The first levels, up to [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples, have a larger quotient.
//!
//! # Parts
//! Each level is made by windows of blocks (`tiling/`): a part of a level depends on the levels before in a part that is
//! larger by a margin of about 12 of its radii (`stack.rs`).

mod ladder;
mod level;

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::kdrt::around::Around;
use crate::kdrt::base::Base;
use crate::kdrt::options::{Options, Progressive};
use crate::kdrt::region::{Part, Placed, Region};
use crate::kdrt::stack::{Layer, Stack, images};
use crate::math::{hypot, rounded_down};
use crate::plane::lattice::Lattice;
use crate::points::{Domain, Points};
use crate::rng::{Draw, hash};

use ladder::{Ladder, crowded_radius, octaves_above};
pub use level::Level;

/// The most bytes that a sample takes while levels are made.
pub const BYTES_PER_SAMPLE: f64 = 64.0;

/// The share of the progress of a count that the coarsest level takes.
const COARSEST_SHARE: f64 = 0.05;

/// A plane that is kept keeps the whole of the levels that have no more samples than this: what a window needs of its
/// surroundings in each level at a quotient of 2^(1/8).
const KEPT_SAMPLES: f64 = 65_536.0;

/// A sample of the coarsest level, but for its place.
const COARSEST: Sample = Sample { point: [0; 2], square: i64::MAX };

/// A sample of a level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub point: [i32; 2],
    /// The squared distance to the nearest sample that was there when it was accepted, in lattice units. Those of the
    /// coarsest level have the largest number.
    pub square: i64,
}

impl Placed for Sample {
    fn point(&self) -> [i32; 2] {
        self.point
    }

    fn moved_to(self, point: [i32; 2]) -> Self {
        Self { point, ..self }
    }
}

/// The coarsest level.
struct Coarsest {
    lattice: Lattice,
    /// The rank of its samples.
    rank: f64,
    base: Base,
}

/// The levels of a plane around given samples, and the rank of the samples of the coarsest one.
pub fn stack(
    job: &Job,
    options: &Options,
    radius: f64,
    levels: &Progressive,
    around: Arc<Around>,
) -> Result<(Stack<Level>, f64)> {
    let &Options { domain, seed, .. } = options;
    let finest = Lattice::of_any_size(&domain, radius)?;
    let longest = longest(&domain);
    let from = if levels.coarsest.is_finite() { levels.coarsest } else { octaves_above(radius, longest) };
    let ladder = Ladder::new(from, levels.quotient, domain.extent());
    let radii = ladder.down_to(ladder.step_above(longest), radius);
    let Coarsest { lattice: mut before, rank, base } = Coarsest::new(job, options, radii[0], Arc::clone(&around))?;
    let most_kept = if matches!(base, Base::Whole(_)) { KEPT_SAMPLES } else { 0.0 };
    let mut levels: Vec<Level> = Vec::with_capacity(radii.len() - 1);
    for (step, &radius) in (1..).zip(&radii[1..]) {
        let lattice = Lattice::of_any_size(&domain, radius)?;
        let seed = level_seed(seed, step);
        levels.push(Level::new(lattice.clone(), &before, seed, Arc::clone(&around), most_kept));
        before = lattice;
    }
    Ok((Stack::new(finest, Some((base, COARSEST)), levels), rank))
}

/// Puts samples in order. Those of the coarsest level have the given rank.
pub fn ordered(lattice: &Lattice, coarsest: f64, mut samples: Vec<Sample>) -> Points<2> {
    samples.sort_unstable_by(|a, b| {
        b.square.cmp(&a.square).then(a.point[1].cmp(&b.point[1])).then(a.point[0].cmp(&b.point[0]))
    });
    let rank = |square: i64| if square == i64::MAX { coarsest } else { lattice.length(square) };
    Points {
        ranks: samples.iter().map(|sample| rounded_down(rank(sample.square))).collect(),
        positions: samples.iter().map(|sample| lattice.position(sample.point)).collect(),
        ..Points::default()
    }
}

impl Coarsest {
    fn new(job: &Job, options: &Options, radius: f64, around: Arc<Around>) -> Result<Self> {
        let &Options { domain, leaf_size, seed, .. } = options;
        let longest = longest(&domain);
        // A radius that reaches over the domain gives one sample, which is the same for all of them.
        let reach = if radius >= longest { f64::MAX } else { radius };
        let lattice = Lattice::of_any_size(&domain, reach)?;
        let base = Base::new(job, lattice.clone(), leaf_size, seed, around)?;
        Ok(Self { lattice, rank: radius.min(longest), base })
    }
}

/// The first `count` samples of the progressive order of a domain: those of all counts are nested.
pub fn first(job: &Job, options: &Options, levels: &Progressive, count: usize) -> Result<Points<2>> {
    let (&Options { domain, seed, .. }, &Progressive { quotient, coarsest }) = (options, levels);
    let longest = longest(&domain);
    let reaches_over = coarsest >= longest;
    let from = if reaches_over { octaves_above(crowded_radius(domain.extent()), longest) } else { coarsest };
    let ladder = Ladder::new(from, quotient, domain.extent());
    let made = COARSEST_SHARE / 2.0;
    let Coarsest { lattice, rank, base } =
        Coarsest::new(&job.part(0.0, made), options, ladder.radius(0), Arc::default())?;
    let whole = Part::whole(&lattice);
    let mut samples = images(&job.part(made, COARSEST_SHARE), &lattice, &base, COARSEST, &whole)?;
    if samples.len() > count {
        let reason = format!("{:?} gives {} samples, more than count {count}", coarsest, samples.len());
        return Err(Error::invalid("coarsest", reason));
    }
    let (mut before, mut done) = (lattice.clone(), COARSEST_SHARE);
    for (step, radius) in (1..).zip(ladder.radii(0).skip(1)) {
        if samples.len() >= count {
            break;
        }
        let finer = Lattice::of_any_size(&domain, radius)?;
        let level = Level::new(finer.clone(), &before, level_seed(seed, step), Arc::default(), 0.0);
        let known = Region::new(whole, &samples, level.radius());
        // A level may have fewer samples than expected, but progress does not fall.
        let expected = (samples.len() as f64 * quotient * quotient / count as f64).min(1.0);
        let next = done.max(COARSEST_SHARE + (1.0 - COARSEST_SHARE) * expected);
        samples.extend(level.fill(&job.part(done, next), &known, &whole)?);
        (before, done) = (finer, next);
    }
    let mut points = ordered(&lattice, rank, samples);
    points.positions.truncate(count);
    points.ranks.truncate(count);
    Ok(points)
}

/// The seed of a level by its number.
fn level_seed(seed: u64, step: u64) -> u64 {
    hash(seed, Draw::Level, &[step])
}

/// No two points of a domain are farther apart.
fn longest(domain: &Domain) -> f64 {
    let [width, height] = domain.extent();
    hypot(width, height)
}
