//! Differential domain analysis: the distribution p(d) of the differences of all pairs of samples (Wei and Wang 2011,
//! "Differential domain analysis for non-uniform sampling"; thesis §3.4.1).
//!
//! p(d) is the density of other samples at an offset d from a sample, over the mean density: 1 for a Poisson process. The
//! power spectrum is its Fourier transform, P(f) = 1 + ∫ (p(d) - 1) exp(-2πi f·d) dd. Unlike the spectrum, differences
//! can be taken where there is no plane.
//!
//! *On a surface* the offset of a pair is projected onto the tangent plane of its first sample and scaled to keep its
//! length, which is straight through space, as the radius of [`psp`](crate::psp) is. (On a sphere the area within a
//! straight distance s is π s², as in the plane.) Angles are counted from a direction given for the whole surface,
//! projected likewise.
//!
//! *Normalisation.* The pairs on a surface are divided by the pairs of the samples with random points of the surface
//! (Davis and Peebles 1983, "A survey of galaxy redshifts"): boundaries, curvature and other sheets near by
//! cancel. In the plane the expectation is known; in a bounded domain a pair counts by one over the share of the domain that stays in it when
//! it is moved by their difference (Ohser and Stoyan 1981, "On the second-order analysis of stationary point processes").
//!
//! Lengths are in units of 1 / sqrt(density), the mean spacing, as the frequencies of the periodogram are in units of
//! sqrt(density): sets of different size can be compared. Departs from Wei and Wang, who give each pair a unit of its own
//! from a density that varies: here it is the mean of the whole set.

mod pairs;
mod radial;

use std::f64::consts::SQRT_2;

use glam::{DVec2, DVec3};

use crate::analysis::probes::AreaSampler;
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress, chunks};
use crate::math::square;
use crate::mesh::{Mesh, exact};
use crate::points::{Boundary, Domain};

use pairs::PairGrid;

pub use radial::Shell;

/// The length up to which pairs are counted, in mean spacings.
pub const REACH: f64 = 8.0;
/// The width of a shell of the radial mean, in mean spacings.
pub const SHELL_WIDTH: f64 = 1.0 / 64.0;
/// The grid of p(d) has so many cells per side ...
pub const GRID_SIZE: usize = 128;
/// ... and reaches so far from 0 along both axes, in mean spacings.
pub const GRID_REACH: f64 = 4.0;

/// Random points of the surface for each sample.
const PROBES: usize = 2;

/// The differences of a set of samples, or of several.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    found: Counts,
    /// What a Poisson process would give.
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
/// [`Error::InvalidArgument`] for a domain that is none, for points outside it and for fewer than two (`xy`), and for a
/// domain that is not at least twice the [`REACH`] wide and high (`domain`); [`Error::Cancelled`].
pub fn plane_differences(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Differences> {
    domain.check_set(points)?;
    check_count("xy", points.len())?;
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
/// The random points of the normalisation, two for each sample, are keyed by `seed`. Takes O(samples) for samples that are
/// spread about evenly, for about 600 pairs each.
///
/// # Errors
/// [`Error::InvalidArgument`] for positions that are not finite or fewer than two (`positions`), for another number of
/// normals or such that are not finite (`normals`), for a `direction` that is zero or not finite, and for a `mesh` whose
/// mask leaves no area; [`Error::Cancelled`].
pub fn surface_differences(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    direction: [f64; 3],
    seed: u64,
    progress: Option<&Progress>,
) -> Result<Differences> {
    crate::analysis::check_positions(positions)?;
    check_count("positions", positions.len())?;
    if normals.len() != positions.len() {
        let reason = format!("there are {}, and {} positions", normals.len(), positions.len());
        return Err(Error::invalid("normals", reason));
    }
    if let Some(i) = normals.iter().position(|normal| !normal.iter().all(|x| x.is_finite())) {
        return Err(Error::invalid("normals", format!("[{i}] is {:?}, not finite", normals[i])));
    }
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

/// Counts pairs of `firsts` and `others`. Where they are the `same`, the others begin with the firsts, and no point is a
/// pair with itself.
fn count(
    job: &Job,
    firsts: &[DVec3],
    locals: &[LocalFrame],
    others: &[DVec3],
    same: bool,
    weight: impl Fn(DVec3) -> f64 + Sync,
) -> Result<Counts> {
    let side = pairs::side([firsts, others], REACH);
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

/// The points within the reach of a place. All are written down, and the next takes the place of one that is no hit: no
/// processor could guess which it will be.
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

    /// What `count` points without any structure give.
    fn of_poisson_process(count: usize) -> Self {
        let cell = square(2.0 * GRID_REACH / GRID_SIZE as f64);
        let mut counts = Self::none();
        counts.grid.fill(cell);
        counts.shells = (0..counts.shells.len()).map(radial::shell_area).collect();
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
    /// p(d) on a grid of [`GRID_SIZE`] cells per side around the difference 0, row by row, the lowest first; 0 where not
    /// even a Poisson process would have a pair.
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
