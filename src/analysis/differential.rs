//! Differential domain analysis: the distribution p(d) of the differences of all pairs of samples (Wei and Wang 2011,
//! "Differential domain analysis for non-uniform sampling"; thesis §3.4.1).
//!
//! p(d) is the density of other samples at an offset d from a sample, over the mean density: 1 for a Poisson process.
//! The power spectrum is its Fourier transform, P(f) = 1 + ∫ (p(d) - 1) exp(-2πi f·d) dd. Unlike the spectrum,
//! differences can be taken where there is no plane.
//!
//! *On a surface* the offset of a pair is projected onto the tangent plane of its first sample and scaled to keep its
//! length, which is straight through space, as the radius of [`psp`](crate::psp) is. (On a sphere the area within a
//! straight distance s is π s², as in the plane.) Angles are counted from a direction given for the whole surface,
//! projected likewise.
//!
//! *Normalisation.* The pairs on a surface are divided by the pairs of the samples with random points of the surface
//! (Davis and Peebles 1983, "A survey of galaxy redshifts"): boundaries, curvature and other sheets near by cancel. In
//! the plane the expectation is known; in a bounded domain a pair counts by one over the share of the domain that stays
//! in it when it is moved by their difference (Ohser and Stoyan 1981, "On the second-order analysis of stationary point
//! processes").
//!
//! Lengths are in units of 1 / sqrt(density), the mean spacing, as the frequencies of the periodogram are in units of
//! sqrt(density): sets of different size can be compared. Departs from Wei and Wang, who give each pair a unit of its
//! own from a density that varies: here it is the mean of the whole set.

use std::f64::consts::{PI, SQRT_2};
use std::ops::Range;

use glam::{DVec2, DVec3};

use crate::analysis::AreaSampler;
use crate::check;
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress, chunks, chunks_of};
use crate::math::{hypot, j0, square};
use crate::mesh::{Mesh, exact};
use crate::points::{Boundary, Domain};

/// The length up to which pairs are counted, in mean spacings.
pub const REACH: f64 = 8.0;
/// The width of a shell of the radial mean, in mean spacings.
pub const SHELL_WIDTH: f64 = 1.0 / 64.0;
/// The number of cells per side of the grid of p(d).
pub const GRID_SIZE: usize = 128;
/// The distance to which the grid of p(d) extends from 0 along both axes, in mean spacings.
pub const GRID_REACH: f64 = 4.0;

/// Random points of the surface for each sample.
const PROBES: usize = 2;

/// The differences of a set of samples, or of several.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    found: Counts,
    /// The counts of a Poisson process.
    expected: Counts,
}

/// Pairs by their offset.
#[derive(Clone, Debug, PartialEq)]
struct Counts {
    grid: Vec<f64>,
    shells: Vec<f64>,
}

/// A sample and the directions in which its offsets are seen.
struct LocalFrame {
    x: DVec3,
    y: DVec3,
}

