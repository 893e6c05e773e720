//! A checked triangle soup, and the points on it.
//!
//! Nothing is asked of the topology: open, non-manifold, self-intersecting, duplicated and oppositely wound faces are
//! all welcome. What is asked is checked once, here, so that no later stage meets a bad number or index.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::points::SurfaceSamples;

mod normals;
mod obj;
mod ply;
mod stl;
mod text;

use normals::Normals;

/// What a file holds, not yet checked.
#[derive(Default)]
struct Soup {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Normals, as [`Mesh::with_normals`] takes them, except that they need not be finite; none at all if it is empty.
    normals: Vec<[f32; 3]>,
    normal_indices: Option<Vec<[u32; 3]>>,
}

impl Soup {
    fn into_mesh(mut self) -> Result<Mesh> {
        let mesh = Mesh::new(self.positions, self.triangles)?;
        if self.normals.is_empty() {
            return Ok(mesh);
        }
        for normal in &mut self.normals {
            if normal.iter().any(|x| !x.is_finite()) {
                *normal = [0.0; 3];
            }
        }
        mesh.with_normals(self.normals, self.normal_indices)
    }
}

/// A triangle soup: finite positions, indices in range, and some surface.
///
/// Triangles without area (repeated or collinear vertices) are allowed and keep their number; they have no surface,
/// carry no samples and need no cover. The same goes for triangles that a mask leaves out ([`Mesh::with_mask`]).
///
/// Immutable. A clone shares vertices, triangles, normals and mask.
#[derive(Clone, Debug)]
pub struct Mesh {
    positions: Arc<[[f32; 3]]>,
    triangles: Arc<[[u32; 3]]>,
    normals: Option<Arc<Normals>>,
    /// Which triangles count; all of them without a mask.
    mask: Option<Arc<[bool]>>,
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
        check_finite("positions", "vertex", &positions)?;
        check_indices("indices", "vertex", "vertices", &triangles, positions.len())?;
        if triangles.is_empty() {
            return Err(Error::invalid("indices", "0 triangles; at least one is needed"));
        }
        let (positions, triangles) = (positions.into(), triangles.into());
        let mesh = Self { positions, triangles, normals: None, mask: None, area: 0.0, bounds: Default::default() };
        let mesh = mesh.measured();
        if mesh.area <= 0.0 {
            return Err(Error::invalid("indices", "the triangles have no area"));
        }
        Ok(mesh)
    }

    /// The mesh with normals of the caller's, in place of those that it may carry: of any length, one for each vertex, or
    /// named by `indices`, three for each triangle, where corners that share a vertex differ in their normals. O(n).
    ///
    /// A zero vector stands for a corner without a normal; see [`Mesh::interpolated_normal`]. Sampling does not depend on
    /// normals.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `normals` that are not finite, or are not one for each vertex where there are no
    /// indices; for `normal_indices` that are not three for each triangle, or name no normal. [`Error::TooLarge`] for
    /// 2^32 - 1 `normals` and more.
    pub fn with_normals(mut self, normals: Vec<[f32; 3]>, indices: Option<Vec<[u32; 3]>>) -> Result<Self> {
        self.normals = Some(Arc::new(Normals::new(&self, normals, indices)?));
        Ok(self)
    }

    /// The mesh with a mask, in place of the one that it may have: triangles whose entry is false are left out. They keep
    /// their number. O(n).
    ///
    /// The rest is sampled as if they were not there, to the bit: they get no samples, add nothing to area and bounds,
    /// and need not be covered; nor do they hide or divide anything. So samples on both sides of a masked part keep their
    /// distance through space. A mask may leave out everything: then a maximal set is empty.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `mask` that does not have one entry for each triangle.
    pub fn with_mask(mut self, mask: Vec<bool>) -> Result<Self> {
        if mask.len() != self.triangles.len() {
            let reason = format!("{} entries, but there are {} triangles", mask.len(), self.triangles.len());
            return Err(Error::invalid("mask", reason));
        }
        self.mask = Some(mask.into());
        Ok(self.measured())
    }

    /// The mesh with its area and bounds.
    fn measured(mut self) -> Self {
        let all = 0..self.triangles.len() as u32;
        self.area = all.clone().map(|triangle| self.triangle_area(triangle)).sum();
        // A box that is not a point has to be there even where nothing is to be sampled.
        let counts = |triangle: &u32| self.area == 0.0 || self.is_sampled(*triangle);
        let mut bounds = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for corner in all.filter(counts).flat_map(|triangle| self.corners(triangle)) {
            for (axis, x) in corner.into_iter().enumerate() {
                bounds.0[axis] = bounds.0[axis].min(x);
                bounds.1[axis] = bounds.1[axis].max(x);
            }
        }
        self.bounds = bounds;
        self
    }

    /// Reads an OBJ, PLY or STL file: by the extension `.obj`, `.ply` or `.stl`, otherwise by what it begins with.
    ///
    /// Polygons are cut into fans, in the order of the faces. Normals of corners (OBJ `vn`) and vertices (PLY `nx ny nz`)
    /// are read; where a file has some, a corner without, or with one that is not finite, has the normal zero. Points,
    /// lines, materials, texture coordinates, colours and groups are ignored, as are the normals of STL facets, and STL
    /// vertices are not merged. Memory stays proportional to the size of the file, whatever its header claims.
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
            Some("stl") => stl::parse(&bytes),
            _ if bytes.starts_with(b"ply") => ply::parse(&bytes),
            _ if stl::is_likely(&bytes) => stl::parse(&bytes),
            _ => obj::parse(&bytes),
        };
        let format_error = |reason| Error::Format { path: path.to_owned(), reason };
        soup.map_err(format_error)?.into_mesh().map_err(|error| format_error(error.to_string()))
    }

    /// The vertices.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// The vertices of each triangle, counter-clockwise seen from the front.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The area of all triangles that the mask does not leave out. Zero only if it leaves nothing that has area.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The lower and upper corner of the box around all triangles that the mask does not leave out; around all of them
    /// if these have no area. Vertices that no triangle uses do not count.
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

    /// Whether a triangle is to be sampled: whether there is no mask, or it does not leave the triangle out.
    pub fn is_sampled(&self, triangle: u32) -> bool {
        self.mask.as_ref().is_none_or(|mask| mask[triangle as usize])
    }

    /// The numbers of the triangles that are to be sampled, in order.
    pub(crate) fn sampled_triangles(&self) -> impl Iterator<Item = u32> {
        (0..self.triangles.len() as u32).filter(|&triangle| self.is_sampled(triangle))
    }

    /// The area of a triangle that is to be sampled; zero for one that the mask leaves out.
    pub fn triangle_area(&self, triangle: u32) -> f64 {
        if self.is_sampled(triangle) { self.cross(triangle).length() / 2.0 } else { 0.0 }
    }

    /// The unit normal of a triangle, counter-clockwise front; zero where it has no area.
    pub fn normal(&self, triangle: u32) -> [f32; 3] {
        self.cross(triangle).normalize_or_zero().as_vec3().to_array()
    }

    /// Whether the mesh carries normals besides those of its triangles: given by the caller, or read from its file.
    pub fn has_normals(&self) -> bool {
        self.normals.is_some()
    }

    /// The mesh's normals at the corners of a triangle, interpolated to the point `(u, v)` of it in `f64` and normalised;
    /// `None` if the mesh carries none. Where they add up to nothing, as zero and opposite normals do (less than a
    /// millionth of the longest of the three), it is the normal of the triangle.
    pub fn interpolated_normal(&self, triangle: u32, uv: [f32; 2]) -> Option<[f32; 3]> {
        let normals = self.normals.as_ref()?;
        let interpolated = normals.interpolated(self, triangle, uv).map(|normal| normal.as_vec3().to_array());
        Some(interpolated.unwrap_or_else(|| self.normal(triangle)))
    }

    /// The point `(1 - u - v) * a + u * b + v * c` of a triangle, computed in `f64` and rounded once.
    pub fn point(&self, triangle: u32, [u, v]: [f32; 2]) -> [f32; 3] {
        self.point_exact(triangle, [u.into(), v.into()]).as_vec3().to_array()
    }

    /// The samples at these places, with their positions and normals.
    pub(crate) fn samples(&self, triangles: Vec<u32>, barycentrics: Vec<[f32; 2]>) -> SurfaceSamples {
        let places = || triangles.iter().zip(&barycentrics).map(|(&triangle, &uv)| (triangle, uv));
        SurfaceSamples {
            positions: places().map(|(triangle, uv)| self.point(triangle, uv)).collect(),
            normals: triangles.iter().map(|&triangle| self.normal(triangle)).collect(),
            // None if the mesh carries no normals.
            interpolated_normals: places()
                .filter_map(|(triangle, uv)| self.interpolated_normal(triangle, uv))
                .collect(),
            triangles,
            barycentrics,
        }
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

/// Refuses vectors that are not finite. `item` is what one of them belongs to.
fn check_finite(argument: &'static str, item: &str, vectors: &[[f32; 3]]) -> Result<()> {
    match vectors.iter().position(|vector| vector.iter().any(|x| !x.is_finite())) {
        None => Ok(()),
        Some(index) => {
            let [x, y, z] = vectors[index];
            Err(Error::invalid(argument, format!("{item} {index} is ({x}, {y}, {z}), not finite")))
        }
    }
}

/// Refuses triangles that name what is not there.
fn check_indices(argument: &'static str, item: &str, items: &str, triangles: &[[u32; 3]], count: usize) -> Result<()> {
    for (number, triangle) in triangles.iter().enumerate() {
        if let Some(index) = triangle.iter().find(|&&index| index as usize >= count) {
            let reason = format!("triangle {number} names {item} {index}, but there are {count} {items}");
            return Err(Error::invalid(argument, reason));
        }
    }
    Ok(())
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
