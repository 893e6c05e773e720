//! Coverage of a surface, by cutting it into fragments: a place of a fragment is no farther from the samples than its
//! centre, plus the distance of the farthest corner from the centre.

use glam::DVec3;

use crate::analysis::coverage::groups::{DEPTH, LINK, check_count, group, most_uncovered};
use crate::analysis::coverage::{Coverage, PRECISION};
use crate::check;
use crate::error::Result;
use crate::index::PointTree;
use crate::job::{Context, Job, Progress, chunks_of};
use crate::memory;
use crate::mesh::Mesh;
use crate::psp::TOLERANCE;

/// Triangles are cut before work on them is shared, until none has more than this share of the area.
const SHARE: f64 = 1.0 / 2048.0;
/// The fragments of a task, and of one that gathers their uncovered parts, which may be many.
const TASK: usize = 64;
const GATHERED: usize = 8;

/// The most bytes per point, in the tree, and per triangle.
const BYTES_PER_POINT: f64 = 26.0;
const BYTES_PER_TRIANGLE: f64 = 106.0;
/// The most bytes per uncovered place.
const BYTES_PER_PLACE: f64 = 60.0;

/// The covering radius of samples on a mesh: the straight distance from the samples of the place of the surface that is
/// farthest from all of them. A set is maximal for a radius if this is not above it. Infinite for an empty set, 0 where
/// the mesh's mask leaves no area.
///
/// Found by branch and bound in `f64`, as [`covering_radius_2d`](super::covering_radius_2d): too small by at most the
/// factor 1 + [`PRECISION`]. Triangles without area do not count.
///
/// Takes O((n + triangles) log n) for samples that are spread about evenly.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for positions that are not finite;
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn surface_covering_radius(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    progress: Option<&Progress>,
) -> Result<f64> {
    check::finite("positions", "position", positions)?;
    require_memory(mesh, positions.len())?;
    context.run(progress, |job| {
        let tree = PointTree::of(&job.part(0.0, 0.1), positions)?;
        farthest(&job.part(0.1, 1.0), &tree, &TrianglePart::of(mesh))
    })
}

/// The coverage of a mesh by disks of `radius` around samples, by straight distance.
///
/// Uncovered is what is farther than `radius` from all samples, by more than [`TOLERANCE`] float spacings at the largest
/// coordinate of the mesh: the rounding of positions can leave less than that uncovered. A *gap* here is a group of
/// uncovered places in which each is within half of the radius of another one, so that hardly more than a sample is
/// missing in a small one: a connected part of the uncovered surface, or several that are this near to each other.
/// Surfaces may touch and cross, so that distances in space decide, not shared edges. Each gap deeper than a millionth of the radius is found, however narrow.
///
/// Takes what [`surface_covering_radius`] takes, and about 100 fragments for each square of the radius that is
/// uncovered.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a radius that is not positive and finite and for positions
/// that are not finite;
/// [`Error::TooLarge`](crate::Error::TooLarge) for a `radius` that leaves uncovered more than some 600,000 times its square;
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn surface_coverage(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    radius: f64,
    progress: Option<&Progress>,
) -> Result<Coverage> {
    check::radius(radius)?;
    check::finite("positions", "position", positions)?;
    require_memory(mesh, positions.len())?;
    context.run(progress, |job| {
        let tree = PointTree::of(&job.part(0.0, 0.1), positions)?;
        let fragments = TrianglePart::of(mesh);
        let farthest = farthest(&job.part(0.1, 0.6), &tree, &fragments)?;
        let reach = radius + TOLERANCE * mesh.float_spacing();
        if farthest <= reach {
            return Ok(Coverage { farthest, gaps: 0 });
        }
        let uncovered = gather(&job.part(0.6, 0.8), &tree, &fragments, reach)?;
        let place = |id: u32| uncovered[id as usize].map(f64::from);
        let gaps = group(&job.part(0.8, 1.0), uncovered.len(), place, LINK * radius)?.count().max(1);
        Ok(Coverage { farthest, gaps })
    })
}

