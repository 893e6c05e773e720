//! A checked triangle soup, and the points on it.
//!
//! Nothing is asked of the topology: open, non-manifold, self-intersecting, duplicated and oppositely wound faces are
//! all welcome. What is asked is checked once, here, so that no later stage meets a bad number or index.

use std::path::Path;

use glam::DVec3;

use crate::error::{Error, Result};

mod obj;
mod ply;

/// Vertices and triangles of a file that is not yet checked, or what is wrong with it.
type Soup = std::result::Result<(Vec<[f32; 3]>, Vec<[u32; 3]>), String>;

/// A triangle soup: finite positions, indices in range, and some surface.
///
/// Triangles without area (repeated or collinear vertices) are allowed and keep their number; they have no surface,
/// carry no samples and need no cover.
#[derive(Clone, Debug)]
pub struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    area: f64,
    bounds: ([f32; 3], [f32; 3]),
}

impl Mesh {
    /// Checks and takes a triangle soup. O(n).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `positions` with a coordinate that is not finite, for `indices` that name no
    /// vertex, for no triangle at all, and where the total area is zero; [`Error::TooLarge`] for 2^32 - 1 vertices or
    /// triangles and more.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        for (argument, count) in [("positions", positions.len()), ("indices", triangles.len())] {
            if count >= u32::MAX as usize {
                return Err(Error::too_large(argument, format!("{count} entries; the limit is {}", u32::MAX - 1)));
            }
        }
        if let Some(vertex) = positions.iter().position(|position| position.iter().any(|x| !x.is_finite())) {
            let [x, y, z] = positions[vertex];
            return Err(Error::invalid("positions", format!("vertex {vertex} is ({x}, {y}, {z}), not finite")));
        }
        for (number, triangle) in triangles.iter().enumerate() {
            if let Some(index) = triangle.iter().find(|&&index| index as usize >= positions.len()) {
                let count = positions.len();
                let reason = format!("triangle {number} names vertex {index}, but there are {count} vertices");
                return Err(Error::invalid("indices", reason));
            }
        }
        if triangles.is_empty() {
            return Err(Error::invalid("indices", "0 triangles; at least one is needed"));
        }

        let mut mesh = Self { positions, triangles, area: 0.0, bounds: ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]) };
        for triangle in 0..mesh.triangles.len() as u32 {
            mesh.area += mesh.triangle_area(triangle);
            for corner in mesh.corners(triangle) {
                for (axis, x) in corner.into_iter().enumerate() {
                    mesh.bounds.0[axis] = mesh.bounds.0[axis].min(x);
                    mesh.bounds.1[axis] = mesh.bounds.1[axis].max(x);
                }
            }
        }
        if mesh.area <= 0.0 {
            return Err(Error::invalid("indices", "the triangles have no area"));
        }
        Ok(mesh)
    }

    /// Reads an OBJ or PLY file: by the extension `.obj` or `.ply`, otherwise by what it begins with.
    ///
    /// Polygons are cut into fans, in the order of the faces; points, lines, materials, normals, texture coordinates
    /// and groups are ignored. Memory stays proportional to the size of the file, whatever its header claims.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read (or is not a regular file), [`Error::Format`] where it is broken or
    /// its contents are not what [`Mesh::new`] takes.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let io_error = |source| Error::Io { path: path.to_owned(), source };
        let kind = std::fs::metadata(path).map_err(io_error)?.file_type();
        if !kind.is_file() {
            let what = if kind.is_dir() { "is a directory" } else { "is not a regular file" };
            return Err(io_error(std::io::Error::other(what)));
        }
        let bytes = std::fs::read(path).map_err(io_error)?;

        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let soup = match extension.as_deref() {
            Some("obj") => obj::parse(&bytes),
            Some("ply") => ply::parse(&bytes),
            _ if bytes.starts_with(b"ply") => ply::parse(&bytes),
            _ => obj::parse(&bytes),
        };
        let format_error = |reason| Error::Format { path: path.to_owned(), reason };
        let (positions, triangles) = soup.map_err(format_error)?;
        Self::new(positions, triangles).map_err(|error| format_error(error.to_string()))
    }

    /// The vertices.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// The vertices of each triangle, counter-clockwise seen from the front.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The area of all triangles; greater than zero.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The lower and upper corner of the box around all triangles. Vertices that no triangle uses do not count.
    pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        self.bounds
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// Like the other queries of a triangle, where there is no triangle of this number.
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        let [a, b, c] = self.triangles[triangle as usize];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }

    /// The area of a triangle.
    pub fn triangle_area(&self, triangle: u32) -> f64 {
        self.cross(triangle).length() / 2.0
    }

    /// The unit normal of a triangle, counter-clockwise front; zero where it has no area.
    pub fn normal(&self, triangle: u32) -> [f32; 3] {
        self.cross(triangle).normalize_or_zero().as_vec3().to_array()
    }

    /// The point `(1 - u - v) * a + u * b + v * c` of a triangle, computed in `f64` and rounded once.
    pub fn point(&self, triangle: u32, [u, v]: [f32; 2]) -> [f32; 3] {
        self.point_exact(triangle, [u.into(), v.into()]).as_vec3().to_array()
    }

    /// [`Mesh::point`] before it is rounded.
    pub(crate) fn point_exact(&self, triangle: u32, [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.exact_corners(triangle);
        (1.0 - u - v) * a + u * b + v * c
    }

    /// The largest absolute coordinate of the triangles.
    pub(crate) fn largest_coordinate(&self) -> f32 {
        let (min, max) = self.bounds;
        min.into_iter().chain(max).fold(0.0, |largest, x| largest.max(x.abs()))
    }

    /// The cross product of two edges: twice the area, along the normal.
    fn cross(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.exact_corners(triangle);
        (b - a).cross(c - a)
    }

    /// The corners of a triangle in `f64`. (Spelt out, since `map` on arrays is a call for each.)
    #[inline]
    pub(crate) fn exact_corners(&self, triangle: u32) -> [DVec3; 3] {
        let [a, b, c] = self.corners(triangle);
        [exact(a), exact(b), exact(c)]
    }
}