/// The differences of points in the plane, x and y as they are.
///
/// Takes O(points), about 200 pairs each.
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid domain, for points outside it and for fewer than two (`positions`), and for a
/// domain that is not at least twice the [`REACH`] wide and high (`domain`); [`Error::Cancelled`].
pub fn plane_differences(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Differences> {
    domain.check_set(points)?;
    check_count("positions", points.len())?;
    let unit = (domain.area() / points.len() as f64).sqrt();
    let extent = DVec2::from(domain.extent()) / unit;
    if extent.min_element() < 2.0 * REACH {
        let reason = format!("is {extent} mean spacings of {} points large, not {}", points.len(), 2.0 * REACH);
        return Err(Error::invalid("domain", reason));
    }
    let places: Vec<_> = points.iter().map(|point| in_plane(domain, point) / unit).collect();
    let images = match domain.boundary {
        Boundary::Bounded => Vec::new(),
        Boundary::Periodic => images(&places, extent),
    };
    let weight = |offset: DVec3| match domain.boundary {
        Boundary::Periodic => 1.0,
        Boundary::Bounded => (1.0 - offset.truncate().abs() / extent).element_product().recip(),
    };
    let locals: Vec<_> = points.iter().map(|_| LocalFrame { x: DVec3::X, y: DVec3::Y }).collect();
    let others = [&places[..], &images].concat();
    let found = context.run(progress, |job| count(job, &places, &locals, &others, true, weight))?;
    Ok(Differences { found, expected: Counts::of_poisson_process(points.len()) })
}

/// The differences of samples on a mesh, `normals` being those of their triangles; x points along `direction`.
///
/// The random points of the normalisation, two for each sample, are keyed by `seed`. Takes O(samples) for samples that
/// are spread about evenly, for about 600 pairs each.
///
/// # Errors
/// [`Error::InvalidArgument`] for positions that are not finite or fewer than two (`positions`), for another number of
/// normals or normals that are not finite (`normals`), for a `direction` that is zero or not finite, and for a `mesh`
/// whose mask leaves no area; [`Error::Cancelled`].
pub fn surface_differences(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    direction: [f64; 3],
    seed: u64,
    progress: Option<&Progress>,
) -> Result<Differences> {
    check::finite("positions", "position", positions)?;
    check_count("positions", positions.len())?;
    if normals.len() != positions.len() {
        let reason = format!("there are {}, and {} positions", normals.len(), positions.len());
        return Err(Error::invalid("normals", reason));
    }
    check::finite("normals", "normal", normals)?;
    let Some(direction) = DVec3::from(direction).try_normalize() else {
        return Err(Error::invalid("direction", format!("{direction:?} is none")));
    };
    if mesh.area() == 0.0 {
        return Err(Error::invalid("mesh", "its mask leaves no area"));
    }
    let unit = (mesh.area() / positions.len() as f64).sqrt();
    let places: Vec<_> = positions.iter().map(|&position| exact(position) / unit).collect();
    let locals: Vec<_> = normals.iter().map(|&normal| LocalFrame::on_surface(exact(normal), direction)).collect();
    let surface = AreaSampler::new(mesh);
    let probes = chunks(PROBES * positions.len());
    let probe = |number: usize| exact(surface.probe(seed, number as u64)) / unit;
    context.run(progress, |job| {
        let probes = job.part(0.0, 0.05).concat(probes.len(), |chunk| probes.range(chunk).map(probe).collect())?;
        let found = count(&job.part(0.05, 0.35), &places, &locals, &places, true, |_| 1.0)?;
        let mut expected = count(&job.part(0.35, 1.0), &places, &locals, &probes, false, |_| 1.0)?;
        expected.scale((positions.len() - 1) as f64 / probes.len() as f64);
        Ok(Differences { found, expected })
    })
}

fn check_count(argument: &'static str, count: usize) -> Result<()> {
    match count {
        2.. => Ok(()),
        _ => Err(Error::invalid(argument, format!("{count} have no differences"))),
    }
}

fn in_plane(domain: &Domain, point: &[f32; 2]) -> DVec3 {
    DVec2::from([0, 1].map(|axis| f64::from(point[axis]) - domain.min[axis])).extend(0.0)
}

/// The points of the neighbouring periods that are within the reach of the domain.
fn images(places: &[DVec3], extent: DVec2) -> Vec<DVec3> {
    let periods = (-1..=1).flat_map(|row| (-1..=1).map(move |column| DVec2::new(f64::from(column), f64::from(row))));
    let moved = periods
        .filter(|&period| period != DVec2::ZERO)
        .flat_map(|period| places.iter().map(move |&place| place + (period * extent).extend(0.0)));
    moved.filter(|place| (place.truncate() - 0.5 * extent).abs().cmple(0.5 * extent + REACH).all()).collect()
}

/// Counts pairs of `firsts` and `others`. If they are the `same`, the others begin with the firsts, and no point is a
/// pair with itself.
fn count(
    job: &Job,
    firsts: &[DVec3],
    locals: &[LocalFrame],
    others: &[DVec3],
    same: bool,
    weight: impl Fn(DVec3) -> f64 + Sync,
) -> Result<Counts> {
    let side = side([firsts, others], REACH);
    let firsts = PairGrid::new(firsts, side);
    job.report(0.02)?;
    let others = PairGrid::new(others, side);
    let tasks = firsts.tasks(&job.part(0.04, 0.1), &others, REACH)?;
    let count = |task: usize| {
        let mut counts = Counts::none();
        let (mut near, mut hits) = (Vec::new(), Vec::new());
        for run in &tasks[task] {
            let firsts = firsts.points(run.clone());
            near.clear();
            others.near(firsts, REACH).iter().for_each(|points| near.extend_from_slice(points));
            for &(first, from) in firsts {
                let local = &locals[first as usize];
                for hit in encounters_among(&near, from, &mut hits).iter().filter(|hit| !(same && hit.other == first)) {
                    counts.add(hit.offset, hit.squared.sqrt(), local, weight(hit.offset));
                }
            }
        }
        counts
    };
    let mut sum = Counts::none();
    job.part(0.1, 1.0).stream(tasks.len(), count, |counts| {
        sum.add_all(&counts);
        Ok(())
    })?;
    Ok(sum)
}

/// A point within the reach of another one.
#[derive(Clone, Copy, Default)]
struct Encounter {
    other: u32,
    offset: DVec3,
    squared: f64,
}

/// The points within the reach of a place. Every point is written, and the next one overwrites a point that is not a
/// hit: a branch on this would be unpredictable.
fn encounters_among<'a>(near: &[(u32, DVec3)], from: DVec3, hits: &'a mut Vec<Encounter>) -> &'a [Encounter] {
    hits.resize(hits.len().max(near.len()), Encounter::default());
    let mut count = 0;
    for &(other, to) in near {
        let offset = to - from;
        let squared = offset.length_squared();
        hits[count] = Encounter { other, offset, squared };
        count += usize::from(squared < REACH * REACH);
    }
    &hits[..count]
}