/// Refuses more points and triangles than fit in memory.
fn require_memory(mesh: &Mesh, count: usize) -> Result<()> {
    let triangles = mesh.triangles().len();
    let bytes = BYTES_PER_POINT * count as f64 + BYTES_PER_TRIANGLE * triangles as f64;
    memory::require(bytes, "positions", &format!("{count} points on {triangles} triangles"))
}

/// A place of each uncovered part of the fragments that is small enough to be of one gap.
fn gather(job: &Job, tree: &PointTree, fragments: &[TrianglePart], radius: f64) -> Result<Vec<[f32; 3]>> {
    // More places than can be kept are refused before any is gathered.
    let tasks = chunks_of(fragments.len(), TASK);
    let least = job.part(0.0, 0.1).map(tasks.len(), |task| {
        let uncovered = fragments[tasks.range(task)].iter().filter(|fragment| fragment.is_uncovered(tree, radius));
        uncovered.map(|fragment| fragment.least_parts(radius)).sum::<f64>()
    })?;
    let most = most_uncovered(BYTES_PER_PLACE);
    check_count(least.into_iter().sum::<f64>() as usize, most)?;
    let tasks = chunks_of(fragments.len(), GATHERED);
    let mut uncovered = Vec::new();
    let task = |task: usize| {
        let mut found = Vec::new();
        fragments[tasks.range(task)].iter().try_for_each(|fragment| fragment.gather(tree, radius, most, &mut found))?;
        Ok(found)
    };
    let keep = |found: Result<Vec<[f32; 3]>>| {
        uncovered.extend(found?);
        check_count(uncovered.len(), most)
    };
    job.part(0.1, 1.0).stream(tasks.len(), task, keep)?;
    Ok(uncovered)
}

/// The largest distance of a place of the fragments; infinite without samples.
fn farthest(job: &Job, tree: &PointTree, fragments: &[TrianglePart]) -> Result<f64> {
    let tasks = chunks_of(fragments.len(), TASK);
    let farther = |known: f64, fragment: &TrianglePart| tree.nearest_beyond(fragment.centre, known).unwrap_or(known);
    let known = job.part(0.0, 0.2).map(tasks.len(), |task| fragments[tasks.range(task)].iter().fold(0.0, farther))?;
    let known = known.into_iter().fold(0.0, f64::max);
    if known == f64::INFINITY {
        return Ok(known);
    }
    let found = job.part(0.2, 1.0).map(tasks.len(), |task| {
        let mut farthest: f64 = known;
        let mut fragments = fragments[tasks.range(task)].to_vec();
        while !fragments.is_empty() {
            let mut open = Vec::new();
            for fragment in &fragments {
                let enough = farthest * (1.0 + PRECISION) - fragment.reach;
                if let Some(distance) = tree.nearest_beyond(fragment.centre, enough) {
                    farthest = farthest.max(distance);
                    open.push((fragment, distance));
                }
            }
            let could_exceed =
                |fragment: &TrianglePart, distance: f64| distance + fragment.reach > farthest * (1.0 + PRECISION);
            open.retain(|&(fragment, distance)| could_exceed(fragment, distance));
            fragments = open.into_iter().flat_map(|(fragment, _)| fragment.halves()).collect();
        }
        farthest
    })?;
    Ok(found.into_iter().fold(known, f64::max))
}

/// A part of a triangle.
#[derive(Clone, Copy)]
struct TrianglePart {
    corners: [DVec3; 3],
    centre: DVec3,
    /// The distance of the farthest corner from the centre.
    reach: f64,
}

