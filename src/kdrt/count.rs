//! Exactly N samples (thesis §2.5.3), and still a maximal set.
//!
//! Departure: the thesis makes about N samples and then inserts the rest into the largest triangles, which brings
//! samples closer together than the radius, or eliminates the surplus, which leaves gaps. Here a set of about N samples
//! is changed in small places only (see Tuning below): the samples of a small region are removed and it is refilled, as
//! KDRT fills its gaps, until it holds as many more or fewer as wanted. Radius and coverage are kept.

use std::cmp::Reverse;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress, chunks_of};
use crate::kdrt::{
    options::{DEFAULT_LEAF_SIZE, Options, Progressive, check_leaf_size},
    progressive,
    stack::{self, Base},
};
use crate::math::{exp, hypot, log, power};
use crate::plane::{CellAxis, CellGrid, Lattice, Quadtree, Rect};
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY, Points};
use crate::rng::{Draw, Rng, hash};
use crate::setters::setters;

/// The number of radii that are tried before a set that is not maximal is accepted. A maximal set of any number of
/// samples exists: put each where the domain is farthest from those before it. More than a dozen attempts at one set
/// were never observed.
const ATTEMPTS: u64 = 64;

/// The most bytes that a sample takes, in two sets and the plots that are remade; and in progressive order.
const BYTES_PER_SAMPLE: f64 = 12.0;
const FIRST_BYTES_PER_SAMPLE: f64 = 78.0;

/// The share of the remaining progress that the current attempt takes.
const ATTEMPT_SHARE: f64 = 0.9;

/// The share of an attempt that making the set takes; the rest is for tuning it.
const SAMPLING_SHARE: f64 = 0.7;

/// The options of a set with a given number of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CountOptions {
    /// The number of samples: at least 1.
    pub count: u64,
    /// The domain to sample, as in [`Options`](super::Options).
    pub domain: Domain,
    /// The shortest side of a leaf in radii, as in [`Options`](super::Options).
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// The levels of a set in progressive order; none, the default, for an arbitrary order. The sets of all counts with
    /// the same levels are prefixes of each other. The coarsest must not have more samples than asked for; infinity,
    /// its default, or any radius that is longer than the diagonal of the domain, stands for this diagonal.
    pub levels: Option<Progressive>,
}

impl CountOptions {
    /// `count` samples on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`], seed 0 and in an arbitrary order.
    pub fn new(count: u64) -> Self {
        Self { count, domain: Domain::unit(Boundary::Periodic), leaf_size: DEFAULT_LEAF_SIZE, seed: 0, levels: None }
    }
}

setters!(CountOptions {
    count: u64,
    domain: Domain,
    leaf_size: f64,
    seed: u64,
    levels: Option<Progressive>,
});

/// The report of [`sample_count`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CountReport {
    /// The radius: no two samples are closer.
    pub radius: f64,
    /// True if the set is maximal for this radius: where a maximal set of this size was found. False in progressive
    /// order, where the domain is covered within the quotient times the radius.
    pub is_maximal: bool,
}

