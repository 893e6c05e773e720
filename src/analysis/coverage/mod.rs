//! Coverage: how far the domain or the surface is from the samples.

mod gaps;
mod groups;
mod space;
mod surface;
mod vertices;

use glam::DVec3;

use crate::analysis::AreaSampler;
use crate::check;
use crate::error::{Error, Result};
use crate::index::{Grid3, PointTree, SortedGrid};
use crate::job::{Context, Job, Progress, chunks, chunks_of};
use crate::math::{distance_squared, hypot};
use crate::memory;
use crate::mesh::Mesh;
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain};
use crate::psp::TOLERANCE;

pub use space::{coverage_3d, covering_radius_3d};
pub use surface::{surface_coverage, surface_covering_radius};

/// The relative precision of a covering radius.
pub const PRECISION: f64 = 1e-9;

/// The cells of a task, each of which may become many.
const TASK: usize = 512;

/// The most bytes per point in the grid and the tree, in the plane and in space.
const BYTES_PER_POINT: [f64; 2] = [66.0, 75.0];

/// The most bytes of [`surface_uncovered_fraction`] per point and per triangle.
const BYTES_PER_POINT_OF_GRID: f64 = 24.0;
const BYTES_PER_TRIANGLE: f64 = 12.0;

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
/// [`Error::TooLarge`] for more points than memory holds;
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

/// [`covering_radius_2d`] or [`covering_radius_3d`] of a set that has been checked.
pub(super) fn covering_radius<const D: usize>(job: &Job, domain: &Domain<D>, points: &[[f32; D]]) -> Result<f64> {
    if points.is_empty() {
        return Ok(f64::INFINITY);
    }
    memory::require_points("positions", points.len(), BYTES_PER_POINT[D - 2])?;
    let nearest = Nearest::new(&job.part(0.0, 0.2), domain, points)?;
    let cells = SearchCells::about(domain, points.len());
    let tasks = chunks_of(cells.len(), TASK);
    let distance = |cell: usize| length(nearest.offset(cells.get(cell).centre));
    let largest = |distances: Vec<f64>| distances.into_iter().fold(0.0, f64::max);
    let known =
        job.part(0.2, 0.3).map(tasks.len(), |task| tasks.range(task).map(distance).fold(0.0, f64::max)).map(largest)?;
    let of_task = |task: usize| farthest(&nearest, tasks.range(task).map(|cell| cells.get(cell)).collect(), known);
    job.part(0.3, 1.0).map(tasks.len(), of_task).map(largest)
}

/// The length of a vector.
fn length<const D: usize>(vector: [f64; D]) -> f64 {
    vector.into_iter().reduce(hypot).unwrap_or(0.0)
}

/// A rectangle or cuboid of the domain.
#[derive(Clone, Copy)]
struct SearchCell<const D: usize> {
    centre: [f64; D],
    half: [f64; D],
}

/// The domain divided into equal cells.
struct SearchCells<const D: usize> {
    min: [f64; D],
    half: [f64; D],
    /// Cells per axis.
    cells: [usize; D],
}

impl<const D: usize> SearchCells<D> {
    /// About `count` cells, of equal sides where the domain is not too thin for it, and not many times more.
    fn about(domain: &Domain<D>, count: usize) -> Self {
        let side = domain.cell_side(count as f64);
        let cells = domain.extent().map(|length| (length / side).ceil().min(count as f64).max(1.0) as usize);
        let half = std::array::from_fn(|axis| domain.extent()[axis] / cells[axis] as f64 / 2.0);
        Self { min: domain.min, half, cells }
    }

    fn len(&self) -> usize {
        self.cells.iter().product()
    }

    fn get(&self, mut cell: usize) -> SearchCell<D> {
        let centre = std::array::from_fn(|axis| {
            let place = cell % self.cells[axis];
            cell /= self.cells[axis];
            self.min[axis] + (2 * place + 1) as f64 * self.half[axis]
        });
        SearchCell { centre, half: self.half }
    }
}

/// The largest distance of a place in the cells from the points, if it is above the one that is known.
fn farthest<const D: usize>(nearest: &Nearest<D>, mut cells: Vec<SearchCell<D>>, known: f64) -> f64 {
    let mut farthest = known;
    while !cells.is_empty() {
        let offsets: Vec<[f64; D]> = cells.iter().map(|cell| nearest.offset(cell.centre)).collect();
        farthest = offsets.iter().copied().map(length).fold(farthest, f64::max);
        let mut parts = Vec::new();
        for (cell, offset) in std::iter::zip(cells, offsets) {
            if cell.bound(offset) <= farthest * (1.0 + PRECISION) {
                continue;
            }
            match nearest.around(&cell, length(offset)) {
                Some(around) => farthest = vertices::farthest(in_space_of(&cell.half), &around, farthest),
                None => parts.extend(cell.parts(offset)),
            }
        }
        cells = parts;
    }
    farthest
}

