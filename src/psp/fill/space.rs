//! Space as the fill represents it, in floats: lengths in a unit near the radius, and cells of two radii.
//!
//! The unit is a power of two. So coordinates are exact in it, and neither the square of a distance nor its terms leave
//! the range of `f32`, for any size of the mesh. Differences of two positions then have rounding errors of their own
//! size only, wherever the mesh lies.

use glam::DVec3;

use crate::mesh::{Mesh, exact};

/// The share of the squared radius that rounding can add to a squared distance, and some more: places are off by a few
/// roundings of lengths up to a few radii, which is 1.6e-6.
const SLACK: f64 = 1e-5;

/// A float whose sums with numbers up to 2^22 are integers.
pub const ROUNDER: f32 = (1 << 23) as f32;
/// The bits of the cell's number along an axis.
pub const MASK: u32 = (1 << 21) - 1;

/// A place in the unit of a [`Space`].
pub type Place = [f32; 3];

/// The unit, the cells, and the radius in both.
#[derive(Clone, Copy, Debug)]
pub struct Space {
    /// The factor, a power of two, from coordinates of the mesh to places.
    scale: f32,
    /// The radius in the unit.
    radius: f64,
    /// Squared distances up to here are certainly below the squared radius, and those above there certainly not.
    pub surely_within: f32,
    pub surely_beyond: f32,
    /// The origin of the cells.
    pub origin: Place,
    pub per_cell: f32,
}

impl Space {
    /// The space around a mesh. A radius far larger than the mesh's diagonal is replaced by four diagonals.
    pub fn new(mesh: &Mesh, radius: f64) -> Self {
        let (low, high) = mesh.bounds();
        let radius = radius.min(4.0 * exact(low).distance(exact(high)));
        let exponent = (radius.to_bits() >> 52) as i32 - 1023;
        let scale = f32::from_bits(((127 - exponent).clamp(1, 254) as u32) << 23);
        let radius = radius * f64::from(scale);
        let (square, low) = (radius * radius, exact(low) * f64::from(scale));
        Self {
            scale,
            radius,
            surely_within: Self::within(square),
            surely_beyond: Self::beyond(square),
            origin: (low - 2.0 * radius).as_vec3().to_array(),
            per_cell: (0.5 / radius) as f32,
        }
    }

    /// The radius in the unit of places.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The factor from coordinates of the mesh to places.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    /// The place of a position: exact.
    #[inline(always)]
    pub fn place(&self, position: [f32; 3]) -> Place {
        [position[0] * self.scale, position[1] * self.scale, position[2] * self.scale]
    }

    /// The places of the corners of a triangle. (Written out, since `map` on arrays makes a call for each.)
    #[inline(always)]
    pub fn places(&self, [a, b, c]: [[f32; 3]; 3]) -> [Place; 3] {
        [self.place(a), self.place(b), self.place(c)]
    }

    /// Any point, in the unit of places.
    #[inline(always)]
    pub fn scaled(&self, point: DVec3) -> DVec3 {
        point * f64::from(self.scale)
    }

    /// A limit in floats for squared distances: all that do not exceed it are within the root of `square`.
    pub fn within(square: f64) -> f32 {
        (square * (1.0 - SLACK)) as f32
    }

    /// A limit in floats for squared distances: none that exceeds it is within the root of `square`.
    pub fn beyond(square: f64) -> f32 {
        (square * (1.0 + SLACK)) as f32
    }

    /// True if two places are closer than the radius: in `f64`, without tolerance.
    #[inline]
    pub fn conflict(&self, a: Place, b: Place) -> bool {
        exact(a).distance_squared(exact(b)) < self.radius * self.radius
    }

    /// The cell of a place that is no farther from the mesh than two radii.
    ///
    /// Computed by rounding, since a sum with 2^23 has the integer in its last bits: a conversion is slower.
    #[inline(always)]
    pub fn cell(&self, [x, y, z]: Place) -> [u32; 3] {
        let along = |x: f32, axis: usize| ((x - self.origin[axis]) * self.per_cell + ROUNDER).to_bits() & MASK;
        [along(x, 0), along(y, 1), along(z, 2)]
    }

    /// The lowest and the highest cell that the ball around a place touches.
    #[inline]
    pub fn cells_around(&self, place: Place) -> [[u32; 3]; 2] {
        self.cells_within(place, self.radius)
    }

    /// The lowest and the highest cell of a ball of another radius, up to twice that of the space.
    ///
    /// Rounding is monotone. So the cells of all floats in the ball, and of all its points once they are rounded, lie
    /// between these two.
    #[inline]
    pub fn cells_within(&self, place: Place, reach: f64) -> [[u32; 3]; 2] {
        let reach = (reach * (1.0 + SLACK)) as f32;
        [self.cell(place.map(|x| x - reach)), self.cell(place.map(|x| x + reach))]
    }
}

/// The shifts of the second and the third axis in a [`key`].
pub const KEY: [u32; 2] = [21, 42];

/// A cell as a key: 21 bits for each axis. A radius has at least 64 float spacings, which makes less than 2^20 cells in
/// a row.
#[inline(always)]
pub fn key([x, y, z]: [u32; 3]) -> u64 {
    u64::from(x) | u64::from(y) << KEY[0] | u64::from(z) << KEY[1]
}