impl LocalFrame {
    fn on_surface(normal: DVec3, direction: DVec3) -> Self {
        let normal = normal.try_normalize().unwrap_or(DVec3::Z);
        let along = direction.reject_from_normalized(normal).try_normalize();
        let x = along.unwrap_or_else(|| normal.any_orthonormal_vector());
        Self { x, y: normal.cross(x) }
    }

    /// The offset in the tangent plane, with its length kept.
    fn see(&self, offset: DVec3, length: f64) -> DVec2 {
        let flat = DVec2::new(offset.dot(self.x), offset.dot(self.y));
        let stretch = length / flat.length();
        if stretch.is_finite() { flat * stretch } else { DVec2::new(length, 0.0) }
    }
}

impl Counts {
    fn none() -> Self {
        Self { grid: vec![0.0; GRID_SIZE * GRID_SIZE], shells: vec![0.0; (REACH / SHELL_WIDTH) as usize] }
    }

    /// The counts that `count` points without any structure give.
    fn of_poisson_process(count: usize) -> Self {
        let cell = square(2.0 * GRID_REACH / GRID_SIZE as f64);
        let mut counts = Self::none();
        counts.grid.fill(cell);
        counts.shells = (0..counts.shells.len()).map(shell_area).collect();
        counts.scale(count as f64 * (count - 1) as f64 / count as f64);
        counts
    }

    fn add(&mut self, offset: DVec3, length: f64, local: &LocalFrame, weight: f64) {
        let last = self.shells.len() - 1;
        self.shells[((length / SHELL_WIDTH) as usize).min(last)] += weight;
        if length < GRID_REACH * SQRT_2 {
            let cell = (local.see(offset, length) + GRID_REACH) * (GRID_SIZE as f64 / (2.0 * GRID_REACH));
            if cell.min_element() >= 0.0 && cell.max_element() < GRID_SIZE as f64 {
                self.grid[cell.y as usize * GRID_SIZE + cell.x as usize] += weight;
            }
        }
    }

    fn scale(&mut self, factor: f64) {
        self.grid.iter_mut().chain(&mut self.shells).for_each(|count| *count *= factor);
    }

    fn add_all(&mut self, other: &Self) {
        self.grid.iter_mut().zip(&other.grid).for_each(|(sum, count)| *sum += count);
        self.shells.iter_mut().zip(&other.shells).for_each(|(sum, count)| *sum += count);
    }
}

impl Differences {
    /// p(d) on a grid of [`GRID_SIZE`] cells per side around the difference 0, row by row, the lowest first; 0 where
    /// not even a Poisson process would have a pair.
    pub fn density(&self) -> Vec<f64> {
        let cells = self.found.grid.iter().zip(&self.expected.grid);
        cells.map(|(&found, &expected)| ratio(found, expected)).collect()
    }

