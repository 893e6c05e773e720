//! Progressive order: nested maximal sets, coarse to fine, each filled around the one before.
//!
//! Not in the thesis. The radii of the levels fall by a quotient (see The ladder below); the coarsest level is a set of
//! KDRT or [`maximal`](crate::maximal), every other one fills the part that those before leave uncovered (see Levels
//! below). The *rank* of a sample is its distance to the nearest sample that was there when it was accepted, and a set
//! is sorted by falling rank.
//!
//! # The guarantee for every prefix
//! Of two samples of a prefix one was there before the other, which then has a rank of at most their distance: no two
//! are closer than the last rank. A level covers the domain within its radius R, and all ranks of the next one are at
//! least R / quotient: a prefix that ends within the next level, and has a last rank of at least that, covers within
//! the quotient times the last rank. The ranks of a level are below the radius of the one before, so they never rise.
//! The first levels, up to [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples, have a larger quotient.
//!
//! # Parts
//! Each level is made by windows of blocks (`tiling.rs`): a part of a level depends on the levels before in a part that
//! is larger by a margin of about 12 of its radii (`stack.rs`).

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::kdrt::{
    blocks::Blocks,
    conquer::SeamCells,
    fill::{Filling, Footprints},
    options::{Options, Progressive},
    region::{Part, Placed, TiledSamples},
    stack::{Base, Cached, Layer, Stack, images},
    tiling::{cut, is_wide},
};
use crate::math::{exp2, hypot, log2, pow, rounded_down};
use crate::order::{Order, first_stride};
use crate::plane::{CellAxis, CellGrid, GivenDisks, Lattice, Quadtree, Rect};
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, Rng, hash};

/// The most bytes that a sample takes while levels are made.
pub const BYTES_PER_SAMPLE: f64 = 70.0;

/// The share of the progress of a count that the coarsest level takes.
const COARSEST_SHARE: f64 = 0.05;

/// A retained plane stores the whole of the levels that have no more samples than this: the number that a window needs
/// of its surroundings in each level at a quotient of 2^(1/8).
const KEPT_SAMPLES: f64 = 65_536.0;

/// A sample of the coarsest level, to be moved to its position.
const COARSEST: Sample = Sample { point: [0; 2], square: i64::MAX };

