//! Triangle quality of the Delaunay triangulation (thesis §4.4.4 and Fig. 4.21), for remeshing.

use glam::DVec2;

use crate::analysis::BYTES_PER_TRIANGULATED_POINT;
use crate::error::Result;
use crate::geometry::{Delaunay, Frame, Site};
use crate::job::{Context, Job, Progress, chunks, chunks_of};
use crate::memory;
use crate::mesh::exact;
use crate::points::{Boundary, Domain};

/// A triangle of the Delaunay triangulation of a set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Triangle {
    /// The corners, counter-clockwise, in the units of the domain.
    pub corners: [[f64; 2]; 3],
}

impl Triangle {
    /// A triangle of space, laid into the plane: the first corner at 0, the second on the x axis.
    pub fn in_space(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(exact);
        let (x, length) = ((b - a).normalize_or_zero(), (b - a).length());
        let along = (c - a).dot(x);
        Self { corners: [[0.0; 2], [length, 0.0], [along, (c - a - along * x).length()]] }
    }

    /// The area, in the units of the domain.
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.corners.map(DVec2::from_array);
        (b - a).perp_dot(c - a) / 2.0
    }

    /// True if an angle is above 90 degrees.
    pub fn is_obtuse(&self) -> bool {
        self.cosines().iter().any(|&cosine| cosine < 0.0)
    }

    /// The lengths of the edges.
    pub fn edges(&self) -> [f64; 3] {
        let corners = self.corners.map(DVec2::from_array);
        std::array::from_fn(|i| corners[i].distance(corners[(i + 1) % 3]))
    }

    /// The cosines of the angles.
    fn cosines(&self) -> [f64; 3] {
        let corners = self.corners.map(DVec2::from_array);
        std::array::from_fn(|i| {
            let side = |other: usize| (corners[(i + other) % 3] - corners[i]).normalize_or_zero();
            side(1).dot(side(2))
        })
    }
}

/// The Delaunay triangles of a set, each once. Takes O(n log n).
///
/// On a torus there are twice as many triangles as points, and triangles across the boundary reach out of the
/// domain on one of the sides. On a bounded domain triangles are left out that cross the boundary when the set is
/// mirrored by it, so there are no slivers along the convex hull.
///
/// Lattices with more than three points on an empty circle have more than one triangulation, which need not be the same
/// on both sides of the torus: there some triangles may be missing and others overlap.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain and for points outside it (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn delaunay_triangles(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Vec<Triangle>> {
    domain.check_set(points)?;
    context.run(progress, |job| triangulate(job, domain, points))
}

fn triangulate(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<Vec<Triangle>> {
    if points.is_empty() {
        return Ok(Vec::new());
    }
    memory::require_points("positions", points.len(), BYTES_PER_TRIANGULATED_POINT)?;
    let frame = Frame::new(*domain, points.len());
    let positions = frame.enter(points);
    let delaunay = Delaunay::new(&job.part(0.0, 0.9), &frame, positions.iter().copied())?;
    triangles_of(&job.part(0.9, 1.0), domain, &frame, &positions, &delaunay)
}

/// The triangles of the triangulation of some positions, each once.
pub(super) fn triangles_of(
    job: &Job,
    domain: &Domain,
    frame: &Frame,
    positions: &[DVec2],
    delaunay: &Delaunay,
) -> Result<Vec<Triangle>> {
    // By the point that a corner is a copy of, and then by its own place, which orders the images of a point alike on
    // every side. Not by numbers: coincident points are one corner, which has the number of any of them.
    let key = |site: &Site| {
        let (of, at) = (positions[site.source as usize], site.position);
        [of.x, of.y, at.x, at.y]
    };
    let order = |a: &&Site, b: &&Site| key(a).partial_cmp(&key(b)).expect("sites are finite");
    // On a torus a triangle has several images: the one counts whose first corner is a point of the domain.
    let is_counted = |point: usize, corners: &[Site; 3]| {
        let first = corners.iter().min_by(order);
        first.is_some_and(|site| site.is_original() && site.source as usize == point)
            && (domain.boundary == Boundary::Periodic || corners.iter().all(Site::is_original))
    };
    let place = |corner: Site| (DVec2::from_array(domain.min) + corner.position * frame.spacing()).to_array();
    let chunks = chunks(delaunay.len());
    job.concat(chunks.len(), |chunk| {
        let counted = chunks
            .range(chunk)
            .flat_map(|point| delaunay.triangles_at(point).filter(move |corners| is_counted(point, corners)));
        counted.map(|corners| Triangle { corners: corners.map(place) }).collect()
    })
}

/// Statistics of the triangles of a set ([`delaunay_triangles`]). Shares and variations of nothing are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct TriangleStatistics {
    /// The number of triangles.
    pub triangles: u64,
    /// The share of triangles with an angle above 90 degrees.
    pub obtuse: f64,
    /// The share of triangles with an angle below 30 degrees.
    pub below_30_degrees: f64,
    /// The share of angles below 30 degrees.
    pub angles_below_30_degrees: f64,
    /// The mean length of the edges, in the units of the domain.
    pub edge_mean: f64,
    /// The variance of the edge lengths over the square of their mean (CV²).
    pub edge_variation: f64,
    /// The variance of the triangle areas over the square of their mean.
    pub area_variation: f64,
    /// The share of triangles whose area is more than 4 standard deviations from the mean: those of this set.
    pub beyond_4_sigma: f64,
}

