//! Levels: maximal sets of ever smaller radii, each filled around the samples of the levels before. They give sets in
//! progressive order and sets of an exact count.
//!
//! Each sample has a *rank*: its distance to the nearest sample that was accepted before it, but no more than the
//! radius of the level before, which it exceeds by a tolerance at most. Of any two samples the later one's rank is no
//! more than their distance. So all samples whose ranks are at least some distance are that far apart, whatever their
//! order. And the ranks of a level lie between its own radius and that of the level before: sorted by decreasing rank,
//! all levels are in order, and a prefix that ends within a level covers the surface within the radius of the level
//! before.
//!
//! Given samples keep their clearances on all levels and do not affect ranks; nor do samples that a sample ignores
//! because they face another way.
//!
//! If the radius varies (`psp/adaptive/sample.rs`), distances are measured by the mean of two local radii, and the radius
//! of a level is the factor of these.
//!
//! *Progressive order* is a ladder of levels, each a quotient below the one before. It begins where one sample covers
//! the mesh. As long as a level has no more than [`Order::FIRST_COUNT`] samples it falls by about two instead (see
//! [`first_stride`]). The next level does not depend on where the ladder ends. So sets of different radii and counts
//! share their levels, and a set of fewer samples is a prefix of one of more: to the bit if both are cut from the
//! ladder by their counts, and down to the last common level if one ends with a level at its radius.
//!
//! For any prefix, let k be the level in which it ends. It holds all of the level before, which covers the surface
//! within the quotient times the radius of level k; and no rank of level k is below this radius.
//!
//! *An exact count* is a maximal set that has somewhat fewer samples, and the best of one more level. A level that ends
//! above the count is sorted by rank and cut. The rest is conflict-free at the last rank, and covers the surface within
//! the radius of the level before. So the closer that radius, the smaller the loss of maximality. The number of samples
//! of a radius is known for large even surfaces only. So the search goes from large radii to small ones, which never
//! wastes a level that ends below the count, and takes back a level that ends above it if it began too far above.

use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::{exp, log, power, rounded_down};
use crate::order::{Order, first_stride};
use crate::rng::{Draw, hash};

/// The quotient of two radii from which a level begins with first darts, as on an empty surface: the level before
/// covers too little.
const FIRST_DARTS_FROM: f64 = 1.3;
/// The largest rank, in radii.
const LARGEST_RANK: f64 = 2.0;

/// The samples of a set: by their radius or directly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// As many as fit with this smallest distance, in the units of the mesh or domain; positive and finite.
    Radius(f64),
    /// Exactly so many, at least 1: the radius is found, and returned in the report.
    Count(usize),
}

/// A surface or a cuboid that can be filled level by level.
pub trait Levelled {
    /// A ranked sample, and its radius where that varies.
    type Sample: Copy + Ranked;

    /// The number of samples grows as the radius to the power of minus this.
    const DIMENSION: u32;

    /// The name of the ground and of what its samples cover, for messages.
    const NAMES: [&'static str; 2];

    /// A radius within which any sample covers all of it.
    fn top(&self) -> f64;

    /// An estimate of the samples of a radius where none are given.
    fn expected(&self, radius: f64) -> f64;

    /// Refuses a count if given samples leave so little open that it takes a radius with which the whole could not be
    /// filled: the work grows with the whole.
    fn check_work(&self, radius: f64, count: usize) -> Result<()>;

    /// The refusal of any count where nothing is open: given samples cover everything.
    fn no_place(&self, count: usize) -> Error {
        covered_by_given(count, Self::NAMES[1])
    }

    /// The samples with those that a fill at this radius adds, which are last, and the number of darts thrown.
    fn fill(
        &self,
        job: &Job,
        options: LevelOptions,
        radius: f64,
        samples: &[Self::Sample],
    ) -> Result<(Vec<Self::Sample>, u64)>;
}

/// The options of the fill of a level.
#[derive(Clone, Copy)]
pub struct LevelOptions {
    pub seed: u64,
    /// True if first darts are thrown: where samples cover little.
    pub throws_first: bool,
    /// The largest rank of the samples that are added; none on the first level, where ranks are infinite.
    pub largest_rank: Option<f64>,
}

/// A sample with a rank.
pub trait Ranked {
    /// The order of samples of equal rank.
    type Place: Ord;