    /// The differences of sets of one kind, taken together; noise fades with the square root of their number.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no set.
    pub fn together(of: &[Self]) -> Result<Self> {
        if of.is_empty() {
            return Err(Error::invalid("differences", "there are none"));
        }
        let sum = |counts: fn(&Self) -> &Counts| {
            let mut sum = Counts::none();
            of.iter().for_each(|one| sum.add_all(counts(one)));
            sum
        };
        Ok(Self { found: sum(|one| &one.found), expected: sum(|one| &one.expected) })
    }
}

fn ratio(found: f64, expected: f64) -> f64 {
    if expected > 0.0 { found / expected } else { 0.0 }
}

/// The differences of about one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    /// The middle of its lengths, in mean spacings.
    pub distance: f64,
    /// The mean of p(d): the radial distribution function; 1 for a Poisson process.
    pub density: f64,
    /// The number of pairs in it that a Poisson process would have; its density has a standard error of about one over
    /// the square root.
    pub expected: f64,
}

/// The area between the circles that bound a shell.
pub(super) fn shell_area(shell: usize) -> f64 {
    PI * SHELL_WIDTH * SHELL_WIDTH * (2 * shell + 1) as f64
}

impl Differences {
    /// The radial mean of p(d), in shells of [`SHELL_WIDTH`] out to the [`REACH`].
    pub fn radial(&self) -> Vec<Shell> {
        let counts = self.found.shells.iter().zip(&self.expected.shells);
        let shell = |(i, (&found, &expected)): (usize, (&f64, &f64))| Shell {
            distance: (i as f64 + 0.5) * SHELL_WIDTH,
            density: ratio(found, expected),
            expected,
        };
        counts.enumerate().map(shell).collect()
    }

    /// The radial mean of the power at frequencies in units of sqrt(density), 1 for a Poisson process: the Hankel
    /// transform of p(d) - 1, of which lengths near the [`REACH`] count less and less. That makes it the spectrum seen
    /// through a blur of 1 / [`REACH`].
    ///
    /// Takes O(1) for each frequency.
    pub fn power(&self, frequencies: &[f64]) -> Vec<f64> {
        let shells = self.radial();
        let excess = |(i, shell): (usize, &Shell)| {
            let fade = square(1.0 - square(shell.distance / REACH));
            // Nothing is known where not even a Poisson process has a pair.
            let excess = if shell.expected > 0.0 { shell.density - 1.0 } else { 0.0 };
            [shell.distance, shell_area(i) * fade * excess]
        };
        let terms: Vec<_> = shells.iter().enumerate().map(excess).collect();
        let power = |&frequency: &f64| {
            let wave = |&[distance, excess]: &[f64; 2]| excess * j0(2.0 * PI * frequency * distance);
            1.0 + terms.iter().map(wave).sum::<f64>()
        };
        frequencies.iter().map(power).collect()
    }

    /// The anisotropy of p(d) over the lengths in `range` (mean spacings, within [`GRID_REACH`]): twice the mean of cos
    /// 2φ, weighted by p, φ being the angle from x. 0 for a set that is the same in all directions, positive where
    /// pairs of these lengths lie along x rather than across, 1 for p proportional to 1 + cos 2φ. 0 without pairs.
    pub fn elongation(&self, range: Range<f64>) -> f64 {
        let place = |i: usize| (i as f64 + 0.5) * (2.0 * GRID_REACH / GRID_SIZE as f64) - GRID_REACH;
        let (mut all, mut along) = (0.0, 0.0);
        for (i, density) in self.density().into_iter().enumerate() {
            let (x, y) = (place(i % GRID_SIZE), place(i / GRID_SIZE));
            if range.contains(&hypot(x, y)) {
                all += density;
                along += density * (x * x - y * y) / (x * x + y * y);
            }
        }
        2.0 * ratio(along, all)
    }
}

/// The least side of the cells, as a share of the box of all points, so that their numbers stay small.
const NARROWEST: f64 = 1.0 / (1 << 20) as f64;
/// The bits of a cell's number along an axis.
const BITS: u32 = 21;

/// The cells whose work is estimated by one task.
const ESTIMATED: usize = 1 << 10;
/// The approximate number of pairs that a task tests: it takes some hundredths of a second, however the points are
/// spread.
const TESTS: usize = 1 << 22;

