//! Coverage: how far the domain or the surface is from the samples.

mod gaps;
mod surface;

use glam::DVec3;

use crate::analysis::AreaSampler;
use crate::check;
use crate::error::{Error, Result};
use crate::index::{Grid2, Grid3, PointTree};
use crate::job::{Context, Job, Progress, chunks, chunks_of};
use crate::math::{distance_squared, hypot};
use crate::mesh::Mesh;
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain};
use crate::psp::TOLERANCE;

pub use surface::{surface_coverage, surface_covering_radius};

/// The relative precision of a covering radius.
pub const PRECISION: f64 = 1e-9;

/// The cells of a task, each of which may become many.
const TASK: usize = 512;

/// The coverage of a domain or a surface by disks of a radius around the points of a set.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Coverage {
    /// The covering radius: the worst distance of a place from the samples.
    pub farthest: f64,
    /// The number of gaps: 0 for a set that is maximal up to the rounding that samplers are allowed
    /// ([`TOLERANCE`]).
    pub gaps: usize,
}

/// The coverage of the domain of a set in the plane by disks of `radius`. A *gap* is a connected part of the domain, or
/// of the torus, that is farther than `radius` from all points, by more than [`TOLERANCE`] float
/// spacings at the largest coordinate of the domain: the rounding of positions can leave less than that uncovered. The
/// whole domain is one for an empty set.
///
/// Gaps are counted by the Voronoi diagram, however small they are; those shallower than 1e-6 of the mean spacing may
/// be missed, unless they are all there is. Takes O(n log n).
///
/// # Errors
/// As [`covering_radius_2d`]; and [`Error::InvalidArgument`] for a radius that is not
/// positive and finite.
pub fn coverage_2d(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    radius: f64,
    progress: Option<&Progress>,
) -> Result<Coverage> {
    check::radius(radius)?;
    domain.check_set(points)?;
    context.run(progress, |job| {
        let farthest = covering_radius(&job.part(0.0, 0.5), domain, points)?;
        let reach = radius + TOLERANCE * float_spacing(domain.min.iter().chain(&domain.max));
        let gaps = match points {
            _ if farthest <= reach => 0,
            [] => 1,
            _ => gaps::count(&job.part(0.5, 1.0), domain, points, reach)?.max(1),
        };
        Ok(Coverage { farthest, gaps })
    })
}