/// A maximal Poisson-disk set of exactly `count` samples, in parallel.
///
/// The radius follows from the density of maximal sets and is corrected when the count of the set made with it is off
/// by more than chance. The remaining difference, mostly up to 0.3 % and with fewer than 10,000 samples up to about
/// their square root, is removed by remaking small regions. The result keeps what [`sample`](super::sample) promises,
/// for the radius in the report: conflict-free, and maximal within the same tolerance. Many radii are possible, over a
/// range that is the wider the fewer the samples; the first one found is taken. The radius of a single sample is one
/// with which it covers the domain.
///
/// If no maximal set is found, which did not occur in 100,000 sets of few samples, the most crowded samples of a larger
/// set are dropped and the report says that the set is not maximal.
/// [`covering_radius_2d`](crate::analysis::coverage::covering_radius_2d) gives the exact largest distance of the domain
/// from the samples.
///
/// In progressive order the samples are the first ones of a set whose coarsest radius depends on the domain only
/// ([`CountOptions::levels`]), so that sets of smaller counts are prefixes; the radius in the report is the last
/// rank.
///
/// Without levels the order is that of [`sample`](super::sample), with remade samples in the places of those removed.
/// The result is the same for every number of threads. O(n) like [`sample`](super::sample), which is called once or a
/// few times.
///
/// # Errors
/// [`Error::InvalidArgument`] for an argument out of range, and for `count` where floats are too coarse for the radius
/// of so many samples; [`Error::TooLarge`] above 2^32 samples or the available memory; both before any work, unless the
/// expected radius is barely above the limit; [`Error::Cancelled`].
pub fn sample_count(
    context: &Context,
    options: &CountOptions,
    progress: Option<&Progress>,
) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, domain, leaf_size, .. } = options;
    check_leaf_size(leaf_size)?;
    domain.check()?;
    if count == 0 {
        return Err(Error::invalid("count", "0 is not at least 1"));
    }
    let search = Search::new(&domain, leaf_size, count);
    lattice(options, search.radius())?;
    if let Some(levels) = &options.levels {
        levels.check(0.0)?;
        stack::require(count as f64, FIRST_BYTES_PER_SAMPLE, 0, "count")?;
        return context.run(progress, |job| first_of_order(job, options, levels));
    }
    stack::require(count as f64, BYTES_PER_SAMPLE, 0, "count")?;
    context.run(progress, |job| attempt(job, options, search, ATTEMPTS))
}

/// The first samples of a progressive order.
fn first_of_order(job: &Job, options: &CountOptions, levels: &Progressive) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, domain, leaf_size, seed, .. } = options;
    let plane = Options { leaf_size, seed, ..Options::new(f64::NAN).domain(domain) };
    let points = progressive::first(job, &plane, levels, count as usize).map_err(|error| of_count(error, count))?;
    let radius = points.ranks.last().copied().map_or(0.0, f64::from);
    Ok((points, CountReport { radius, is_maximal: false }))
}

/// Makes sets of several radii until one can be tuned; after `limit` of them a larger set is accepted.
fn attempt(job: &Job, options: &CountOptions, mut search: Search, limit: u64) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, leaf_size, seed, .. } = options;
    let mut remaining = 1.0;
    let mut attempts = 0;
    let mut closest: Option<(f64, Vec<[f32; 2]>)> = None;
    loop {
        let job = job.part(1.0 - remaining, 1.0 - remaining * (1.0 - ATTEMPT_SHARE));
        remaining *= 1.0 - ATTEMPT_SHARE;
        let seed = if attempts == 0 { seed } else { hash(seed, Draw::Attempt, &[attempts]) };
        attempts += 1;
        let radius = search.radius();
        let lattice = lattice(options, radius)?;
        let mut samples = Base::sample(&job.part(0.0, SAMPLING_SHARE), &lattice, leaf_size, seed, Arc::default())
            .map_err(|error| of_count(error, count))?;
        let made = samples.len() as u64;
        if search.is_near(made) {
            tune(&job.part(SAMPLING_SHARE, 1.0), &lattice, &mut samples, count, seed)?;
        }
        let difference = samples.len() as i64 - count as i64;
        if difference == 0 {
            return Ok((samples.into(), CountReport { radius, is_maximal: true }));
        }
        search.correct(made);
        if difference > 0 && closest.as_ref().is_none_or(|(_, closest)| samples.len() < closest.len()) {
            closest = Some((radius, samples));
        }
        if attempts >= limit
            && let Some((radius, samples)) = closest.take()
        {
            let samples = thin(&options.domain, samples, count as usize);
            return Ok((samples.into(), CountReport { radius, is_maximal: false }));
        }
    }
}

/// The lattice for a radius that follows from the count.
fn lattice(options: &CountOptions, radius: f64) -> Result<Lattice> {
    Lattice::new(&options.domain, radius).map_err(|error| of_count(error, options.count))
}

/// Turns an error about the radius into one about the count that it follows from.
fn of_count(error: Error, count: u64) -> Error {
    let reason = |reason| format!("{count} asks for a radius that is refused: {reason}");
    match error {
        Error::InvalidArgument { argument: "radius", reason: why } => Error::invalid("count", reason(why)),
        Error::TooLarge { argument: "radius", reason: why } => Error::too_large("count", reason(why)),
        other => other,
    }
}