/// Measures the Delaunay triangles of a set. Takes O(n log n).
///
/// # Errors
/// As [`delaunay_triangles`].
pub fn triangle_statistics(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<TriangleStatistics> {
    domain.check_set(points)?;
    context.run(progress, |job| {
        let triangles = triangulate(&job.part(0.0, 0.9), domain, points)?;
        TriangleStatistics::shared(&job.part(0.9, 1.0), &triangles)
    })
}

impl TriangleStatistics {
    /// Measures any triangles, as those of the samples of a surface
    /// ([`dcr::surface::triangulate`](crate::dcr::surface::triangulate)).
    pub fn of(triangles: &[Triangle]) -> Self {
        let parts = || triangles.chunks(PART);
        let sums = parts().map(Sums::of).fold(Sums::default(), Sums::plus);
        Self::from_sums(&sums, parts().map(|part| sums.outlying(part)).sum())
    }

    /// [`TriangleStatistics::of`] by all threads.
    pub(super) fn shared(job: &Job, triangles: &[Triangle]) -> Result<Self> {
        let parts = chunks_of(triangles.len(), PART);
        let part = |part: usize| &triangles[parts.range(part)];
        let sums = job.part(0.0, 0.8).map(parts.len(), |i| Sums::of(part(i)))?;
        let sums = sums.into_iter().fold(Sums::default(), Sums::plus);
        let outlying = job.part(0.8, 1.0).map(parts.len(), |i| sums.outlying(part(i)))?;
        Ok(Self::from_sums(&sums, outlying.into_iter().sum()))
    }

    fn from_sums(sums: &Sums, outlying: usize) -> Self {
        let share = |part: usize| part as f64 / sums.triangles.max(1) as f64;
        Self {
            triangles: sums.triangles as u64,
            obtuse: share(sums.obtuse),
            below_30_degrees: share(sums.sharp),
            angles_below_30_degrees: share(sums.sharp_angles) / 3.0,
            edge_mean: sums.edges.mean(),
            edge_variation: sums.edges.variation(),
            area_variation: sums.areas.variation(),
            beyond_4_sigma: share(outlying),
        }
    }
}

/// The number of triangles summed up at a time by any number of threads: it fixes the order of the sums.
const PART: usize = 1 << 13;

/// The sums over triangles.
#[derive(Clone, Copy, Default)]
struct Sums {
    triangles: usize,
    areas: Moments,
    /// Inner edges count twice, once with each of their triangles.
    edges: Moments,
    obtuse: usize,
    sharp: usize,
    sharp_angles: usize,
}

impl Sums {
    fn of(triangles: &[Triangle]) -> Self {
        let mut sums = Self { triangles: triangles.len(), ..Self::default() };
        for triangle in triangles {
            sums.areas.add(triangle.area());
            triangle.edges().into_iter().for_each(|edge| sums.edges.add(edge));
            let cosines = triangle.cosines();
            let angles = cosines.iter().filter(|&&cosine| cosine > 0.75f64.sqrt()).count();
            sums.obtuse += usize::from(cosines.iter().any(|&cosine| cosine < 0.0));
            sums.sharp += usize::from(angles > 0);
            sums.sharp_angles += angles;
        }
        sums
    }

    fn plus(self, other: Self) -> Self {
        Self {
            triangles: self.triangles + other.triangles,
            areas: self.areas.plus(other.areas),
            edges: self.edges.plus(other.edges),
            obtuse: self.obtuse + other.obtuse,
            sharp: self.sharp + other.sharp,
            sharp_angles: self.sharp_angles + other.sharp_angles,
        }
    }

    /// The triangles, among these, whose area is far from the mean.
    fn outlying(&self, triangles: &[Triangle]) -> usize {
        let (mean, limit) = (self.areas.mean(), SIGMAS * self.areas.variation().sqrt() * self.areas.mean());
        triangles.iter().filter(|triangle| (triangle.area() - mean).abs() > limit).count()
    }
}

/// The number of standard deviations from which on an area is outlying.
const SIGMAS: f64 = 4.0;

/// Sums of a quantity and of its square.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, x: f64) {
        self.count += 1.0;
        self.sum += x;
        self.squares += x * x;
    }

    fn plus(self, other: Self) -> Self {
        Self { count: self.count + other.count, sum: self.sum + other.sum, squares: self.squares + other.squares }
    }

    fn mean(&self) -> f64 {
        if self.count > 0.0 { self.sum / self.count } else { 0.0 }
    }

    /// The variance over the square of the mean.
    fn variation(&self) -> f64 {
        let mean = self.mean();
        if mean > 0.0 { (self.squares / self.count / (mean * mean) - 1.0).max(0.0) } else { 0.0 }
    }
}