impl<const D: usize> SearchCell<D> {
    /// A bound for the distances of the cell's points, from the offset of the sample that is nearest to its centre:
    /// they are no farther from this sample than the corner on the other side.
    fn bound(&self, offset: [f64; D]) -> f64 {
        let corner: [f64; D] = std::array::from_fn(|axis| offset[axis].abs() + self.half[axis]);
        length(corner)
    }

    /// Parts of a half of the sides: divided along each axis that has a large part in the bound. In a thin domain that is
    /// the long axis alone, so that there are not many more cells than are needed along the short one.
    fn parts(&self, offset: [f64; D]) -> impl Iterator<Item = Self> + use<D> {
        let Self { centre, half } = *self;
        let excess: [f64; D] = std::array::from_fn(|axis| half[axis] * (2.0 * offset[axis].abs() + half[axis]));
        let larger = excess.into_iter().fold(0.0, f64::max);
        let count = excess.map(|excess| if 4.0 * excess >= larger { 2 } else { 1 });
        // A cell that is as small as the float spacing at its place is not divided any further.
        let half: [f64; D] = std::array::from_fn(|axis| {
            let part = half[axis] / f64::from(count[axis]);
            if centre[axis] + part == centre[axis] { 0.0 } else { part }
        });
        let along = move |axis: usize, part| centre[axis] + f64::from(2 * part + 1 - count[axis]) * half[axis];
        (0..count.into_iter().product()).map(move |mut part: i32| {
            let centre = std::array::from_fn(|axis| {
                let place = part % count[axis];
                part /= count[axis];
                along(axis, place)
            });
            Self { centre, half }
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
/// that are not finite and for no `probes`;
/// [`Error::TooLarge`] for more points than memory holds;
/// [`Error::Cancelled`].
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
    let triangles = BYTES_PER_TRIANGLE * mesh.triangles().len() as f64;
    let points = BYTES_PER_POINT_OF_GRID * positions.len() as f64;
    memory::require(triangles + points, "positions", &format!("{} points", positions.len()))?;
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

/// A cell is not divided further if no place of it is farther from its centre than this share of the distance of the nearest
/// point, and so many points at most are nearest to some place of it.
const FINE: f64 = 0.25;
const FEW: usize = 32;

/// Points in a grid, and in a tree for places that are far from all of them.
pub(super) struct Nearest<const D: usize = 2> {
    domain: Domain<D>,
    spacing: f64,
    grid: SortedGrid<D>,
    tree: PointTree,
}

impl<const D: usize> Nearest<D> {
    /// Takes O(n log n). There must be a point.
    pub fn new(job: &Job, domain: &Domain<D>, points: &[[f32; D]]) -> Result<Self> {
        let spacing = domain.cell_side(points.len() as f64);
        let grid = SortedGrid::new(*domain, points.iter().map(|point| point.map(f64::from)), spacing);
        let tree = PointTree::of(job, &points.iter().map(in_space).collect::<Vec<_>>())?;
        Ok(Self { domain: *domain, spacing, grid, tree })
    }

    /// All points that are nearest to some place of a cell, as offsets from its centre, if it is a cell of space and so small
    /// that there are few. `distance` is that of the nearest point from its centre.
    fn around(&self, cell: &SearchCell<D>, distance: f64) -> Option<Vec<DVec3>> {
        let reach = length(cell.half);
        let within = distance + 2.0 * reach;
        // Around a small torus a point may be nearest by two of its images.
        let shortest = self.domain.extent().into_iter().fold(f64::INFINITY, f64::min);
        let is_seen = self.domain.boundary == Boundary::Bounded || 2.0 * (within + reach) < shortest;
        if D < 3 || reach > FINE * distance || !is_seen {
            return None;
        }
        let mut around = Vec::new();
        let margin = within * (1.0 + 1e-9);
        self.grid
            .for_each_within(cell.centre, margin, |_, offset, squared| around.push((squared, in_space_of(&offset))));
        if around.len() > FEW {
            return None;
        }
        around.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        Some(around.into_iter().map(|(_, offset)| offset).collect())
    }

    /// The offset from a place of the domain to the nearest point.
    pub fn offset(&self, place: [f64; D]) -> [f64; D] {
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
        let extent = self.domain.extent();
        let offsets = (0..turns.len().pow(D as u32)).filter_map(|mut image| {
            let image: [f64; D] = std::array::from_fn(|axis| {
                let turn = turns[image % turns.len()];
                image /= turns.len();
                place[axis] + turn * extent[axis]
            });
            let image = in_space_of(&image);
            Some(self.tree.nearest_point(image)? - image)
        });
        let nearest = offsets.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let nearest = nearest.expect("there is a point").to_array();
        std::array::from_fn(|axis| nearest[axis])
    }
}

/// A vector of the plane or of space as one of space.
fn in_space<T: Copy + Default, const D: usize>(vector: &[T; D]) -> [T; 3] {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or_default())
}

/// [`in_space`] for arithmetic.
fn in_space_of<const D: usize>(vector: &[f64; D]) -> DVec3 {
    DVec3::from_array(in_space(vector))
}