// # The radius
//
// The radius of a maximal set with a given number of samples, from the density of such sets and from the sets made so
// far.

/// Samples per radius on a line: Rényi's parking constant.
const LINE_DENSITY: f64 = 0.7475979;

/// The share of additional samples at the seams, times the leaf size: 1.4 % for leaves of 6 radii, 0.5 % for 20. It is
/// also applied to small domains, which have no seams: there it is less than chance.
const SEAM_DENSITY: f64 = 0.09;

/// A set is near its count if it differs by less than this share of it, three times the variation among patterns.
const NEAR: f64 = 0.01;

/// A set is also near its count if it differs by less than this many times the square root of it. Counts vary by a
/// quarter of the root.
const NEAR_ROOTS: f64 = 1.5;

/// Secant steps on the logarithms of radius and count.
pub struct Search {
    count: f64,
    radius: f64,
    /// The logarithms of the radius and of the count at the step before.
    last: Option<[f64; 2]>,
}

impl Search {
    /// Begins with the radius at which the density says that there are `count` samples.
    pub fn new(domain: &Domain, leaf_size: f64, count: u64) -> Self {
        let [width, height] = domain.extent();
        let count = count as f64;
        let mut low = (MAXIMAL_DENSITY * (width / count) * height).sqrt();
        let mut high = hypot(width, height).max(low);
        while high > low * (1.0 + 1e-12) {
            let middle = (low * high).sqrt();
            if middle <= low || middle >= high {
                break;
            }
            if expected(domain, leaf_size, middle) > count { low = middle } else { high = middle }
        }
        Self { count, radius: high, last: None }
    }

    /// The radius to try.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// True if a set can be expected to reach the count by small changes.
    pub fn is_near(&self, made: u64) -> bool {
        (made as f64 - self.count).abs() <= (NEAR * self.count).max(NEAR_ROOTS * self.count.sqrt())
    }

    /// Proceeds to the next radius, given `made`, the number of samples made with the last one.
    pub fn correct(&mut self, made: u64) {
        let here = [log(self.radius), log(made as f64)];
        // Counts fall with the square of the radius, on thin domains with the radius; anything else is chance.
        let slope = match self.last {
            Some(last) if here[0] != last[0] => ((here[1] - last[1]) / (here[0] - last[0])).clamp(-2.0, -1.0),
            _ => -2.0,
        };
        self.radius = exp(here[0] + (log(self.count) - here[1]) / slope);
        self.last = Some(here);
    }
}

/// About how many samples a maximal set has: see [`crate::plane::lattice::Lattice::expected_samples`], which this
/// refines.
fn expected(domain: &Domain, leaf_size: f64, radius: f64) -> f64 {
    let beyond = if domain.boundary == Boundary::Bounded { 1.0 } else { 0.0 };
    // A domain thinner than the radius is a line.
    let [width, height] = domain.extent().map(|side| (side / radius + beyond).max(LINE_DENSITY / MAXIMAL_DENSITY));
    MAXIMAL_DENSITY * (1.0 + SEAM_DENSITY / leaf_size) * width * height
}

// # Plots
//
// Plots: the domain cut into rectangles of which each can be changed without regard to the others.
//
// The samples in the *hole* of a plot are removed and others inserted. All points uncovered by this lie within r of the
// hole, and all samples that affect them within 2r: the hole is that far from the edges of its plot, unless nothing
// lies beyond.

/// The shortest side of a plot between two cuts in reaches: a hole of 2 and the 2 on each side of it.
const SIDE: i32 = 6;

/// The cuts of one axis, from a random offset on.
struct Cuts {
    size: i32,
    reach: i32,
    /// Regular plots; a bounded axis has one more, cut in two by its edge.
    count: i32,
    offset: i32,
    /// True if the axis closes to a circle, of which plots are parts.
    is_circle: bool,
    /// True if the axis is a circle too short to be cut: one plot that meets itself.
    is_uncut_circle: bool,
}