/// The side of the cubes for sets of points among which pairs within a reach are looked for: it must be the same for
/// all of them, or a cube of one set would meet any number of another's. Smaller ones hold fewer points that are too
/// far away, and take longer to be found.
pub(super) fn side(sets: [&[DVec3]; 2], reach: f64) -> f64 {
    let all = || sets.into_iter().flatten().copied();
    let extent = all().reduce(DVec3::max).unwrap_or_default() - all().reduce(DVec3::min).unwrap_or_default();
    (0.5 * reach).max(NARROWEST * extent.max_element())
}

/// Points sorted into cubic cells.
pub(super) struct PairGrid {
    origin: DVec3,
    side: f64,
    /// The points with their numbers, those of a cell together.
    points: Vec<(u32, DVec3)>,
    /// The cells in order, and the range of the points of each.
    cells: Vec<(u64, Range<usize>)>,
}

/// Points that follow each other and are in one cell.
pub(super) type Run = Range<usize>;

impl PairGrid {
    pub fn new(points: &[DVec3], side: f64) -> Self {
        let origin = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let mut order: Vec<_> =
            points.iter().zip(0u32..).map(|(&point, i)| (number(place(point, origin, side)), i)).collect();
        order.sort_unstable();
        let mut cells: Vec<(u64, Run)> = Vec::new();
        for (i, &(cell, _)) in order.iter().enumerate() {
            match cells.last_mut() {
                Some((last, run)) if *last == cell => run.end = i + 1,
                _ => cells.push((cell, i..i + 1)),
            }
        }
        let points = order.into_iter().map(|(_, i)| (i, points[i as usize])).collect();
        Self { origin, side, points, cells }
    }

    /// Points, with their numbers.
    pub fn points(&self, run: Run) -> &[(u32, DVec3)] {
        &self.points[run]
    }

    /// The points, divided into runs, and these into tasks that test about as many pairs with `others` each.
    pub fn tasks(&self, job: &Job, others: &Self, reach: f64) -> Result<Vec<Vec<Run>>> {
        let chunks = chunks_of(self.cells.len(), ESTIMATED);
        let runs = job.flat_map(chunks.len(), |chunk| {
            let cells = self.cells[chunks.range(chunk)].iter().flat_map(|(_, run)| {
                let near = others.near(&self.points[run.clone()], reach);
                let near = near.iter().map(|points| points.len()).sum::<usize>().max(1);
                let size = (TESTS / near).max(1);
                run.clone().step_by(size).map(move |start| (start..(start + size).min(run.end), near))
            });
            cells.collect()
        })?;
        let (mut tasks, mut tests): (Vec<Vec<Run>>, usize) = (Vec::new(), TESTS);
        for (run, near) in runs {
            tests = tests.saturating_add(run.len().saturating_mul(near));
            match tasks.last_mut() {
                Some(task) if tests <= TESTS => task.push(run),
                _ => {
                    tests = run.len().saturating_mul(near);
                    tasks.push(vec![run]);
                }
            }
        }
        Ok(tasks)
    }

    /// All points within `reach` of some points, and others, by columns of cells.
    pub fn near(&self, around: &[(u32, DVec3)], reach: f64) -> Vec<&[(u32, DVec3)]> {
        let places = || around.iter().map(|&(_, point)| point);
        let Some((low, high)) = places().reduce(DVec3::min).zip(places().reduce(DVec3::max)) else { return Vec::new() };
        let [low, high] = [low - reach, high + reach].map(|corner| self.place(corner));
        let along = |axis: usize| low[axis].max(0)..=high[axis].min((1 << BITS) - 1);
        let (bottom, top) = (low[2].max(0), high[2].min((1 << BITS) - 1));
        let mut columns = Vec::new();
        for x in along(0) {
            columns.extend(along(1).map(|y| self.column([x, y, bottom], [x, y, top])));
        }
        columns
    }

    fn place(&self, point: DVec3) -> [i64; 3] {
        place(point, self.origin, self.side)
    }

    /// The points of cells that follow each other in order; none if the last comes before the first.
    fn column(&self, first: [i64; 3], last: [i64; 3]) -> &[(u32, DVec3)] {
        if last[2] < first[2] {
            return &[];
        }
        let [first, last] = [first, last].map(number);
        let start = self.cells.partition_point(|(cell, _)| *cell < first);
        let count = self.cells[start..].partition_point(|(cell, _)| *cell <= last);
        match &self.cells[start..start + count] {
            [] => &[],
            cells => &self.points[cells[0].1.start..cells[count - 1].1.end],
        }
    }
}