/// A sample of a level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub point: [i32; 2],
    /// The squared distance to the nearest sample that was there when it was accepted, in lattice units. The largest
    /// number for those of the coarsest level.
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
    around: Arc<GivenDisks>,
) -> Result<(Stack<Level>, f64)> {
    let &Options { domain, seed, .. } = options;
    let finest = Lattice::of_any_size(&domain, radius)?;
    let radii = radii(&domain, radius, levels);
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

/// The radii of the levels of a domain, from the coarsest to that of the set.
pub fn radii(domain: &Domain, radius: f64, levels: &Progressive) -> Vec<f64> {
    let longest = longest(domain);
    let from = if levels.coarsest.is_finite() { levels.coarsest } else { octaves_above(radius, longest) };
    let ladder = Ladder::new(from, levels.quotient, domain.extent());
    ladder.down_to(ladder.step_above(longest), radius)
}

/// Puts samples in order, at their positions. Those of the coarsest level have the given rank.
pub fn ordered(
    lattice: &Lattice,
    coarsest: f64,
    mut samples: Vec<Sample>,
    position: impl Fn([i32; 2]) -> [f32; 2],
) -> Points<2> {
    samples.sort_unstable_by(|a, b| {
        b.square.cmp(&a.square).then(a.point[1].cmp(&b.point[1])).then(a.point[0].cmp(&b.point[0]))
    });
    let rank = |square: i64| if square == i64::MAX { coarsest } else { lattice.length(square) };
    Points {
        ranks: samples.iter().map(|sample| rounded_down(rank(sample.square))).collect(),
        positions: samples.iter().map(|sample| position(sample.point)).collect(),
        ..Points::default()
    }
}

impl Coarsest {
    fn new(job: &Job, options: &Options, radius: f64, around: Arc<GivenDisks>) -> Result<Self> {
        let &Options { domain, leaf_size, seed, .. } = options;
        let longest = longest(&domain);
        // A radius that spans the domain gives one sample, the same for all such radii.
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
        let known = TiledSamples::new(whole, &samples, level.radius());
        // A level may have fewer samples than expected, but progress does not fall.
        let expected = (samples.len() as f64 * quotient * quotient / count as f64).min(1.0);
        let next = done.max(COARSEST_SHARE + (1.0 - COARSEST_SHARE) * expected);
        samples.extend(level.fill(&job.part(done, next), &known, &whole)?);
        (before, done) = (finer, next);
    }
    let mut points = ordered(&lattice, rank, samples, |point| lattice.position(point));
    points.positions.truncate(count);
    points.ranks.truncate(count);
    Ok(points)
}

/// The seed of a level by its number.
fn level_seed(seed: u64, step: u64) -> u64 {
    hash(seed, Draw::Level, &[step])
}

/// The diagonal of a domain: no two points are farther apart.
pub fn longest(domain: &Domain) -> f64 {
    let [width, height] = domain.extent();
    hypot(width, height)
}

// # The ladder
//
// The ladder: the radii of the levels of a progressive order, from coarse to fine.
//
// The radii fall by the quotient, but not from the first sample on: as long as no level can have more than
// [`Order::FIRST_COUNT`] samples, steps of the ladder are left out (see [`first_stride`]).

/// The difference from a root of two below which a quotient is meant as one.
const ROOT: f64 = 1e-9;

/// A radius that is longer than another by no more than this share is the same radius, rounded.
const ROUNDING: f64 = 1e-9;

/// The radii `coarsest / quotient^k`, without some of the first.
///
/// If the quotient is a root of two, every octave has the same radii to the bit, halved: so a radius that is a power of
/// two times another one is in the ladder of the other exactly.
pub struct Ladder {
    coarsest: f64,
    quotient: f64,
    /// Levels per octave, if the quotient is a root of two.
    per_octave: Option<usize>,
    /// Before the step `dense` only every `stride`-th step is taken: no set of their radii has more than
    /// [`Order::FIRST_COUNT`] samples.
    dense: usize,
    stride: usize,
}

impl Ladder {
    /// The ladder of a domain of this extent.
    pub fn new(coarsest: f64, quotient: f64, extent: [f64; 2]) -> Self {
        let roots = log2(quotient).recip().round();
        let is_root = (exp2(roots.recip()) - quotient).abs() < ROOT;
        let per_octave = is_root.then_some(roots as usize);
        let stride = first_stride(quotient) as usize;
        let all = Self { coarsest, quotient, per_octave, dense: 0, stride };
        // A multiple of the stride: one of the first radii, too, is in the ladder of half of it.
        Self { dense: all.step_above(crowded_radius(extent)) / stride * stride, ..all }
    }

    /// A radius, by the number of steps before it with none left out.
    pub fn radius(&self, step: usize) -> f64 {
        match self.per_octave {
            Some(steps) => {
                let part = exp2(-((step % steps) as f64) / steps as f64);
                self.coarsest * part * exp2(-((step / steps) as f64))
            }
            None => self.coarsest * pow(self.quotient, -(step as f64)),
        }
    }

    /// The last step whose radius is not below `length`; the first one if there is none.
    pub fn step_above(&self, length: f64) -> usize {
        (0..).find(|&step| self.radius(step + 1) < length).unwrap_or(0)
    }

    /// The radii from a step on, without end.
    pub fn radii(&self, first: usize) -> impl Iterator<Item = f64> {
        let is_taken =
            move |&step: &usize| step == first || step >= self.dense || (self.dense - step).is_multiple_of(self.stride);
        (first..).filter(is_taken).map(|step| self.radius(step))
    }

    /// The radii from a step on that are longer than `finest`, and `finest` itself.
    pub fn down_to(&self, first: usize, finest: f64) -> Vec<f64> {
        let longer = self.radii(first).take_while(|&radius| radius > finest * (1.0 + ROUNDING));
        longer.chain([finest]).collect()
    }
}

/// No more than [`Order::FIRST_COUNT`] samples of a rectangle, or of a torus of its size, are so far apart: by Oler's
/// inequality (1961) there are at most 2/sqrt(3) area / r^2 + perimeter / (2 r) + 1 at distances of at least r.
pub fn crowded_radius([width, height]: [f64; 2]) -> f64 {
    let (square, linear, others) =
        (2.0 / 3f64.sqrt() * width * height, width + height, Order::FIRST_COUNT as f64 - 1.0);
    (linear + (linear * linear + 4.0 * square * others).sqrt()) / (2.0 * others)
}

/// The smallest power of two times `radius` that is not below `length`.
pub fn octaves_above(radius: f64, length: f64) -> f64 {
    let mut coarsest = radius;
    while coarsest < length {
        coarsest *= 2.0;
    }
    coarsest
}

// # Levels
//
// A level: the part that is farther than its radius from the samples of the levels before is filled around them, by the
// blocks and phases of KDRT (`blocks.rs`).
//
// A new sample stores the distance to the nearest sample that existed when it was accepted: one of the levels before,
// of its own block, or of a block of an earlier phase. Some sample of the levels before is nearer than their radius,
// which is at most 1.5 times that of this level, and blocks of one phase are farther apart than that; so the order in
// which these are filled does not matter to the distance either. The radii of the first levels fall faster: they are
// filled as a whole.

/// Fill blocks along the side of the windows that are filled at once.
const WINDOW_BLOCKS: i32 = 256;

/// A level of a plane.
pub struct Level {
    lattice: Lattice,
    axes: [CellAxis; 2],
    /// The largest distance along an axis to the nearest sample of the levels before.
    sight: i32,
    /// The radius of the level before.
    before: f64,
    /// The largest number of samples in the whole domain of a level that a retained plane stores as a whole.
    most_kept: f64,
    /// None for one of the first levels, and on a torus on which blocks could see themselves: these are filled as a
    /// whole.
    blocks: Option<Blocks>,
    /// Some where cells are as wide as footprints require.
    footprints: Option<Footprints>,
    seed: u64,
    around: Arc<GivenDisks>,
}

impl Level {
    /// The level of a lattice's radius, after one of the longer radius `before`, in lattice units.
    pub fn new(lattice: Lattice, before: &Lattice, seed: u64, around: Arc<GivenDisks>, most_kept: f64) -> Self {
        let axes = lattice.size.map(|size| CellAxis::new(size, lattice.radius));
        let is_wide = is_wide(&lattice);
        // With a margin, as radii are rounded.
        let is_first = lattice.radius > crowded_radius(lattice.size.map(f64::from)) * (1.0 - 1e-6);
        let is_cut = !is_first && (is_wide || lattice.boundary == Boundary::Bounded);
        let blocks = is_cut.then(|| Blocks::new(&lattice, seed));
        let sides = [0, 1].map(|axis: usize| axes[axis].side());
        Self {
            sight: before.separation.reach,
            before: before.radius,
            most_kept,
            footprints: is_wide.then(|| Footprints::new(lattice.radius, sides)),
            axes,
            blocks,
            seed,
            around,
            lattice,
        }
    }

    /// The radius in lattice units.
    pub fn radius(&self) -> f64 {
        self.lattice.radius
    }

    /// The lattice points whose samples a window of blocks depends on.
    fn known(&self, blocks: &Blocks, window: &Rect) -> Rect {
        let rect = blocks.rect(&blocks.filled(window)).grown(self.sight);
        match self.lattice.boundary {
            Boundary::Periodic => rect,
            Boundary::Bounded => rect.intersection(&self.lattice.rect()),
        }
    }

    /// The samples of this level in a window of blocks, as far as they lie in `rect`.
    fn fill_window(&self, blocks: &Blocks, before: &TiledSamples<Sample>, window: &Rect, rect: &Rect) -> Vec<Sample> {
        let known = self.known(blocks, window);
        let mut grid = CellGrid::new(&self.axes, &known, self.lattice.separation);
        grid.set_obstacles(self.around.near(&known));
        before.visit(&known, |sample| grid.insert(grid.cell(sample.point), sample.point));
        let rect = blocks.rect(window).intersection(rect);
        let mut samples = Vec::new();
        let mut accepted = |grid: &CellGrid, point| {
            if rect.contains(point) {
                samples.push(Sample { point, square: grid.nearest_square(point, self.sight) });
            }
        };
        match &self.footprints {
            Some(footprints) => {
                let mut filling = Filling::new(footprints, SeamCells::all(&grid), self.lattice.separation.reach);
                blocks.in_phases(&mut grid, window, |grid, block, place| {
                    filling.fill(grid, block, || blocks.rng(place), &mut accepted);
                });
            }
            None => blocks.in_phases(&mut grid, window, |grid, block, place| {
                Quadtree::of_empty_cells(grid, block.rect).fill(grid, &mut blocks.rng(place), &mut accepted);
            }),
        }
        samples
    }

    /// Fills the domain as a whole.
    fn fill_whole(&self, job: &Job, before: &TiledSamples<Sample>) -> Result<Vec<Sample>> {
        let (rect, separation) = (self.lattice.rect(), self.lattice.separation);
        let grid_before = || {
            let mut grid = match self.lattice.boundary {
                Boundary::Periodic => CellGrid::torus(&self.axes, separation),
                Boundary::Bounded => CellGrid::new(&self.axes, &rect, separation),
            };
            grid.set_obstacles(self.around.near(&rect));
            before.samples().iter().for_each(|sample| grid.insert(grid.cell(sample.point), sample.point));
            grid
        };
        let (mut grid, mut points) = (grid_before(), Vec::new());
        let mut rng = Rng::at(self.seed, Draw::Darts, &[]);
        let expected = self.lattice.expected_samples();
        Quadtree::of_empty_cells(&grid, rect)
            .fill_domain(job, &mut grid, &mut rng, expected, |point| points.push(point))?;

        // Inserted again in their order, for the distances.
        let mut grid = grid_before();
        let samples = points.into_iter().map(|point| {
            let square = self.nearest_square(&grid, point);
            grid.insert(grid.cell(point), point);
            Sample { point, square }
        });
        Ok(samples.collect())
    }

    /// The squared distance to the nearest sample of the whole domain.
    fn nearest_square(&self, grid: &CellGrid, point: [i32; 2]) -> i64 {
        let [x, y] = point;
        let around = Rect { min: point, max: [x + 1, y + 1] }.grown(self.sight);
        // A part that spans a torus has every sample once, and the nearest image of each is to be found.
        let part = Part::new(&self.lattice, &around);
        let whole = Part::whole(&self.lattice);
        let square = |sample: [i32; 2]| -> i64 {
            let along = |axis: usize| {
                let along = (sample[axis] - point[axis]).abs();
                let nearest = match self.lattice.boundary {
                    Boundary::Periodic => along.min(self.lattice.size[axis] - along),
                    Boundary::Bounded => along,
                };
                i64::from(nearest).pow(2)
            };
            along(0) + along(1)
        };
        let pieces = whole.images(&part.rect);
        let squares = pieces.flat_map(|(piece, _)| grid.samples_in(&piece)).map(square);
        squares.min().unwrap_or(i64::MAX)
    }
}

impl Cached for Level {
    fn blocks(&self) -> Option<&Blocks> {
        self.blocks.as_ref()
    }
}

impl Layer for Level {
    type Sample = Sample;

    fn is_kept(&self) -> bool {
        self.expected(&Part::whole(&self.lattice)) <= self.most_kept
    }

    fn expected(&self, part: &Part) -> f64 {
        self.lattice.samples_in(&part.rect)
    }

    fn around(&self, part: &Part) -> Part {
        match &self.blocks {
            Some(blocks) => Part::new(&self.lattice, &self.known(blocks, &blocks.holding(&part.rect))),
            None => Part::whole(&self.lattice),
        }
    }

    fn sorted(&self, part: Part, before: &[Sample]) -> TiledSamples<Sample> {
        TiledSamples::new(part, before, self.before.min(self.radius() * 2.0))
    }

    fn fill(&self, job: &Job, before: &TiledSamples<Sample>, part: &Part) -> Result<Vec<Sample>> {
        let Some(blocks) = &self.blocks else {
            let samples = self.fill_whole(job, before)?;
            return Ok(TiledSamples::new(Part::whole(&self.lattice), &samples, self.radius()).samples_of(part));
        };
        let windows = cut(&blocks.holding(&part.rect), WINDOW_BLOCKS);
        job.flat_map(windows.len(), |i| self.fill_window(blocks, before, &windows[i], &part.rect))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Larger than in practice, so that the coarsest levels of the tests have many samples.
    const LARGE: [f64; 2] = [1e4; 2];

    #[test]
    fn radii_fall_by_the_quotient_to_the_finest() {
        for quotient in [1.02, 1.05, 2f64.powf(0.125), 2f64.powf(0.25), 1.3, 2f64.sqrt(), 1.5] {
            for (coarsest, finest) in [(1.5, 0.01), (0.064, 0.001), (3.0, 3.0), (0.02, 0.0199)] {
                let radii = Ladder::new(coarsest, quotient, LARGE).down_to(0, finest);
                assert_eq!((radii[0], *radii.last().unwrap()), (coarsest, finest));
                assert!(radii.windows(2).all(|pair| pair[1] < pair[0] && pair[0] / pair[1] < quotient * (1.0 + 1e-12)));
                let fewest = (coarsest / finest).ln() / quotient.ln();
                assert!((radii.len() as f64 - 1.0 - fewest.ceil()).abs() < 1.5, "{quotient} {coarsest} {finest}");
            }
        }
    }

    /// The ladder goes down to the radius at which there may be so many samples, and no further.
    #[test]
    fn the_first_radii_fall_by_about_two() {
        for extent in [[1.0, 1.0], [1.0, 0.01], [1e-9, 3.0], [70.0, 40.0]] {
            let crowded = crowded_radius(extent);
            let samples =
                2.0 / 3f64.sqrt() * extent[0] * extent[1] / crowded.powi(2) + (extent[0] + extent[1]) / crowded;
            assert!((samples - 99.0).abs() < 1e-9);
            for quotient in [1.02, 1.05, 2f64.powf(0.125), 1.1, 1.19, 2f64.powf(0.25), 1.3, 2f64.sqrt(), 1.5] {
                let coarsest = extent[0].hypot(extent[1]);
                let radii = Ladder::new(coarsest, quotient, extent).down_to(0, 1e-3 * crowded);
                let quotients: Vec<_> = radii.windows(2).map(|pair| pair[0] / pair[1]).collect();
                let dense = quotients.iter().rposition(|&found| found > quotient * (1.0 + 1e-9)).unwrap() + 1;
                let largest = quotient.powi(2).max(2.0) * (1.0 + 1e-9);
                assert!(radii[dense] >= crowded && radii[dense] < crowded * largest && radii[0] == coarsest);
                assert!(
                    quotients[..dense].iter().all(|&found| found <= largest && found * quotient > largest.min(2.0))
                );
            }
        }
    }

    #[test]
    fn an_octave_repeats_to_the_bit() {
        for (steps, quotient) in [(2, 2f64.sqrt()), (4, 2f64.powf(0.25)), (8, 1.0905077326652577)] {
            let ladder = Ladder::new(0.3, quotient, [0.2, 0.1]);
            assert_eq!(ladder.per_octave, Some(steps));
            assert!((0..200).all(|step| ladder.radius(step) == 2.0 * ladder.radius(step + steps)));
            for finest in [0.15, 0.0375, 0.0375 / 4.0] {
                let (short, long) = (ladder.down_to(0, finest), ladder.down_to(0, finest / 4.0));
                assert_eq!(short[..], long[..short.len()]);
            }
        }
        assert_eq!(Ladder::new(0.3, 1.1, LARGE).per_octave, None);
    }

    #[test]
    fn what_is_longer_than_the_domain_is_left_out() {
        let ladder = Ladder::new(octaves_above(0.01, 1.3), 2f64.powf(0.25), [1.0; 2]);
        let first = ladder.step_above(1.3);
        assert!(ladder.radius(first) >= 1.3 && ladder.radius(first + 1) < 1.3);
        assert_eq!(Ladder::new(1.0, 1.2, LARGE).step_above(1.3), 0);
        assert_eq!(octaves_above(0.4, 0.3), 0.4);
    }
}