/// The interval of an axis that a plot covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The first lattice point; beyond the end of a circle its first points follow.
    pub start: i32,
    pub length: i32,
    /// The first point of the hole and the one after the last, counted from `start`.
    pub hole: [i32; 2],
    /// True if the last point is next to the first.
    pub is_circle: bool,
}

impl Cuts {
    fn new(size: i32, boundary: Boundary, reach: i32, rng: &mut Rng) -> Self {
        let count = size / (SIDE * reach);
        let periodic = boundary == Boundary::Periodic;
        Self {
            size,
            reach,
            count: count.max(1),
            offset: if count > 0 { rng.below((size / count) as u64) as i32 } else { 0 },
            is_circle: periodic && count > 0,
            is_uncut_circle: periodic && count == 0,
        }
    }

    /// The number of plots along the axis; some may be empty.
    fn len(&self) -> i32 {
        if self.is_circle { self.count } else { self.count + 1 }
    }

    /// The start of a regular plot, counted from the offset.
    fn edge(&self, index: i32) -> i32 {
        (i64::from(self.size) * i64::from(index) / i64::from(self.count)) as i32
    }

    /// The plot that a lattice point lies in.
    fn index(&self, point: i32) -> i32 {
        let from_offset =
            i64::from(if self.is_circle { (point - self.offset).rem_euclid(self.size) } else { point - self.offset });
        let regular = (((from_offset + 1) * i64::from(self.count) - 1).div_euclid(i64::from(self.size))) as i32;
        if self.is_circle { regular } else { regular + 1 }
    }

    fn span(&self, index: i32) -> Span {
        let margin = 2 * self.reach;
        if self.is_circle {
            let length = self.edge(index + 1) - self.edge(index);
            let start = self.offset + self.edge(index);
            return Span { start, length, hole: [margin, length - margin], is_circle: false };
        }
        let [start, end] = [index - 1, index].map(|index| (self.offset + self.edge(index)).clamp(0, self.size));
        let length = end - start;
        let first = if start == 0 { 0 } else { margin };
        let last = if end == self.size { length } else { length - margin };
        Span { start, length, hole: [first, last], is_circle: self.is_uncut_circle }
    }
}

/// The plots of a domain in one round.
pub struct Plots {
    axes: [Cuts; 2],
}

/// A plot; its own lattice points count from its corner.
pub struct Plot {
    pub axes: [Span; 2],
    size: [i32; 2],
}

impl Plots {
    /// Cuts the domain at random offsets from `rng`.
    pub fn new(lattice: &Lattice, mut rng: Rng) -> Self {
        Self { axes: lattice.size.map(|size| Cuts::new(size, lattice.boundary, lattice.separation.reach, &mut rng)) }
    }

    /// The number of plots.
    pub fn len(&self) -> usize {
        self.axes.iter().map(|axis| axis.len() as usize).product()
    }

    /// The number of the plot that a lattice point lies in.
    pub fn holding(&self, point: [i32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis: usize| self.axes[axis].index(point[axis]) as usize);
        row * self.axes[0].len() as usize + column
    }

    /// A plot by its number.
    pub fn get(&self, plot: usize) -> Plot {
        let columns = self.axes[0].len() as usize;
        let index = [plot % columns, plot / columns];
        Plot {
            axes: [0, 1].map(|axis: usize| self.axes[axis].span(index[axis] as i32)),
            size: [0, 1].map(|axis: usize| self.axes[axis].size),
        }
    }
}

impl Plot {
    /// The lattice points of the hole.
    pub fn hole(&self) -> Rect {
        Rect { min: self.axes.map(|axis| axis.hole[0]), max: self.axes.map(|axis| axis.hole[1]) }
    }

    /// A lattice point of the domain, counted from the plot's corner.
    pub fn inward(&self, point: [i32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| (point[axis] - self.axes[axis].start).rem_euclid(self.size[axis]))
    }

    /// A lattice point of the plot as one of the domain.
    pub fn outward(&self, point: [i32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| (point[axis] + self.axes[axis].start).rem_euclid(self.size[axis]))
    }
}