    fn rank(&self) -> f32;

    fn place(&self) -> Self::Place;
}

/// A set of samples that is refined, level by level.
pub struct Levels<S: Levelled> {
    pub surface: S,
    seed: u64,
    /// The samples, those of the last level last.
    pub samples: Vec<S::Sample>,
    /// The radius of the last level; infinite before the first.
    radius: f64,
    /// Darts thrown so far.
    pub darts: u64,
}

impl<S: Levelled> Levels<S> {
    /// A set without levels.
    pub fn new(surface: S, seed: u64) -> Self {
        Self { surface, seed, samples: Vec::new(), radius: f64::INFINITY, darts: 0 }
    }

    /// Levels whose first one, number 0, was made in another way: with infinite ranks, by so many darts.
    pub fn begun(self, samples: Vec<S::Sample>, radius: f64, darts: u64) -> Self {
        Self { samples, radius, darts, ..self }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The radius of the last level: everything is covered within it. Infinite before the first level.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Adds a level of a smaller radius. `key` selects its random numbers. The samples of the first level have infinite
    /// ranks.
    pub fn refine(&mut self, job: &Job, radius: f64, key: u64) -> Result<()> {
        let former = std::mem::replace(&mut self.radius, radius);
        let options = LevelOptions {
            seed: hash(self.seed, Draw::Level, &[key]),
            throws_first: former > FIRST_DARTS_FROM * radius,
            largest_rank: former.is_finite().then_some(below(former).min(LARGEST_RANK * radius)),
        };
        let (samples, darts) = self.surface.fill(job, options, radius, &self.samples)?;
        (self.samples, self.darts) = (samples, self.darts + darts);
        Ok(())
    }

    /// Removes the last level: the state before it had so many samples and this radius.
    pub fn take_back(&mut self, len: usize, radius: f64) {
        self.samples.truncate(len);
        self.radius = radius;
    }

    /// The samples by decreasing rank, those of equal rank by position.
    pub fn into_sorted(self) -> Vec<S::Sample> {
        let Self { mut samples, .. } = self;
        samples.sort_unstable_by(|a, b| b.rank().total_cmp(&a.rank()).then_with(|| a.place().cmp(&b.place())));
        samples
    }

    /// The smallest of the `count` largest ranks; there are as many.
    pub fn rank_of(&self, count: usize) -> f64 {
        let mut ranks: Vec<f32> = self.samples.iter().map(Ranked::rank).collect();
        let (_, &mut rank, _) = ranks.select_nth_unstable_by(count - 1, |a, b| b.total_cmp(a));
        f64::from(rank)
    }
}

/// The largest rank below those of a level of this radius, so that sorted ranks keep levels apart.
fn below(radius: f64) -> f64 {
    f64::from(rounded_down(radius).next_down())
}

/// Levels, down to a radius.
struct Ladder<S: Levelled> {
    levels: Levels<S>,
    quotient: f64,
    /// The quotient of the first levels, until one has too many samples.
    first: Option<f64>,
    /// The smallest radius of a level.
    finest: f64,
    /// The number of the next level.
    key: u64,
    /// The radius at which all work is expected to be done, and the share that is done.
    last: f64,
    done: f64,
}

impl<S: Levelled> Ladder<S> {
    fn new(levels: Levels<S>, quotient: f64, finest: f64, last: f64) -> Self {
        let first = Some(power(quotient, first_stride(quotient)));
        Self { levels, quotient, first, finest, key: 0, last, done: 0.0 }
    }

    /// The radius of the next level, if that has no more samples than the first levels may have.
    fn next(&self) -> f64 {
        let former = self.levels.radius();
        let next =
            if former.is_finite() { former / self.first.unwrap_or(self.quotient) } else { self.levels.surface.top() };
        next.max(self.finest)
    }