/// The covering radius of a set in the plane: the distance from the samples of the point of the domain that is farthest
/// from all of them. A set is maximal for a radius if this is not above it. Infinite for an empty set.
///
/// Only the domain has to be covered; on a torus the samples across its boundary count. Found by branch and bound: the
/// sample nearest to a cell's centre bounds the distances of all of its points; cells that could hold more than the
/// largest distance so far are divided. The result is too small by at most the factor 1 + [`PRECISION`].
///
/// Takes O(n log n).
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid domain and for points outside it (`positions`);
/// [`Error::Cancelled`].
pub fn covering_radius_2d(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<f64> {
    domain.check_set(points)?;
    context.run(progress, |job| covering_radius(job, domain, points))
}

/// [`covering_radius_2d`] of a set that has been checked.
pub(super) fn covering_radius(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<f64> {
    if points.is_empty() {
        return Ok(f64::INFINITY);
    }
    let nearest = Nearest::new(&job.part(0.0, 0.2), domain, points)?;
    let cells = SearchCells::about(domain, points.len());
    let tasks = chunks_of(cells.len(), TASK);
    let distance = |cell: usize| {
        let [x, y] = nearest.offset(cells.get(cell).centre);
        hypot(x, y)
    };
    let largest = |distances: Vec<f64>| distances.into_iter().fold(0.0, f64::max);
    let known =
        job.part(0.2, 0.3).map(tasks.len(), |task| tasks.range(task).map(distance).fold(0.0, f64::max)).map(largest)?;
    let of_task = |task: usize| farthest(&nearest, tasks.range(task).map(|cell| cells.get(cell)).collect(), known);
    job.part(0.3, 1.0).map(tasks.len(), of_task).map(largest)
}

/// A rectangle of the domain.
#[derive(Clone, Copy)]
struct SearchCell {
    centre: [f64; 2],
    half: [f64; 2],
}

/// The domain divided into equal cells.
struct SearchCells {
    min: [f64; 2],
    half: [f64; 2],
    columns: usize,
    rows: usize,
}

impl SearchCells {
    /// At least `count` cells, about square where the domain is not too thin for it, and not many times more.
    fn about(domain: &Domain, count: usize) -> Self {
        let extent = domain.extent();
        let side = (domain.area() / count as f64).sqrt();
        let [columns, rows] = extent.map(|length| (length / side).ceil().min(count as f64).max(1.0));
        let half = [extent[0] / columns / 2.0, extent[1] / rows / 2.0];
        Self { min: domain.min, half, columns: columns as usize, rows: rows as usize }
    }

    fn len(&self) -> usize {
        self.columns * self.rows
    }

    fn get(&self, cell: usize) -> SearchCell {
        let place = [cell % self.columns, cell / self.columns];
        let centre = std::array::from_fn(|axis| self.min[axis] + (2 * place[axis] + 1) as f64 * self.half[axis]);
        SearchCell { centre, half: self.half }
    }
}

/// The largest distance of a place in the cells from the points, if it is above the one that is known.
fn farthest(nearest: &Nearest, mut cells: Vec<SearchCell>, known: f64) -> f64 {
    let mut farthest = known;
    while !cells.is_empty() {
        let offsets: Vec<[f64; 2]> = cells.iter().map(|cell| nearest.offset(cell.centre).map(f64::abs)).collect();
        farthest = offsets.iter().map(|&[x, y]| hypot(x, y)).fold(farthest, f64::max);
        let could_exceed = |cell: &SearchCell, offset: [f64; 2]| cell.bound(offset) > farthest * (1.0 + PRECISION);
        cells = std::iter::zip(&cells, offsets)
            .filter(|&(cell, offset)| could_exceed(cell, offset))
            .flat_map(|(cell, offset)| cell.parts(offset))
            .collect();
    }
    farthest
}

impl SearchCell {
    /// A bound for the distances of the cell's points, from the offset of the sample that is nearest to its centre:
    /// they are no farther from this sample than the corner on the other side.
    fn bound(&self, offset: [f64; 2]) -> f64 {
        hypot(offset[0] + self.half[0], offset[1] + self.half[1])
    }

    /// Halves or quarters: divided along each axis that has a large part in the bound. In a thin domain that is the
    /// long axis alone, so that there are not many more cells than are needed along the short one.
    fn parts(&self, offset: [f64; 2]) -> impl Iterator<Item = SearchCell> + use<> {
        let Self { centre, half } = *self;
        let excess: [f64; 2] = std::array::from_fn(|axis| half[axis] * (2.0 * offset[axis] + half[axis]));
        let larger = excess[0].max(excess[1]);
        let count = excess.map(|excess| if 4.0 * excess >= larger { 2 } else { 1 });
        // A cell that is as small as the float spacing at its place is not divided any further.
        let half: [f64; 2] = std::array::from_fn(|axis| {
            let part = half[axis] / f64::from(count[axis]);
            if centre[axis] + part == centre[axis] { 0.0 } else { part }
        });
        let along = move |axis: usize, part| centre[axis] + f64::from(2 * part + 1 - count[axis]) * half[axis];
        (0..count[1]).flat_map(move |row| {
            (0..count[0]).map(move |column| SearchCell { centre: [along(0, column), along(1, row)], half })
        })
    }
}

/// The share of random points of the surface that are farther than `radius` from every sample (Euclidean distance, in
/// `f64`): an estimate of the uncovered part of its area, with a standard error of at most 0.5 / sqrt(`probes`).
/// 0 where the mesh's mask leaves no area.
///
/// Probes are uniform by area and keyed by `seed` and their number. They miss small gaps: this estimates a share, while
/// [`surface_coverage`] proves that there is none.
///
/// # Errors
/// [`Error::InvalidArgument`] for a radius that is not positive and finite, for positions
/// that are not finite and for no `probes`; [`Error::Cancelled`].
pub fn surface_uncovered_fraction(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    radius: f64,
    probes: u64,
    seed: u64,
    progress: Option<&Progress>,
) -> Result<f64> {
    check::radius(radius)?;
    check::finite("positions", "position", positions)?;
    if probes == 0 {
        return Err(Error::invalid("probes", "0, which say nothing of the surface"));
    }
    if mesh.area() == 0.0 {
        return Ok(0.0);
    }
    let surface = AreaSampler::new(mesh);
    let chunks = chunks(probes as usize);
    let mut uncovered = 0;
    context.run(progress, |job| {
        let grid = Grid3::of(&job.part(0.0, 0.1), mesh.bounds().0.map(f64::from), radius, positions)?;
        let is_covered = |index: usize| {
            let probe = surface.probe(seed, index as u64);
            let mut near = grid.candidates(probe.map(f64::from), radius);
            near.any(|sample| distance_squared(positions[sample as usize], probe) <= radius * radius)
        };
        let count = |chunk: usize| chunks.range(chunk).filter(|&index| !is_covered(index)).count();
        // The counts of only a few chunks are held at a time, however many probes there are.
        job.part(0.1, 1.0).stream(chunks.len(), count, |found| {
            uncovered += found;
            Ok(())
        })
    })?;
    Ok(uncovered as f64 / probes as f64)
}

/// The grid is searched within this many mean spacings, slightly farther than the largest hole of most sets; then the
/// tree, whose answer takes longer, but hardly any longer where all points are far away.
const NEAR: f64 = 4.0;

/// Points in a grid, and in a tree for places that are far from all of them.
pub(super) struct Nearest {
    domain: Domain,
    spacing: f64,
    grid: Grid2,
    tree: PointTree,
}

impl Nearest {
    /// Takes O(n log n). There must be a point.
    pub fn new(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<Self> {
        let spacing = (domain.area() / points.len() as f64).sqrt();
        let grid = Grid2::new(*domain, points.iter().map(|point| point.map(f64::from)), spacing);
        let tree = PointTree::of(job, &points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())?;
        Ok(Self { domain: *domain, spacing, grid, tree })
    }

    /// The offset from a place of the domain to the nearest point.
    pub fn offset(&self, place: [f64; 2]) -> [f64; 2] {
        let mut reach = self.spacing;
        while reach <= NEAR * self.spacing {
            let (mut nearest, mut least) = (None, f64::INFINITY);
            self.grid.for_each_within(place, reach, |_, offset, squared| {
                if squared < least {
                    (nearest, least) = (Some(offset), squared);
                }
            });
            if let Some(offset) = nearest {
                return offset;
            }
            reach *= 2.0;
        }
        let turns: &[f64] = match self.domain.boundary {
            Boundary::Periodic => &[0.0, -1.0, 1.0],
            Boundary::Bounded => &[0.0],
        };
        let [width, height] = self.domain.extent();
        let images = turns.iter().flat_map(|x| turns.iter().map(move |y| [x * width, y * height]));
        let offsets = images.filter_map(|turn| {
            let image = DVec3::new(place[0] + turn[0], place[1] + turn[1], 0.0);
            Some(self.tree.nearest_point(image)? - image)
        });
        let nearest = offsets.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        nearest.expect("there is a point").truncate().to_array()
    }
}
