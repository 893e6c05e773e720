//! The promises of a set with its own radius for each sample, checked in the plainest way.

use azulejo::Points;
use azulejo::mesh::Mesh;

use crate::common::buckets::Buckets;
use crate::common::parts;
pub use crate::common::surface_oracle::Ball;
use crate::common::tolerance;
use crate::common::triangle::{distance, exact, has_area, normal};

type Point = [f64; 3];

/// The radius on a mesh, as the caller knows it.
pub enum Field<'a> {
    PerVertex(&'a [f32]),
    /// The square root of 1 over a density of the vertices.
    DensityPerVertex(&'a [f32]),
    /// With the slope that is promised.
    Function(&'a dyn Fn(Point) -> f64, f64),
}

/// A part of a triangle: its corners and their barycentrics.
#[derive(Clone, Copy)]
struct Part {
    triangle: u32,
    corners: [(Point, [f64; 2]); 3],
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f64 {
    let ([a, b, c], [d, e, f]) = (exact(a), exact(b));
    a * d + b * e + c * f
}

/// True if samples on triangles with these normals matter to each other.
fn sees(a: [f32; 3], b: [f32; 3], cosine: f64) -> bool {
    a == b || cosine <= -1.0 || dot(a, b) >= cosine
}

fn middle((a, s): (Point, [f64; 2]), (b, t): (Point, [f64; 2])) -> (Point, [f64; 2]) {
    (std::array::from_fn(|axis| (a[axis] + b[axis]) / 2.0), std::array::from_fn(|i| (s[i] + t[i]) / 2.0))
}

impl Field<'_> {
    fn at(&self, mesh: &Mesh, triangle: u32, position: Point, [u, v]: [f64; 2]) -> f64 {
        let interpolated = |values: &[f32]| {
            let [a, b, c] = mesh.triangles()[triangle as usize].map(|vertex| f64::from(values[vertex as usize]));
            (1.0 - u - v) * a + u * b + v * c
        };
        match self {
            Self::PerVertex(radii) => interpolated(radii),
            Self::DensityPerVertex(densities) => 1.0 / interpolated(densities).max(1e-30).sqrt(),
            Self::Function(at, _) => at(position),
        }
    }

    /// No radius on the part is less.
    fn least(&self, mesh: &Mesh, part: &Part) -> f64 {
        let corners = part.corners.map(|(position, uv)| self.at(mesh, part.triangle, position, uv));
        let least = corners.into_iter().fold(f64::INFINITY, f64::min);
        match self {
            Self::PerVertex(_) | Self::DensityPerVertex(_) => least,
            Self::Function(_, slope) => least - slope * part.longest(),
        }
    }

    /// No radius on the part is more.
    fn largest(&self, mesh: &Mesh, part: &Part) -> f64 {
        match self {
            Self::PerVertex(_) | Self::DensityPerVertex(_) => {
                let radius = |(position, uv)| self.at(mesh, part.triangle, position, uv);
                part.corners.map(radius).into_iter().fold(0.0, f64::max)
            }
            Self::Function(_, slope) => self.least(mesh, part) + 3.0 * slope * part.longest(),
        }
    }
}

impl Part {
    fn sides(&self) -> [f64; 3] {
        let [a, b, c] = self.corners.map(|corner| corner.0);
        [distance(b, c), distance(c, a), distance(a, b)]
    }

    fn longest(&self) -> f64 {
        self.sides().into_iter().fold(0.0, f64::max)
    }

    /// Four quarters, or two halves where it is much longer than wide.
    fn parts(&self) -> Vec<Self> {
        let corners = parts::parts(self.corners, self.sides(), middle);
        corners.into_iter().map(|corners| Self { corners, ..*self }).collect()
    }
}

/// The documented tolerance of a maximal set whose radii are a multiple of those of a field, which change over it.
pub fn tolerance(mesh: &Mesh, field: &Field, multiple: f64) -> f64 {
    let way = tolerance::tolerance(mesh);
    if let Field::Function(_, slope) = field {
        return way * (1.0 + multiple * slope);
    }
    let of_triangle = |triangle: u32| {
        let corners = mesh.corners(triangle).map(exact);
        let side = |i: usize, j: usize| distance(corners[i], corners[j]);
        let height = 2.0 * mesh.triangle_area(triangle) / side(0, 1).max(side(1, 2)).max(side(2, 0));
        let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|uv| field.at(mesh, triangle, corners[0], uv));
        let change = multiple * (a.max(b).max(c) - a.min(b).min(c));
        way * (1.0 + change / height) + change * 2f64.powi(-22)
    };
    let triangles = (0..mesh.triangles().len() as u32).filter(|&triangle| mesh.triangle_area(triangle) > 0.0);
    triangles.map(of_triangle).fold(0.0, f64::max)
}

/// A sample whose radius is not what the field says.
pub fn wrong_radius(mesh: &Mesh, field: &Field, samples: &Points<3>, radii: &[f64]) -> Option<usize> {
    assert_eq!(samples.len(), radii.len());
    (0..radii.len()).find(|&i| {
        let uv = samples.barycentrics[i].map(f64::from);
        radii[i] != field.at(mesh, samples.triangles[i], exact(samples.positions[i]), uv)
    })
}

/// The first two samples found that are closer than the mean of their radii, unless their normals are too different.
pub fn conflict(samples: &Points<3>, radii: &[f64], cosine: f64) -> Option<(usize, usize)> {
    let (normals, largest) = (&samples.normals, largest(radii));
    let buckets = Buckets::new(&samples.positions, 1.01 * largest);
    buckets.all().iter().find_map(|&(i, point)| {
        let conflicts = |&(j, other): &(usize, Point)| {
            j < i && distance(point, other) < (radii[i] + radii[j]) / 2.0 && sees(normals[i], normals[j], cosine)
        };
        buckets.near(&[point], largest).into_iter().find(conflicts).map(|(j, _)| (j, i))
    })
}

fn largest(radii: &[f64]) -> f64 {
    radii.iter().copied().fold(0.0, f64::max)
}

/// A point of the surface for which it could not be proved that a sample is nearer than the mean of the two radii, up to
/// a tolerance.
pub fn gap(
    mesh: &Mesh,
    field: &Field,
    samples: &Points<3>,
    radii: &[f64],
    cosine: f64,
    tolerance: f64,
) -> Option<Point> {
    gap_around(mesh, field, samples, radii, cosine, tolerance, &[])
}

/// [`gap`] where places are also covered that are nearer to a given sample than its clearance, whatever their normal.
pub fn gap_around(
    mesh: &Mesh,
    field: &Field,
    samples: &Points<3>,
    radii: &[f64],
    cosine: f64,
    tolerance: f64,
    given: &[Ball],
) -> Option<Point> {
    gap_between(mesh, field, samples, radii, cosine, tolerance, given, |_| true, |_| 1.0)
}

/// [`gap_around`] on some triangles, where each sample covers within a multiple of the mean of the two radii.
#[allow(clippy::too_many_arguments)]
pub fn gap_between(
    mesh: &Mesh,
    field: &Field,
    samples: &Points<3>,
    radii: &[f64],
    cosine: f64,
    tolerance: f64,
    given: &[Ball],
    allows: impl Fn(u32) -> bool,
    multiple: impl Fn(usize) -> f64,
) -> Option<Point> {
    let given: Vec<_> = given.iter().copied().filter(|given| given.1 > 0.0).collect();
    let most = (0..radii.len()).map(&multiple).fold(0.0, f64::max);
    let buckets = Buckets::new(&samples.positions, 2.0 * (most * largest(radii) + tolerance));
    let is_asked = |&triangle: &u32| mesh.is_sampled(triangle) && allows(triangle);
    (0..mesh.triangles().len() as u32).filter(is_asked).find_map(|triangle| {
        let [a, b, c] = mesh.corners(triangle).map(exact);
        if !has_area([a, b, c]) {
            return None;
        }
        let normal = normal(mesh, triangle);
        let whole = Part { triangle, corners: [(a, [0.0, 0.0]), (b, [1.0, 0.0]), (c, [0.0, 1.0])] };
        let reach = most * (field.largest(mesh, &whole) + largest(radii)) / 2.0 + tolerance;
        let seen = |&(i, _): &(usize, Point)| sees(samples.normals[i], normal, cosine);
        let near = buckets.near(&[a, b, c], reach).into_iter().filter(seen);
        let balls = near.map(|(i, point)| (point, radii[i], multiple(i))).collect::<Vec<_>>();
        gap_in_part(mesh, field, &whole, &balls, &given, tolerance)
    })
}

/// A sample that is nearer to a given one than its clearance.
pub fn too_near(samples: &Points<3>, given: &[Ball]) -> Option<usize> {
    let is_too_near = |&position: &[f32; 3]| given.iter().any(|given| distance(exact(position), given.0) < given.1);
    samples.positions.iter().position(is_too_near)
}

/// The centre and the radius of a sample, and the multiple of the mean of two radii within which it covers.
type Covering = (Point, f64, f64);

/// A part is covered when its corners are near enough to one sample or given sample; otherwise its parts must be.
fn gap_in_part(
    mesh: &Mesh,
    field: &Field,
    part: &Part,
    balls: &[Covering],
    given: &[Ball],
    tolerance: f64,
) -> Option<Point> {
    let least = field.least(mesh, part);
    let covers = |&(centre, radius, multiple): &Covering| {
        let reach = multiple * (least + radius) / 2.0 + tolerance;
        multiple > 0.0 && part.corners.iter().all(|&(corner, _)| distance(corner, centre) <= reach)
    };
    let is_clear =
        |given: &Ball| part.corners.iter().all(|&(corner, _)| distance(corner, given.0) <= given.1 + tolerance);
    if balls.iter().any(covers) || given.iter().any(is_clear) {
        return None;
    }
    let (corner, longest) = (part.corners[0].0, part.longest());
    if longest < tolerance / 100.0 {
        return Some(corner);
    }
    let largest = field.largest(mesh, part);
    let near = |&&(centre, radius, multiple): &&Covering| {
        distance(corner, centre) <= multiple * (largest + radius) / 2.0 + longest + tolerance
    };
    let near: Vec<_> = balls.iter().filter(near).copied().collect();
    let reaches = |given: &&Ball| distance(corner, given.0) <= given.1 + longest + tolerance;
    let given: Vec<_> = given.iter().filter(reaches).copied().collect();
    part.parts().iter().find_map(|part| gap_in_part(mesh, field, part, &near, &given, tolerance))
}