impl TrianglePart {
    /// The triangles that have an area and that the mask does not leave out, the large ones cut.
    fn of(mesh: &Mesh) -> Vec<Self> {
        let limit = SHARE * mesh.area();
        let mut fragments = Vec::new();
        for (triangle, _) in mesh.triangles_with_area(0..mesh.triangles().len()) {
            Self::new(mesh.exact_corners(triangle)).cut(limit, &mut fragments);
        }
        fragments
    }

    /// Cuts it into parts of an area of at most `limit`.
    fn cut(self, limit: f64, parts: &mut Vec<Self>) {
        let halves = self.halves();
        // A part that rounding does not let become smaller is left as it is.
        let area = self.area();
        if area > limit && halves.iter().all(|half| half.area() < area) {
            halves.into_iter().for_each(|half| half.cut(limit, parts));
        } else {
            parts.push(self);
        }
    }

    fn new(corners: [DVec3; 3]) -> Self {
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let reach = corners.iter().map(|corner| corner.distance(centre)).fold(0.0, f64::max);
        Self { corners, centre, reach }
    }

    /// Its two parts on either side of the middle of its longest side.
    fn halves(&self) -> [Self; 2] {
        let side = |i: usize| self.corners[(i + 1) % 3].distance_squared(self.corners[(i + 2) % 3]);
        let opposite = (1..3).fold(0, |longest, i| if side(i) > side(longest) { i } else { longest });
        let [tip, a, b] = [0, 1, 2].map(|i| self.corners[(opposite + i) % 3]);
        let middle = 0.5 * (a + b);
        [Self::new([tip, a, middle]), Self::new([tip, middle, b])]
    }

    /// Appends a place of each uncovered part of it that is small enough to be of one gap.
    fn gather(&self, tree: &PointTree, radius: f64, most: usize, uncovered: &mut Vec<[f32; 3]>) -> Result<()> {
        check_count(uncovered.len(), most)?;
        let Some(distance) = tree.nearest_beyond(self.centre, radius * (1.0 + DEPTH) - self.reach) else {
            return Ok(());
        };
        if distance - self.reach > radius {
            self.gather_all(radius, most, uncovered)
        } else if self.reach <= 0.25 * LINK * radius {
            uncovered.extend(self.uncovered(tree, radius).map(|place| place.as_vec3().to_array()));
            Ok(())
        } else {
            self.halves().iter().try_for_each(|half| half.gather(tree, radius, most, uncovered))
        }
    }

    /// Appends places of all of it, none of which is covered.
    fn gather_all(&self, radius: f64, most: usize, uncovered: &mut Vec<[f32; 3]>) -> Result<()> {
        check_count(uncovered.len().saturating_add(self.least_parts(radius) as usize), most)?;
        if self.reach <= 0.25 * LINK * radius {
            uncovered.push(self.centre.as_vec3().to_array());
            return Ok(());
        }
        self.halves().iter().try_for_each(|half| half.gather_all(radius, most, uncovered))
    }

    /// At least so many places are gathered if all of it is uncovered.
    fn least_parts(&self, radius: f64) -> f64 {
        let smallest = 0.25 * LINK * radius;
        // Halves are no larger than a right triangle of that reach, which has 0.9 of its square. A needle is as long as
        // a chain of them.
        (self.area() / (smallest * smallest)).max(self.reach / (2.0 * smallest))
    }

    /// True if no place of it is covered.
    fn is_uncovered(&self, tree: &PointTree, radius: f64) -> bool {
        tree.nearest_beyond(self.centre, radius + self.reach).is_some_and(|distance| distance - self.reach > radius)
    }

    fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }

    /// A place of it that is farther from the samples than `radius`.
    fn uncovered(&self, tree: &PointTree, radius: f64) -> Option<DVec3> {
        let distance = tree.nearest(self.centre);
        if distance > radius {
            Some(self.centre)
        } else if distance + self.reach <= radius * (1.0 + DEPTH) {
            None
        } else {
            self.halves().iter().find_map(|half| half.uncovered(tree, radius))
        }
    }
}