// # Tuning
//
// Tuning: small regions of a maximal set are remade until it has the wanted number of samples.
//
// After the idea of disk tuning (Ebeida et al. 2016), which the thesis leaves as future work: removal and refilling
// keep the set conflict-free and maximal, and change its size at random.
//
// A round cuts the domain into plots (see Plots above), remakes some of them, each independently, and accepts the
// changes that bring the number of samples nearer to the wanted one.

/// The number of rounds until a set is given up; three are mostly enough.
const ROUNDS: u64 = 24;

/// The number of attempts at a plot until its number of samples changes as wanted.
const TRIES: u64 = 6;

/// The number of plots remade per missing or surplus sample, and a constant number more.
const PLOTS_PER_SAMPLE: f64 = 2.0;
const MORE_PLOTS: f64 = 16.0;

/// The number of samples that one task assigns to plots.
const SAMPLES_PER_TASK: usize = 1 << 16;

/// The change of a plot: the removed samples, by index, and the positions that replace them.
struct Change {
    removed: Vec<usize>,
    added: Vec<[i32; 2]>,
}

impl Change {
    fn difference(&self) -> i64 {
        self.added.len() as i64 - self.removed.len() as i64
    }

    /// True if the change brings the number of samples nearer to one that is `missing` away, and not beyond.
    fn helps(&self, missing: i64) -> bool {
        let difference = self.difference();
        difference.signum() == missing.signum() && difference.abs() <= missing.abs()
    }
}

/// Brings a maximal set to `count` samples, or as near as possible in [`ROUNDS`].
pub fn tune(job: &Job, lattice: &Lattice, samples: &mut Vec<[f32; 2]>, count: u64, seed: u64) -> Result<()> {
    for round in 0..ROUNDS {
        let mut missing = count as i64 - samples.len() as i64;
        if missing == 0 {
            break;
        }
        let job = job.part(1.0 - power(0.5, round as u32), 1.0 - power(0.5, round as u32 + 1));
        let mut superfluous = Vec::new();
        for change in changes(&job, lattice, samples, missing, hash(seed, Draw::Tune, &[round]))? {
            if change.helps(missing) {
                missing -= change.difference();
                replace(lattice, samples, change, &mut superfluous);
            }
        }
        superfluous.sort_unstable_by_key(|&index| Reverse(index));
        for index in superfluous {
            samples.swap_remove(index);
        }
    }
    Ok(())
}

/// Puts the new samples in the places of those removed, and at the end if there are more; indices still to be removed
/// go to `superfluous`.
fn replace(lattice: &Lattice, samples: &mut Vec<[f32; 2]>, change: Change, superfluous: &mut Vec<usize>) {
    let common = change.removed.len().min(change.added.len());
    for (&index, &point) in change.removed.iter().zip(&change.added) {
        samples[index] = lattice.position(point);
    }
    samples.extend(change.added[common..].iter().map(|&point| lattice.position(point)));
    superfluous.extend(&change.removed[common..]);
}

/// Changes that help, in plots chosen at random and in random order.
fn changes(job: &Job, lattice: &Lattice, samples: &[[f32; 2]], missing: i64, seed: u64) -> Result<Vec<Change>> {
    let plots = Plots::new(lattice, Rng::at(seed, Draw::Tune, &[]));
    let wanted = missing.unsigned_abs() as f64 * PLOTS_PER_SAMPLE + MORE_PLOTS;
    let limit = (wanted / plots.len() as f64 * u64::MAX as f64) as u64;
    // Plots by their random number: those below the limit are chosen.
    let mut chosen: Vec<(u64, usize)> =
        (0..plots.len()).map(|plot| (hash(seed, Draw::Tune, &[plot as u64]), plot)).collect();
    chosen.retain(|&(number, _)| number <= limit);
    chosen.sort_unstable();

    let members = members(job, lattice, samples, &plots, &chosen)?;
    let make = |i: usize| {
        let (number, plot) = chosen[i];
        let anew = |attempt| {
            resample(lattice, &plots.get(plot), samples, &members[i], Rng::at(number, Draw::Tune, &[attempt]))
        };
        (0..TRIES).map(anew).find(|change| change.helps(missing))
    };
    Ok(job.part(0.3, 1.0).map(chosen.len(), make)?.into_iter().flatten().collect())
}

