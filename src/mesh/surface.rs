//! A checked triangle soup, and the points on it.

use std::any::Any;
use std::ops::Range;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::centred::Centred;
use crate::check;
use crate::error::{Error, Result};
use crate::kept::Kept;
use crate::points::Points;

/// A triangle soup: finite positions, indices in range, and some surface.
///
/// Triangles without area (repeated or collinear vertices) are allowed and keep their number; they have no surface,
/// carry no samples and need no cover. The same goes for triangles that a mask leaves out ([`Mesh::with_mask`]).
///
/// Immutable. A clone shares vertices, triangles, normals and mask.
///
/// Data that a call derives from a mesh, independent of the radius and the seed, are kept with it for the next call, on
/// any thread, and freed with the last clone. For any set of samples this is a summary of areas and edges, half a byte
/// per triangle, and one byte more from the second set of few samples or the first of many on (with a mask, 4 bytes
/// more for each that it keeps). For relaxation and triangulation ([`dcr::surface`](crate::dcr::surface)) it is the
/// table of shared edges, 12 bytes per triangle and 4 per vertex. For [`Psp::advance`](crate::psp::Psp::advance) by ray
/// packets it is Embree's scene, about 100 bytes per triangle, and its device (see
/// [`Scene::new`](crate::trace::Scene::new)). A mesh with other normals shares all that; one with another mask does not.
#[derive(Clone, Debug)]
pub struct Mesh {
    // Vectors as they come: an `Arc` of a slice would copy them.
    positions: Arc<Vec<[f32; 3]>>,
    triangles: Arc<Vec<[u32; 3]>>,
    normals: Option<Arc<Normals>>,
    /// The triangles that count; all of them without a mask.
    mask: Option<Arc<Vec<bool>>>,
    area: f64,
    bounds: ([f32; 3], [f32; 3]),
    /// See [`Mesh::origin`].
    origin: [f64; 3],
    /// The data that depend on triangles and mask.
    kept: Arc<Kept>,
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
        check::finite("positions", "vertex", &positions)?;
        check::corners("indices", "vertex", "vertices", &triangles, positions.len())?;
        if triangles.is_empty() {
            return Err(Error::invalid("indices", "0 triangles; at least one is needed"));
        }
        let (positions, triangles) = (Arc::new(positions), Arc::new(triangles));
        let (area, bounds, origin, kept) = Default::default();
        let mesh = Self { positions, triangles, normals: None, mask: None, area, bounds, origin, kept };
        let mesh = mesh.measured();
        if mesh.area <= 0.0 {
            return Err(Error::invalid("indices", "the triangles have no area"));
        }
        Ok(mesh)
    }

    /// [`Mesh::new`] for positions in doubles, which are moved to an [origin](Mesh::origin) where floats would displace
    /// them by more than a millionth of the mesh's size ([`Centred`]). O(n).
    ///
    /// # Errors
    /// Those of [`Mesh::new`].
    pub fn from_doubles(positions: &[[f64; 3]], triangles: Vec<[u32; 3]>) -> Result<Self> {
        let Centred { positions, origin, .. } = Centred::of(positions);
        Ok(Self::new(positions, triangles)?.with_origin(origin))
    }

    /// The mesh with an origin: the place in the caller's frame that its positions are relative to. Nothing is moved, and
    /// no result depends on it.
    pub fn with_origin(mut self, origin: [f64; 3]) -> Self {
        self.origin = origin;
        self
    }

    /// The mesh with normals of the caller's, in place of its own: of any length, one for each vertex,
    /// or named by `indices`, three for each triangle, where corners that share a vertex differ in their normals. O(n).
    ///
    /// A zero vector stands for a corner without a normal; see [`Mesh::interpolated_normal`]. Sampling does not depend
    /// on normals.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `normals` that are not finite, or are not one for each vertex where there are no
    /// indices; for `normal_indices` that are not three for each triangle, or name no normal. [`Error::TooLarge`] for
    /// 2^32 - 1 `normals` and more.
    pub fn with_normals(mut self, normals: Vec<[f32; 3]>, indices: Option<Vec<[u32; 3]>>) -> Result<Self> {
        self.normals = Some(Arc::new(Normals::new(self.positions.len(), self.triangles.len(), normals, indices)?));
        Ok(self)
    }

    /// The mesh with its vertices moved: triangles, mask and origin stay, normals go. O(n).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `positions` that are of another number than the vertices, or not finite, and
    /// where the total area is zero.
    pub fn deformed(&self, positions: Vec<[f32; 3]>) -> Result<Self> {
        let vertices = self.positions.len();
        if positions.len() != vertices {
            let reason = format!("{} for a mesh of {vertices} vertices", positions.len());
            return Err(Error::invalid("positions", reason));
        }
        check::finite("positions", "vertex", &positions)?;
        let mesh = self.moved(positions);
        if mesh.area <= 0.0 && self.area > 0.0 {
            return Err(Error::invalid("positions", "the triangles have no area"));
        }
        Ok(mesh)
    }

    /// [`Mesh::deformed`] for finite positions, as many as vertices: it may have no area.
    pub(crate) fn moved(&self, positions: Vec<[f32; 3]>) -> Self {
        let (triangles, mask) = (self.triangles.clone(), self.mask.clone());
        let (area, bounds, kept) = Default::default();
        let (positions, origin) = (Arc::new(positions), self.origin);
        Self { positions, triangles, normals: None, mask, area, bounds, origin, kept }.measured()
    }

    /// The mesh with a mask, in place of the one that it may have: triangles whose entry is false are left out. They
    /// keep their number. O(n).
    ///
    /// The rest is sampled as if they were not there, to the bit: they get no samples, add nothing to area and bounds,
    /// and need not be covered; nor do they hide or divide anything. So samples on both sides of a masked part keep
    /// their distance through space. A mask may leave out everything: then a maximal set is empty.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `mask` that does not have one entry for each triangle.
    pub fn with_mask(mut self, mask: Vec<bool>) -> Result<Self> {
        if mask.len() != self.triangles.len() {
            let reason = format!("{} entries, but there are {} triangles", mask.len(), self.triangles.len());
            return Err(Error::invalid("mask", reason));
        }
        self.mask = Some(Arc::new(mask));
        self.kept = Arc::default();
        Ok(self.measured())
    }

    /// The mesh with its area and bounds.
    fn measured(mut self) -> Self {
        (self.area, self.bounds) = self.measure(self.sampled_triangles());
        if self.area == 0.0 {
            // A box that is not a point has to be there even where nothing is to be sampled.
            self.bounds = self.measure(0..self.triangles.len() as u32).1;
        }
        self
    }

    /// The area of triangles, and the corners of the box around them.
    fn measure(&self, triangles: impl Iterator<Item = u32>) -> (f64, ([f32; 3], [f32; 3])) {
        let (mut area, mut low, mut high) = (0.0, Vec3::INFINITY, Vec3::NEG_INFINITY);
        for triangle in triangles {
            area += self.cross(triangle).length() / 2.0;
            let [a, b, c] = self.corners(triangle).map(Vec3::from_array);
            low = low.min(a).min(b.min(c));
            high = high.max(a).max(b.max(c));
        }
        (area, (low.to_array(), high.to_array()))
    }

    /// The vertices.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// The place in the frame of a file, or of doubles that a mesh was made from, that positions are relative to: those
    /// of vertices, and of samples of the mesh. Zero unless these lie so far from the origin that floats would displace
    /// them.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
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
    #[inline]
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        let [a, b, c] = self.triangles[triangle as usize];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }

    /// True if a triangle is to be sampled: there is no mask, or it does not leave the triangle out.
    pub fn is_sampled(&self, triangle: u32) -> bool {
        self.mask.as_ref().is_none_or(|mask| mask[triangle as usize])
    }

    /// True if there is a mask.
    pub(crate) fn is_masked(&self) -> bool {
        self.mask.is_some()
    }

    /// The numbers of the triangles that are to be sampled, in order.
    pub(crate) fn sampled_triangles(&self) -> impl Iterator<Item = u32> + Clone {
        (0..self.triangles.len() as u32).filter(|&triangle| self.is_sampled(triangle))
    }

    /// The triangles of a range that are to be sampled and have an area, with it: all that samples can lie on.
    pub(crate) fn triangles_with_area(&self, range: Range<usize>) -> impl Iterator<Item = (u32, f64)> {
        let measured = range.map(|triangle| (triangle as u32, self.triangle_area(triangle as u32)));
        measured.filter(|&(_, area)| area > 0.0)
    }

    /// The area of a triangle that is to be sampled; zero for one that the mask leaves out.
    pub fn triangle_area(&self, triangle: u32) -> f64 {
        if self.is_sampled(triangle) { self.cross(triangle).length() / 2.0 } else { 0.0 }
    }

    /// The unit normal of a triangle, counter-clockwise front; zero where it has no area.
    pub fn normal(&self, triangle: u32) -> [f32; 3] {
        self.cross(triangle).normalize_or_zero().as_vec3().to_array()
    }

    /// True if the mesh carries normals besides those of its triangles: given by the caller, or read from its file.
    pub fn has_normals(&self) -> bool {
        self.normals.is_some()
    }

    /// The normals that the mesh carries, of its vertices or as [`Mesh::normal_indices`] says; empty if it carries none.
    pub fn normals(&self) -> &[[f32; 3]] {
        self.normals.as_ref().map_or(&[], |normals| &normals.vectors)
    }

    /// The numbers of the normals of each triangle's corners; `None` if it carries none, or those of its vertices.
    pub fn normal_indices(&self) -> Option<&[[u32; 3]]> {
        self.normals.as_ref()?.indices.as_deref()
    }

    /// The entries of the mask, one for each triangle; `None` without one.
    pub fn mask(&self) -> Option<&[bool]> {
        self.mask.as_ref().map(|mask| mask.as_slice())
    }

    /// The mesh's normals at the corners of a triangle, interpolated to the point `(u, v)` of it in `f64` and
    /// normalised; `None` if the mesh carries none. Where they cancel, as zero and opposite normals do (less than a
    /// millionth of the longest of the three), it is the normal of the triangle.
    pub fn interpolated_normal(&self, triangle: u32, uv: [f32; 2]) -> Option<[f32; 3]> {
        let normals = self.normals.as_ref()?;
        let interpolated =
            normals.interpolated(&self.triangles, triangle, uv).map(|normal| normal.as_vec3().to_array());
        Some(interpolated.unwrap_or_else(|| self.normal(triangle)))
    }

    /// The point `(1 - u - v) * a + u * b + v * c` of a triangle, computed in `f64` and rounded once.
    pub fn point(&self, triangle: u32, [u, v]: [f32; 2]) -> [f32; 3] {
        self.point_exact(triangle, [u.into(), v.into()]).as_vec3().to_array()
    }

    /// Samples at places of the caller's, evaluated with the rounding of every sampler: on the mesh that they were made
    /// on the same floats come back, on a [deformed](Mesh::deformed) one each sample goes with its triangle. O(n).
    ///
    /// Triangles may have no area, or be left out by a mask.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `triangles` that do not exist, and for `barycentrics` that are of another number,
    /// not finite, or outside of the triangle by more than a millionth.
    pub fn samples_at(&self, triangles: &[u32], barycentrics: &[[f32; 2]]) -> Result<Points<3>> {
        if barycentrics.len() != triangles.len() {
            let reason = format!("there are {}, and {} triangles", barycentrics.len(), triangles.len());
            return Err(Error::invalid("barycentrics", reason));
        }
        check::triangles(triangles, self.triangles.len())?;
        check::finite("barycentrics", "sample", barycentrics)?;
        check::barycentrics(barycentrics)?;
        Ok(self.samples(triangles.to_vec(), barycentrics.to_vec()))
    }

    /// The samples at these places, with their positions and normals.
    pub(crate) fn samples(&self, triangles: Vec<u32>, barycentrics: Vec<[f32; 2]>) -> Points<3> {
        let places = || triangles.iter().zip(&barycentrics).map(|(&triangle, &uv)| (triangle, uv));
        Points {
            positions: places().map(|(triangle, uv)| self.point(triangle, uv)).collect(),
            normals: triangles.iter().map(|&triangle| self.normal(triangle)).collect(),
            // None if the mesh carries no normals.
            interpolated_normals: places()
                .filter_map(|(triangle, uv)| self.interpolated_normal(triangle, uv))
                .collect(),
            triangles,
            barycentrics,
            ..Points::default()
        }
    }

    /// [`Mesh::point`] before it is rounded.
    pub(crate) fn point_exact(&self, triangle: u32, barycentrics: [f64; 2]) -> DVec3 {
        exact_point(&self.corners(triangle), barycentrics)
    }

    /// The value that `make` derives from the triangles that are to be sampled, and from nothing else: made by the
    /// first call for its type, kept for the next ones, shared with clones. A call that has to wait for another thread,
    /// which is making it, asks `wait` now and then whether to go on.
    ///
    /// # Errors
    /// Those of `make`, after which nothing is kept, and of `wait`.
    pub(crate) fn kept<T: Any + Send + Sync>(
        &self,
        wait: impl FnMut() -> Result<()>,
        make: impl FnOnce() -> Result<T>,
    ) -> Result<Arc<T>> {
        self.kept.get(wait, make)
    }

    /// The largest absolute coordinate of the triangles.
    pub(crate) fn largest_coordinate(&self) -> f32 {
        let (min, max) = self.bounds;
        min.into_iter().chain(max).fold(0.0, |largest, x| largest.max(x.abs()))
    }

    /// The spacing of floats at the largest coordinate.
    pub(crate) fn float_spacing(&self) -> f64 {
        let largest = self.largest_coordinate();
        f64::from(largest) - f64::from(largest.next_down())
    }

    /// The cross product of two edges: twice the area, along the normal.
    #[inline]
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