/// A position in `f64`.
pub(crate) fn exact(position: [f32; 3]) -> DVec3 {
    let [x, y, z] = position;
    DVec3::new(x.into(), y.into(), z.into())
}

/// The largest float below a positive one.
pub(crate) fn next_below(x: f32) -> f32 {
    f32::from_bits(x.to_bits() - 1)
}

/// Barycentrics rounded to floats that name a point of the triangle: not negative, and their sum (in `f64`) not above 1.
pub(crate) fn round_barycentrics([u, v]: [f64; 2]) -> [f32; 2] {
    let [mut u, mut v] = [u, v].map(|x| x.clamp(0.0, 1.0) as f32);
    let (larger, smaller) = if u > v { (&mut u, v) } else { (&mut v, u) };
    if f64::from(*larger) + f64::from(smaller) > 1.0 {
        let rest = 1.0 - f64::from(smaller);
        *larger = rest as f32;
        if f64::from(*larger) > rest {
            *larger = next_below(*larger);
        }
    }
    [u, v]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn rounded_barycentrics_stay_on_the_triangle_and_move_by_a_rounding() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let edge = (0..1000).map(|_| rng.unit()).map(|u| [u, 1.0 - u]).collect::<Vec<_>>();
        for [u, v] in edge.into_iter().chain([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [1.0 / 3.0, 2.0 / 3.0]]) {
            let rounded = round_barycentrics([u, v]).map(f64::from);
            assert!(rounded[0] >= 0.0 && rounded[1] >= 0.0 && rounded[0] + rounded[1] <= 1.0);
            assert!((rounded[0] - u).abs() <= 6e-8 && (rounded[1] - v).abs() <= 6e-8, "{u} {v}");
        }
        assert_eq!(round_barycentrics([-1e-9, 1.0 + 1e-7]), [0.0, 1.0]);
        assert_eq!(round_barycentrics([0.7, 0.7]).map(|x| x as f64).iter().sum::<f64>(), 1.0);
    }
}