/// The samples in each of the chosen plots, by their indices.
fn members(
    job: &Job,
    lattice: &Lattice,
    samples: &[[f32; 2]],
    plots: &Plots,
    chosen: &[(u64, usize)],
) -> Result<Vec<Vec<usize>>> {
    let mut place = vec![u32::MAX; plots.len()];
    chosen.iter().zip(0..).for_each(|(&(_, plot), i)| place[plot] = i);
    let chunks = chunks_of(samples.len(), SAMPLES_PER_TASK);
    let found = job.part(0.0, 0.3).flat_map(chunks.len(), |chunk| {
        let place = |index: usize| (place[plots.holding(lattice.point(samples[index]))], index);
        chunks.range(chunk).map(place).filter(|&(place, _)| place != u32::MAX).collect()
    })?;
    let mut members = vec![Vec::new(); chosen.len()];
    found.into_iter().for_each(|(place, index)| members[place as usize].push(index));
    Ok(members)
}

/// Removes the samples from the hole of a plot, which has the given members, and fills it.
fn resample(lattice: &Lattice, plot: &Plot, samples: &[[f32; 2]], members: &[usize], mut rng: Rng) -> Change {
    let &Lattice { radius, separation, .. } = lattice;
    let mut change = Change { removed: Vec::new(), added: Vec::new() };
    let hole = plot.hole();
    if hole.is_empty() {
        return change;
    }
    // A torus of its own for the plot, with a margin after it so that nothing conflicts across the seam.
    let length = plot.axes.map(|axis| if axis.is_circle { axis.length } else { axis.length + separation.reach + 1 });
    let mut grid = CellGrid::torus(&length.map(|length| CellAxis::new(length, radius)), separation);
    for &index in members {
        let point = plot.inward(lattice.point(samples[index]));
        if hole.contains(point) {
            change.removed.push(index);
        } else {
            grid.insert(grid.cell(point), point);
        }
    }
    let within = Rect { min: [0; 2], max: plot.axes.map(|axis| axis.length) };
    let open = hole.grown(separation.reach).intersection(&within);
    let cells = grid.cells_of(&open);
    let all = (cells.min[1]..cells.max[1]).flat_map(|y| (cells.min[0]..cells.max[0]).map(move |x| [x, y]));
    let empty: Vec<_> = all.filter(|&cell| grid.sample(cell).is_none()).collect();
    let mut quadtree = Quadtree::new(&grid, open, empty);
    quadtree.fill(&mut grid, &mut rng, |_, point| change.added.push(plot.outward(point)));
    #[cfg(test)]
    grid.sanity_check();
    change
}

// # Elimination
//
// Elimination of samples, where no maximal set with the wanted number is found.