/// Interpolated normals shorter than this share of the longest normal have no direction: it would be that of roundings.
const SHORTEST: f64 = 1e-6;

/// Normals at the corners of all triangles.
#[derive(Debug)]
pub(super) struct Normals {
    vectors: Vec<[f32; 3]>,
    /// The normals of each triangle's corners; `None`: those of its vertices.
    indices: Option<Vec<[u32; 3]>>,
}

impl Normals {
    /// Checks and takes normals for a mesh with these numbers of vertices and triangles.
    pub fn new(
        vertices: usize,
        triangles: usize,
        vectors: Vec<[f32; 3]>,
        indices: Option<Vec<[u32; 3]>>,
    ) -> Result<Self> {
        let count = vectors.len();
        if count >= u32::MAX as usize {
            return Err(Error::too_large("normals", format!("{count} entries; the limit is {}", u32::MAX - 1)));
        }
        check::finite("normals", "normal", &vectors)?;
        match &indices {
            None if count != vertices => {
                let reason = format!("{count} of them without indices, but there are {vertices} vertices");
                return Err(Error::invalid("normals", reason));
            }
            None => {}
            Some(indices) if indices.len() != triangles => {
                let reason = format!("{} entries, but there are {} triangles", indices.len(), triangles);
                return Err(Error::invalid("normal_indices", reason));
            }
            Some(indices) => check::corners("normal_indices", "normal", "normals", indices, count)?,
        }
        Ok(Self { vectors, indices })
    }