/// The cell of a point. Cells with points of the set are not negative.
fn place(point: DVec3, origin: DVec3, side: f64) -> [i64; 3] {
    ((point - origin) / side).floor().as_i64vec3().to_array()
}

/// The number of a cell: by x, by y where that is the same, and by z.
fn number([x, y, z]: [i64; 3]) -> u64 {
    ((x << (2 * BITS)) | (y << BITS) | z) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// Values of Abramowitz and Stegun 1964, table 9.1, and an asymptotic one.
    #[test]
    fn the_bessel_function_of_order_0_is_that_of_the_tables() {
        for (x, expected) in [
            (0.0, 1.0),
            (1.0, 0.765_197_686_557_966_6),
            (2.404_825_557_695_773, 0.0),
            (10.0, -0.245_935_764_451_348_35),
            (100.0, 0.019_985_850_304_223_12),
        ] {
            assert!((j0(x) - expected).abs() < 1e-12, "{x}: {}", j0(x));
        }
    }

    #[test]
    fn every_near_pair_is_found_once() {
        for (reach, stretch) in [(0.3, 1.0), (0.05, 1.0), (5.0, 1.0), (0.1, 1e9)] {
            let mut rng = Rng::at(1, Draw::Probe, &[]);
            // Three clusters, which can be far apart.
            let mut point = || DVec3::new(stretch * rng.below(3) as f64, rng.unit(), rng.unit() + 7.0);
            let (firsts, others): (Vec<_>, Vec<_>) = (0..300).map(|_| (point(), point())).unzip();
            let is_near = |a: DVec3, b: DVec3| a.distance(b) <= reach;
            let side = side([&firsts, &others], reach);
            let (from, to) = (PairGrid::new(&firsts, side), PairGrid::new(&others, side));
            let tasks = Context::new(2).unwrap().run(None, |job| from.tasks(job, &to, reach)).unwrap();
            let mut found = Vec::new();
            for run in tasks.concat() {
                let near = to.near(from.points(run.clone()), reach).concat();
                for &(i, a) in from.points(run) {
                    found.extend(near.iter().filter(|(_, b)| is_near(a, *b)).map(|&(j, _)| (i, j)));
                }
            }
            found.sort_unstable();
            let all = (0..300u32).flat_map(|i| (0..300u32).map(move |j| (i, j)));
            let expected: Vec<_> = all.filter(|&(i, j)| is_near(firsts[i as usize], others[j as usize])).collect();
            assert!(found == expected && !expected.is_empty(), "{reach}: {} of {}", found.len(), expected.len());
        }
        let none = PairGrid::new(&[], 1.0);
        assert!(Context::new(1).unwrap().run(None, |job| none.tasks(job, &none, 1.0)).unwrap().is_empty());
    }

    /// The work is shared even if all points are in one cell.
    #[test]
    fn tasks_test_about_as_many_pairs_however_points_are_spread() {
        let points = vec![DVec3::ONE; 10_000];
        let cells = PairGrid::new(&points, 1.0);
        let tasks = Context::new(1).unwrap().run(None, |job| cells.tasks(job, &cells, 1.0)).unwrap();
        assert_eq!(tasks.len(), points.len().div_ceil(TESTS / points.len()));
        assert!(tasks.concat().into_iter().flatten().eq(0..points.len()));
        assert!(tasks.concat().iter().all(|run| run.len() * points.len() <= TESTS));
    }

    /// Found by fuzzing: the few points of a cube were looked for in 10^12 cubes of the others.
    #[test]
    fn a_set_that_is_spread_wide_meets_few_cubes_of_one_that_is_not() {
        let (wide, narrow) = ([DVec3::ZERO, DVec3::new(1.0, 1e13, 0.0)], [DVec3::ZERO, DVec3::ONE]);
        let side = side([&wide, &narrow], 1.0);
        let (from, to) = (PairGrid::new(&wide, side), PairGrid::new(&narrow, side));
        assert_eq!(to.near(from.points(0..1), 1.0).concat().len(), 2);
    }
}
