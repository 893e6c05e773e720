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
//! All levels lie on one lattice, and each is made by windows of blocks (`tiling/`): a part of a level depends on the
//! levels before in a part that is larger by a margin of about 12 of its radii. So a part of the plane is made from the
//! finest level back to the coarsest, to find what of each is needed, and then forth.

mod ladder;
mod level;
mod ranked;

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::hypot;
use crate::plane::lattice::Lattice;
use crate::points::Domain;
use crate::rng::{Draw, hash};
use crate::{maximal, memory};

use crate::kdrt::around::Around;
use crate::kdrt::options::Options;
use crate::kdrt::region::{Part, Placed, Region};
use crate::kdrt::tiling::Tiling;
use ladder::{Ladder, crowded_radius, octaves_above};
use level::Level;
pub use ranked::Ranked;

/// The most bytes that a sample takes while levels are made.
const BYTES_PER_SAMPLE: f64 = 64.0;

/// The share of the progress that the coarsest level takes.
const COARSEST_SHARE: f64 = 0.05;

/// A plane that is kept keeps the whole of the levels that have no more samples than this: what a window needs of its
/// surroundings in each level at a quotient of 2^(1/8).
const KEPT_SAMPLES: f64 = 65_536.0;

/// A sample of a level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sample {
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

/// The levels of a plane, of which any part can be made.
pub(super) struct Progressive {
    /// The lattice of the finest radius.
    lattice: Lattice,
    coarsest: Coarsest,
    /// From coarse to fine.
    levels: Vec<Level>,
    /// The number of levels that are kept, and their samples.
    kept: Option<(usize, Region<Sample>)>,
}

/// The coarsest level.
struct Coarsest {
    lattice: Lattice,
    /// The rank of its samples.
    rank: f64,
    ground: Ground,
}

/// What its samples come from.
enum Ground {
    Tiling(Box<Tiling>),
    Whole(Vec<[i32; 2]>),
}

impl Progressive {
    /// The levels of a plane.
    pub fn new(job: &Job, options: &Options) -> Result<Self> {
        let &Options { radius, domain, quotient, seed, .. } = options;
        let finest = Lattice::of_any_size(&domain, radius)?;
        let longest = longest(&domain);
        let from = if options.coarsest.is_finite() { options.coarsest } else { octaves_above(radius, longest) };
        let ladder = Ladder::new(from, quotient, domain.extent());
        let radii = ladder.down_to(ladder.step_above(longest), radius);
        let around = Arc::new(Around::new(&domain, &finest, radius, &options.given));
        let coarsest = Coarsest::new(job, options, radii[0], Arc::clone(&around))?;
        let mut levels: Vec<Level> = Vec::with_capacity(radii.len() - 1);
        let mut before = coarsest.lattice.clone();
        for (step, &radius) in (1..).zip(&radii[1..]) {
            let lattice = Lattice::of_any_size(&domain, radius)?;
            levels.push(Level::new(lattice.clone(), &before, level_seed(seed, step), Arc::clone(&around)));
            before = lattice;
        }
        Ok(Self { lattice: finest, coarsest, levels, kept: None })
    }

    /// Makes those first levels that are small as a whole, for all windows.
    pub fn keep(&mut self, job: &Job) -> Result<()> {
        if matches!(self.coarsest.ground, Ground::Tiling(_)) {
            return Ok(());
        }
        let whole = Part::whole(&self.lattice);
        let count = self.levels.iter().take_while(|level| level.expected(&whole) <= KEPT_SAMPLES).count();
        let samples = self.up_to(job, count, &whole)?;
        let radius = self.levels[..count].last().map_or(self.coarsest.lattice.radius, Level::radius);
        self.kept = Some((count, Region::new(whole, &samples, radius)));
        Ok(())
    }

    /// All samples.
    pub fn whole(&self, job: &Job) -> Result<Ranked> {
        let samples = self.up_to(job, self.levels.len(), &Part::whole(&self.lattice))?;
        Ok(self.ranked(samples))
    }

    /// The samples in a window of the domain.
    pub fn window(&self, job: &Job, window: &Domain) -> Result<Ranked> {
        let rect = self.lattice.points_in(window);
        if rect.is_empty() {
            return Ok(Ranked::default());
        }
        let samples = self.up_to(job, self.levels.len(), &Part::new(&self.lattice, &rect))?;
        let mut ranked = self.ranked(samples);
        ranked.retain(|sample| window.contains(sample));
        Ok(ranked)
    }

    fn ranked(&self, samples: Vec<Sample>) -> Ranked {
        Ranked::in_order(&self.lattice, self.coarsest.rank, samples)
    }