    /// The unit normal at a point of one of the mesh's triangles, if it has a direction.
    pub fn interpolated(&self, triangles: &[[u32; 3]], triangle: u32, uv: [f32; 2]) -> Option<DVec3> {
        let corners = self.indices.as_deref().unwrap_or(triangles)[triangle as usize];
        let [a, b, c] = corners.map(|corner| exact(self.vectors[corner as usize]));
        let [u, v] = uv.map(f64::from);
        let sum = (1.0 - u - v) * a + u * b + v * c;
        let longest = a.length().max(b.length()).max(c.length());
        (sum.length() > SHORTEST * longest).then(|| sum.normalize())
    }
}

/// A position in `f64`.
pub(crate) fn exact(position: [f32; 3]) -> DVec3 {
    let [x, y, z] = position;
    DVec3::new(x.into(), y.into(), z.into())
}

/// A point of a triangle, before it is rounded.
pub(crate) fn exact_point(corners: &[[f32; 3]; 3], [u, v]: [f64; 2]) -> DVec3 {
    let [a, b, c] = corners;
    (1.0 - u - v) * exact(*a) + u * exact(*b) + v * exact(*c)
}

/// Barycentrics rounded to floats that name a point of the triangle: not negative, with a sum (in `f64`) of at most 1.
pub(crate) fn round_barycentrics([u, v]: [f64; 2]) -> [f32; 2] {
    let [mut u, mut v] = [u, v].map(|x| x.clamp(0.0, 1.0) as f32);
    let (larger, smaller) = if u > v { (&mut u, v) } else { (&mut v, u) };
    if f64::from(*larger) + f64::from(smaller) > 1.0 {
        let rest = 1.0 - f64::from(smaller);
        *larger = rest as f32;
        if f64::from(*larger) > rest {
            *larger = larger.next_down();
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
