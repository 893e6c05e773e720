//! Coverage of a cuboid, by cutting it into cells.

use crate::analysis::coverage::groups::{DEPTH, LINK, check_count, group, most_uncovered};
use crate::analysis::coverage::{Coverage, Nearest, SearchCell, SearchCells, covering_radius, length};
use crate::check;
use crate::error::Result;
use crate::job::{Context, Job, Progress, chunks_of};
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain};
use crate::psp::TOLERANCE;

/// The cells of a task, and of one that gathers their uncovered parts, which may be many.
const TASK: usize = 512;
const GATHERED: usize = 32;

/// The most bytes per uncovered place.
const BYTES_PER_PLACE: f64 = 110.0;

/// Cells are cut until none that is uncovered reaches farther from its centre, in radii.
const SMALLEST: f64 = 0.25 * LINK;

/// The covering radius of a set in a cuboid: as [`covering_radius_2d`](super::covering_radius_2d) in the plane, found in the
/// same way, and too small by at most the factor 1 + [`PRECISION`](super::PRECISION).
///
/// Takes O(n log n).
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain and for points outside it (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn covering_radius_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
    progress: Option<&Progress>,
) -> Result<f64> {
    domain.check_set(points)?;
    context.run(progress, |job| covering_radius(job, domain, points))
}

/// The coverage of a cuboid by balls of `radius` around the points of a set.
///
/// Uncovered is what is farther than `radius` from all points, by more than [`TOLERANCE`] float spacings at the largest
/// coordinate of the domain. A *gap* is a group of uncovered places in which each is within half of the radius of another one,
/// around the torus on a periodic domain, as on meshes: see [`surface_coverage`](super::surface_coverage). Each gap deeper
/// than a millionth of the radius is found, however narrow, and the deepest in any case. An empty set has one.
///
/// Takes what [`covering_radius_3d`] takes, and some 1,000 cells for each cube of the radius that is uncovered.
///
/// # Errors
/// As [`covering_radius_3d`]; [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a radius that is not positive and
/// finite; [`Error::TooLarge`](crate::Error::TooLarge) for a `radius` that leaves uncovered more than some 25,000 times its
/// cube.
pub fn coverage_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
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
            _ => gaps(&job.part(0.5, 1.0), domain, points, reach)?.max(1),
        };
        Ok(Coverage { farthest, gaps })
    })
}

/// The number of groups of places farther than `radius` from all points, of which there is at least one.
fn gaps(job: &Job, domain: &Domain<3>, points: &[[f32; 3]], radius: f64) -> Result<usize> {
    let nearest = Nearest::new(&job.part(0.0, 0.1), domain, points)?;
    let mut places = gather(&job.part(0.1, 0.8), &nearest, &SearchCells::about(domain, points.len()), radius)?;
    let originals =
        if domain.boundary == Boundary::Periodic { add_images(domain, &mut places, LINK * radius) } else { Vec::new() };
    let first = (places.len() - originals.len()) as u32;
    let mut groups = group(&job.part(0.8, 1.0), places.len(), |id| places[id as usize], LINK * radius)?;
    (first..).zip(originals).for_each(|(image, original)| groups.link(original, image));
    Ok(groups.count())
}

/// Appends the images of places that lie up to `reach` beyond the upper faces. Returns the places that they are images of.
fn add_images(domain: &Domain<3>, places: &mut Vec<[f64; 3]>, reach: f64) -> Vec<u32> {
    let mut originals = Vec::new();
    let extent = domain.extent();
    for axis in 0..3 {
        // Images of images stand at the edges and corners.
        for id in 0..places.len() {
            let mut image = places[id];
            if image[axis] <= domain.min[axis] + reach {
                image[axis] += extent[axis];
                places.push(image);
                originals.push(id as u32);
            }
        }
    }
    originals
}

/// A place of each uncovered part of the cells that is small enough to be of one gap.
fn gather(job: &Job, nearest: &Nearest<3>, cells: &SearchCells<3>, radius: f64) -> Result<Vec<[f64; 3]>> {
    // More places than can be kept are refused before any is gathered.
    let tasks = chunks_of(cells.len(), TASK);
    let least = job.part(0.0, 0.1).map(tasks.len(), |task| {
        let uncovered = tasks.range(task).map(|cell| cells.get(cell)).filter(|cell| cell.is_uncovered(nearest, radius));
        uncovered.map(|cell| cell.least_parts(radius)).sum::<f64>()
    })?;
    let most = most_uncovered(BYTES_PER_PLACE);
    check_count(least.into_iter().sum::<f64>() as usize, most)?;
    let tasks = chunks_of(cells.len(), GATHERED);
    let mut uncovered = Vec::new();
    let task = |task: usize| {
        let mut found = Vec::new();
        tasks.range(task).try_for_each(|cell| cells.get(cell).gather(nearest, radius, most, &mut found))?;
        Ok(found)
    };
    let keep = |found: Result<Vec<[f64; 3]>>| {
        uncovered.extend(found?);
        check_count(uncovered.len(), most)
    };
    job.part(0.1, 1.0).stream(tasks.len(), task, keep)?;
    Ok(uncovered)
}

impl SearchCell<3> {
    /// The distance of its corners from its centre.
    fn reach(&self) -> f64 {
        length(self.half)
    }

    /// True if no place of it is covered.
    fn is_uncovered(&self, nearest: &Nearest<3>, radius: f64) -> bool {
        length(nearest.offset(self.centre)) - self.reach() > radius
    }

    /// At least so many places are gathered if all of it is uncovered.
    fn least_parts(&self, radius: f64) -> f64 {
        // The sides of the largest cube that is not cut. A needle is as long as a chain of places.
        let cube = 2.0 * SMALLEST * radius / 3f64.sqrt();
        let sides = self.half.map(|half| 2.0 * half / cube);
        sides.into_iter().product::<f64>().max(self.reach() / (SMALLEST * radius))
    }

    /// Appends a place of each uncovered part of it that is small enough to be of one gap.
    fn gather(&self, nearest: &Nearest<3>, radius: f64, most: usize, uncovered: &mut Vec<[f64; 3]>) -> Result<()> {
        check_count(uncovered.len(), most)?;
        let offset = nearest.offset(self.centre);
        if self.bound(offset) <= radius * (1.0 + DEPTH) {
            Ok(())
        } else if length(offset) - self.reach() > radius {
            self.gather_all(radius, most, uncovered)
        } else if self.reach() <= SMALLEST * radius {
            uncovered.extend(self.uncovered(nearest, radius));
            Ok(())
        } else {
            self.parts(offset).try_for_each(|part| part.gather(nearest, radius, most, uncovered))
        }
    }

    /// Appends places of all of it, none of which is covered.
    fn gather_all(&self, radius: f64, most: usize, uncovered: &mut Vec<[f64; 3]>) -> Result<()> {
        check_count(uncovered.len().saturating_add(self.least_parts(radius) as usize), most)?;
        if self.reach() <= SMALLEST * radius {
            uncovered.push(self.centre);
            return Ok(());
        }
        self.parts([0.0; 3]).try_for_each(|part| part.gather_all(radius, most, uncovered))
    }

    /// A place of it that is farther from the points than `radius`.
    fn uncovered(&self, nearest: &Nearest<3>, radius: f64) -> Option<[f64; 3]> {
        let offset = nearest.offset(self.centre);
        if length(offset) > radius {
            Some(self.centre)
        } else if self.bound(offset) <= radius * (1.0 + DEPTH) {
            None
        } else {
            self.parts(offset).find_map(|part| part.uncovered(nearest, radius))
        }
    }
}