    /// The samples of the first `count` levels after the coarsest in a part.
    fn up_to(&self, job: &Job, count: usize, part: &Part) -> Result<Vec<Sample>> {
        let (kept, kept_region) = match &self.kept {
            Some((kept, region)) => (*kept, Some(region)),
            None => (0, None),
        };
        // From fine to coarse, what of each level is needed.
        let levels = &self.levels[kept..count];
        let mut parts = vec![*part];
        for level in levels.iter().rev() {
            parts.push(level.around(&parts[parts.len() - 1]));
        }
        parts.reverse();
        let (first, parts) = (parts[0], &parts[1..]);

        // From coarse to fine, each in its part.
        let mut samples = match kept_region {
            Some(region) => region.samples_of(&first),
            None => self.coarsest.samples(&job.part(0.0, COARSEST_SHARE), &first)?,
        };
        let costs: Vec<f64> = levels.iter().zip(parts).map(|(level, part)| 1.0 + level.expected(part)).collect();
        let total: f64 = costs.iter().sum();
        let (mut within, mut radius, mut done) = (first, self.coarsest.lattice.radius, 0.0);
        for ((level, part), cost) in levels.iter().zip(parts).zip(costs) {
            let share = |done: f64| COARSEST_SHARE + (1.0 - COARSEST_SHARE) * done / total;
            let before = Region::new(within, &samples, radius.min(level.radius() * 2.0));
            let filled = level.fill(&job.part(share(done), share(done + cost)), &before, part)?;
            samples = before.samples_of(part);
            samples.extend(filled);
            (within, radius, done) = (*part, level.radius(), done + cost);
        }
        Ok(samples)
    }
}

impl Coarsest {
    fn new(job: &Job, options: &Options, radius: f64, around: Arc<Around>) -> Result<Self> {
        let &Options { domain, leaf_size, seed, .. } = options;
        let longest = longest(&domain);
        // A radius that reaches over the domain gives one sample, which is the same for all of them.
        let reach = if radius >= longest { f64::MAX } else { radius };
        let lattice = Lattice::of_any_size(&domain, reach)?;
        let ground = if Tiling::is_worthwhile(&lattice, leaf_size) {
            Ground::Tiling(Box::new(Tiling::new(job, lattice.clone(), leaf_size, seed, around)?))
        } else {
            let disks = around.near(&lattice.rect());
            Ground::Whole(maximal::sample_points_around(job, &lattice, seed, disks)?)
        };
        Ok(Self { lattice, rank: radius.min(longest), ground })
    }

    /// The samples in a part.
    fn samples(&self, job: &Job, part: &Part) -> Result<Vec<Sample>> {
        let mut samples = Vec::new();
        let pieces: Vec<_> = Part::whole(&self.lattice).images(&part.rect).collect();
        for (piece, [along, up]) in pieces.into_iter().filter(|(piece, _)| !piece.is_empty()) {
            let image = |&[x, y]: &[i32; 2]| Sample { point: [x + along, y + up], square: i64::MAX };
            match &self.ground {
                Ground::Tiling(tiling) => samples.extend(tiling.points(job, &piece)?.iter().map(image)),
                Ground::Whole(points) => {
                    samples.extend(points.iter().filter(|point| piece.contains(**point)).map(image));
                }
            }
        }
        Ok(samples)
    }
}

/// The first `count` samples of the progressive order of a domain: those of all counts are nested.
pub(super) fn sample_count(job: &Job, options: &Options, count: usize) -> Result<Ranked> {
    let &Options { domain, quotient, seed, .. } = options;
    let longest = longest(&domain);
    let reaches_over = options.coarsest >= longest;
    let from = if reaches_over { octaves_above(crowded_radius(domain.extent()), longest) } else { options.coarsest };
    let ladder = Ladder::new(from, quotient, domain.extent());
    let made = COARSEST_SHARE / 2.0;
    let coarsest = Coarsest::new(&job.part(0.0, made), options, ladder.radius(0), Arc::default())?;
    let whole = Part::whole(&coarsest.lattice);
    let mut samples = coarsest.samples(&job.part(made, COARSEST_SHARE), &whole)?;
    if samples.len() > count {
        let reason = format!("{:?} gives {} samples, more than count {count}", options.coarsest, samples.len());
        return Err(Error::invalid("coarsest", reason));
    }
    let (mut before, mut done) = (coarsest.lattice.clone(), COARSEST_SHARE);
    for (step, radius) in (1..).zip(ladder.radii(0).skip(1)) {
        if samples.len() >= count {
            break;
        }
        let lattice = Lattice::of_any_size(&domain, radius)?;
        let level = Level::new(lattice.clone(), &before, level_seed(seed, step), Arc::default());
        let known = Region::new(whole, &samples, level.radius());
        // A level may have fewer samples than expected, but progress does not fall.
        let expected = (samples.len() as f64 * quotient * quotient / count as f64).min(1.0);
        let next = done.max(COARSEST_SHARE + (1.0 - COARSEST_SHARE) * expected);
        samples.extend(level.fill(&job.part(done, next), &known, &whole)?);
        (before, done) = (lattice, next);
    }
    let mut ranked = Ranked::in_order(&coarsest.lattice, coarsest.rank, samples);
    ranked.truncate(count);
    Ok(ranked)
}

/// Refuses more samples than memory holds while their levels are made. `argument` asks for them.
pub(super) fn require_memory(samples: f64, argument: &'static str) -> Result<()> {
    memory::require(samples * BYTES_PER_SAMPLE, argument, &format!("about {samples:.0} samples"))
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