    /// Adds a level.
    fn descend(&mut self, job: &Job) -> Result<()> {
        let (len, former) = (self.levels.len(), self.levels.radius());
        self.add(job)?;
        if self.first.is_some() && former.is_finite() && self.levels.len() > Order::FIRST_COUNT {
            self.levels.take_back(len, former);
            (self.first, self.key) = (None, self.key - 1);
            self.add(job)?;
        }
        Ok(())
    }

    /// Adds a level of the next radius. The work done by then grows as the samples do.
    fn add(&mut self, job: &Job) -> Result<()> {
        let radius = self.next();
        let done = power(self.last / radius, S::DIMENSION).clamp(self.done, 1.0);
        self.levels.refine(&job.part(self.done, done), radius, self.key)?;
        (self.key, self.done) = (self.key + 1, done);
        Ok(())
    }
}

/// A maximal set of a radius: the levels above it, and one at the radius itself.
pub fn by_radius<S: Levelled>(
    job: &Job,
    levels: Levels<S>,
    quotient: f64,
    radius: f64,
) -> Result<LevelledSet<S::Sample>> {
    let mut ladder = Ladder::new(levels, quotient, radius, radius);
    while ladder.levels.radius() > radius {
        ladder.descend(job)?;
    }
    let darts = ladder.levels.darts;
    Ok(LevelledSet { samples: ladder.levels.into_sorted(), radius, covering_radius: radius, darts })
}

/// The first `count` samples of the ladder. No radius is below the finest.
pub fn by_count<S: Levelled>(
    job: &Job,
    levels: Levels<S>,
    quotient: f64,
    count: usize,
    finest: f64,
) -> Result<LevelledSet<S::Sample>> {
    let expected = expected_radius(&levels.surface, count as f64, finest);
    let mut ladder = Ladder::new(levels, quotient, finest, expected);
    loop {
        let former = ladder.levels.radius();
        if former == finest {
            return Err(none_finer::<S>(count, ladder.levels.len(), finest));
        }
        ladder.levels.surface.check_work(ladder.next(), count)?;
        ladder.descend(job)?;
        if ladder.levels.len() == 0 {
            return Err(ladder.levels.surface.no_place(count));
        }
        if ladder.levels.len() >= count {
            return Ok(LevelledSet::cut(ladder.levels, count, former));
        }
    }
}

/// The largest accepted ratio of the covering radius of a set to its radius.
const LOOSE: f64 = 1.1;
/// The number of levels that may be removed to achieve that ratio.
const ATTEMPTS: u32 = 40;
/// The share of the count that all levels but the last one aim at.
const AIM: f64 = 0.96;
/// The largest quotient between the radius at which the last level begins and that at which the count is expected.
const NEAR: f64 = 1.0475;
/// The quotient by which the last level ends below that radius, since nested sets are sparser than others.
const BEYOND: f64 = 1.05;
const _: () = assert!(NEAR * BEYOND <= LOOSE);

/// A set that is made of levels.
pub struct LevelledSet<S> {
    pub samples: Vec<S>,
    /// A lower bound of the distance of two samples.
    pub radius: f64,
    /// An upper bound of the distance of a place of the surface from the nearest sample.
    pub covering_radius: f64,
    pub darts: u64,
}

impl<S: Ranked> LevelledSet<S> {
    /// The best samples of some levels, which have enough; all levels but the last cover the surface within `former`.
    pub fn cut(levels: Levels<impl Levelled<Sample = S>>, count: usize, former: f64) -> Self {
        let (len, last, darts) = (levels.len(), levels.radius(), levels.darts);
        let mut samples = levels.into_sorted();
        samples.truncate(count);
        let rank = samples.last().map_or(last, |sample| f64::from(sample.rank()));
        let covering_radius = if len == count { last } else { former };
        Self { samples, radius: if rank.is_finite() { rank } else { last }, covering_radius, darts }
    }
}

/// A radius, and the number of samples of a set of this radius.
#[derive(Clone, Copy)]
struct Counted {
    radius: f64,
    len: usize,
}

/// The radius of the first level on the way to exactly `count` samples.
pub fn first_radius(surface: &impl Levelled, count: usize, finest: f64) -> f64 {
    // Small sets may have more samples than expected: along open boundaries.
    let count = count as f64;
    expected_radius(surface, AIM * count / (1.0 + 2.0 / count.sqrt()), finest)
}

/// Exactly `count` samples. Levels that have begun have fewer.
pub fn exactly<S: Levelled>(
    job: &Job,
    mut levels: Levels<S>,
    count: usize,
    finest: f64,
) -> Result<LevelledSet<S::Sample>> {
    let mut above: Option<Counted> = None;
    let mut taken_back = 0;
    for key in u32::from(levels.len() > 0).. {
        let former = Counted { radius: levels.radius(), len: levels.len() };
        if former.radius == finest {
            return Err(none_finer::<S>(count, former.len, finest));
        }
        let radius = next_radius(&levels, above, taken_back, count, finest).max(finest);
        let part = job.part(1.0 - power(0.4, key), 1.0 - power(0.4, key + 1));
        levels.surface.check_work(radius, count)?;
        levels.refine(&part, radius, key as u64)?;
        let len = levels.len();
        if len == 0 {
            return Err(levels.surface.no_place(count));
        }
        if len < count {
            // The counts known for smaller radii may no longer hold, since sets vary.
            above = above.filter(|above| above.radius < radius);
        } else if len == count
            || former.len > 0 && (former.radius <= LOOSE * levels.rank_of(count) || taken_back >= ATTEMPTS)
        {
            return Ok(LevelledSet::cut(levels, count, former.radius));
        } else {
            levels.take_back(former.len, former.radius);
            above = Some(Counted { radius, len });
            taken_back += 1;
        }
    }
    unreachable!("radii end at the finest")
}

/// The radius of the next level.
fn next_radius<S: Levelled>(
    levels: &Levels<S>,
    above: Option<Counted>,
    taken_back: u32,
    count: usize,
    finest: f64,
) -> f64 {
    let (top, root) = (levels.surface.top(), root::<S>);
    let below = match levels.len() {
        // One sample covers the mesh.
        0 if count == 1 => return top,
        0 if above.is_none() => return first_radius(&levels.surface, count, finest),
        0 => Counted { radius: top, len: 1 },
        len => Counted { radius: levels.radius(), len },
    };
    let growth = root(count as f64 / below.len as f64);
    match above {
        None if growth <= NEAR => below.radius / (growth * BEYOND),
        None => below.radius / (growth * root(AIM)),
        Some(above) if below.radius <= LOOSE * above.radius => {
            if levels.len() == 0 {
                top
            } else {
                above.radius
            }
        }
        // Between the known counts on both sides, on the line through their logarithms, and occasionally in the middle.
        Some(above) => {
            let logarithm = |count: f64| log(count / below.len as f64);
            let share = logarithm(AIM * count as f64) / logarithm(above.len as f64);
            let share = if taken_back.is_multiple_of(3) { 0.5 } else { share.clamp(0.02, 0.98) };
            below.radius * exp(share * log(above.radius / below.radius))
        }
    }
}

/// The radius at which so many samples are expected, by areas and edges alone.
fn expected_radius(surface: &impl Levelled, count: f64, finest: f64) -> f64 {
    let (mut low, mut high) = (finest, surface.top().max(finest));
    while high > 1.001 * low {
        let middle = (low * high).sqrt();
        if surface.expected(middle) > count { low = middle } else { high = middle }
    }
    high
}

/// The ratio of the radii of two sets, given that of their counts.
fn root<S: Levelled>(ratio: f64) -> f64 {
    match S::DIMENSION {
        2 => ratio.sqrt(),
        dimension => exp(log(ratio) / f64::from(dimension)),
    }
}

/// The refusal of any count where given samples cover everything.
pub fn covered_by_given(count: usize, ground: &str) -> Error {
    Error::invalid("count", format!("{count}, but given samples cover all of the {ground}"))
}

/// The refusal of a count for which the precision of floats is too low.
fn none_finer<S: Levelled>(count: usize, len: usize, finest: f64) -> Error {
    let reason = format!(
        "{count} samples are more than the {} can carry: {len} at radius {finest:?}, the smallest",
        S::NAMES[0]
    );
    Error::invalid("count", reason)
}