/// Drops the samples with the nearest neighbours, one after the other, until `count` remain. For a handful of samples:
/// O(n²) for each.
pub fn thin(domain: &Domain, mut samples: Vec<[f32; 2]>, count: usize) -> Vec<[f32; 2]> {
    let distance = |a: [f32; 2], b: [f32; 2]| {
        let [dx, dy] = domain.offset(a.map(f64::from), b.map(f64::from));
        hypot(dx, dy)
    };
    while samples.len() > count {
        let others = |i: usize| (0..samples.len()).filter(move |&j| j != i);
        let nearest = |i: usize| others(i).map(|j| distance(samples[i], samples[j])).fold(f64::INFINITY, f64::min);
        let crowded = (0..samples.len()).min_by(|&a, &b| nearest(a).total_cmp(&nearest(b))).unwrap_or(0);
        samples.remove(crowded);
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A single attempt at few samples often fails. The set then returned keeps the radius, but has a gap where a
    /// sample was.
    #[test]
    fn a_set_that_could_not_be_tuned_is_thinned_and_called_not_maximal() {
        let context = Context::new(1).unwrap();
        let domain = Domain::unit(Boundary::Periodic);
        let mut thinned = 0;
        for (count, seed) in (2..12).flat_map(|count| (0..30).map(move |seed| (count, seed))) {
            let options = CountOptions::new(count).domain(domain).seed(seed);
            let search = Search::new(&domain, options.leaf_size, count);
            let (points, report) = context.run(None, |job| attempt(job, &options, search, 1)).unwrap();
            let samples = points.positions;
            assert_eq!(samples.len() as u64, count);
            let smallest = crate::analysis::spacing::smallest_distance_2d(&context, &domain, &samples, None).unwrap();
            let farthest = crate::analysis::coverage::covering_radius_2d(&context, &domain, &samples, None).unwrap();
            assert!(smallest >= report.radius);
            assert_eq!(report.is_maximal, farthest < report.radius * (1.0 + 1e-6), "{farthest} {report:?}");
            thinned += u32::from(!report.is_maximal);
        }
        assert!(thinned > 0);
    }

    #[test]
    fn errors_name_the_count() {
        let context = Context::new(1).unwrap();
        let refuse = |count, max: [f64; 2], leaf_size| {
            let domain = Domain { min: [1.0; 2], max, boundary: Boundary::Bounded };
            sample_count(&context, &CountOptions::new(count).domain(domain).leaf_size(leaf_size), None).unwrap_err()
        };
        let invalid =
            |error: &Error, name| matches!(error, Error::InvalidArgument { argument, .. } if *argument == name);
        assert!(invalid(&refuse(0, [2.0; 2], 20.0), "count"));
        assert!(invalid(&refuse(10, [2.0; 2], 5.0), "leaf_size"));
        assert!(invalid(&refuse(10, [0.0; 2], 20.0), "domain_max"));
        let coarse = refuse(10_000, [1.0008; 2], 20.0);
        assert!(invalid(&coarse, "count") && coarse.to_string().contains("10000 asks for a radius"), "{coarse}");
        for count in [5_000_000_000, u64::MAX] {
            let large = refuse(count, [2.0; 2], 20.0);
            assert!(matches!(large, Error::TooLarge { argument: "count", .. }), "{large}");
        }
    }

    #[test]
    fn the_first_radius_is_that_of_the_expected_number() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for extent in [[1.0, 1.0], [30.0, 1.0], [1e38, 2e38], [3e-30, 1e-30], [1e-3, 5.0]] {
                let domain = Domain { min: [0.0; 2], max: extent, boundary };
                for count in [3, 10, 1000, 1_000_000_000] {
                    let radius = Search::new(&domain, 20.0, count).radius();
                    let found = expected(&domain, 20.0, radius);
                    assert!((found / count as f64 - 1.0).abs() < 1e-9, "{found} of {count} in {extent:?}");
                }
                let one = Search::new(&domain, 20.0, 1).radius();
                assert!(one > 0.0 && one <= extent[0].hypot(extent[1]));
            }
        }
    }

    /// Sets whose counts do not follow the expected law.
    #[test]
    fn corrections_end_near_the_count() {
        let laws: [fn(f64) -> f64; 3] = [|r| 0.7 / (r * r), |r| 3.0 / r, |r| 0.6 / (r * r) + 5.0 / r];
        for law in laws {
            let mut search = Search::new(&Domain::unit(Boundary::Periodic), 20.0, 100_000);
            let near = (0..8).any(|_| {
                let made = law(search.radius()) as u64;
                search.correct(made);
                search.is_near(made)
            });
            assert!(near);
        }
    }

    fn lattices() -> Vec<Lattice> {
        let extents = [[1.0, 1.0], [0.3, 12.0], [0.05, 40.0], [0.59, 0.61], [0.6, 0.02]];
        let lattice = |(boundary, extent): (Boundary, [f64; 2])| {
            let domain = Domain { min: [16.0, -3.0], max: [16.0 + extent[0], extent[1] - 3.0], boundary };
            Lattice::new(&domain, 0.1).unwrap()
        };
        let boundaries = [Boundary::Periodic, Boundary::Bounded];
        boundaries.into_iter().flat_map(|boundary| extents.map(|extent| (boundary, extent))).map(lattice).collect()
    }

    #[test]
    fn every_lattice_point_lies_in_one_plot_and_comes_back() {
        for lattice in lattices() {
            for round in 0..20 {
                let plots = Plots::new(&lattice, Rng::at(0, Draw::Probe, &[round]));
                let inside = |plot: &Plot| Rect { min: [0; 2], max: plot.axes.map(|axis| axis.length) };
                let area = |rect: Rect| i64::from(rect.length(0)) * i64::from(rect.length(1));
                let areas: i64 = (0..plots.len()).map(|plot| area(inside(&plots.get(plot)))).sum();
                assert_eq!(areas, area(lattice.rect()));
                let mut rng = Rng::at(1, Draw::Probe, &[round]);
                for _ in 0..200 {
                    let point = lattice.size.map(|size| rng.below(size as u64) as i32);
                    let plot = plots.get(plots.holding(point));
                    assert!(inside(&plot).contains(plot.inward(point)));
                    assert_eq!(plot.outward(plot.inward(point)), point);
                }
                for plot in (0..plots.len()).filter(|&plot| !inside(&plots.get(plot)).is_empty()) {
                    let [first, last] = [[0; 2], plots.get(plot).axes.map(|axis| axis.length - 1)];
                    let held = [first, last].map(|corner| plots.holding(plots.get(plot).outward(corner)));
                    assert_eq!(held, [plot; 2]);
                }
            }
        }
    }

    /// From the definition: every point of the domain within two reaches of the hole lies in the plot. On a circle that
    /// is not cut the plot is everything.
    #[test]
    fn holes_are_two_reaches_away_from_other_plots() {
        for lattice in lattices() {
            for round in 0..20 {
                let plots = Plots::new(&lattice, Rng::at(0, Draw::Probe, &[round]));
                for plot in (0..plots.len()).map(|plot| plots.get(plot)).filter(|plot| !plot.hole().is_empty()) {
                    for (span, size) in std::iter::zip(plot.axes, lattice.size) {
                        let decides =
                            [span.hole[0] - 2 * lattice.separation.reach, span.hole[1] + 2 * lattice.separation.reach];
                        let begins = decides[0] >= 0 || lattice.boundary == Boundary::Bounded && span.start == 0;
                        let ends = decides[1] <= span.length
                            || lattice.boundary == Boundary::Bounded && span.start + span.length == size;
                        let is_all = span.is_circle && span.length == size && span.hole == [0, size];
                        assert!(is_all || begins && ends, "{span:?} of {size}");
                    }
                }
            }
        }
    }

    /// Every point must be in a hole in some round; points that never are could not be changed.
    #[test]
    fn every_place_is_in_some_hole() {
        for lattice in lattices() {
            let mut rng = Rng::at(2, Draw::Probe, &[]);
            for _ in 0..50 {
                let point = lattice.size.map(|size| rng.below(size as u64) as i32);
                let in_a_hole = (0..200).any(|round| {
                    let plots = Plots::new(&lattice, Rng::at(3, Draw::Probe, &[round]));
                    let plot = plots.get(plots.holding(point));
                    plot.hole().contains(plot.inward(point))
                });
                assert!(in_a_hole, "{point:?} of {:?}, {:?}", lattice.size, lattice.boundary);
            }
        }
    }

    #[test]
    fn the_most_crowded_samples_go_also_across_the_seam() {
        let samples = vec![[0.02, 0.5], [0.3, 0.5], [0.55, 0.5], [0.99, 0.5]];
        let rest = |boundary, count| thin(&Domain::unit(boundary), samples.clone(), count);
        assert_eq!(rest(Boundary::Bounded, 4), samples);
        assert_eq!(rest(Boundary::Bounded, 3), [samples[0], samples[2], samples[3]]);
        assert_eq!(rest(Boundary::Periodic, 3), [samples[1], samples[2], samples[3]]);
        assert_eq!(rest(Boundary::Periodic, 2).len(), 2);
    }
}
