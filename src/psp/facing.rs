//! The normal cone: samples on triangles that face different ways, such as the sides of a thin wall, ignore each other.

use crate::error::{Error, Result};
use crate::mesh::{Mesh, exact};

/// The normal of all samples where normals do not matter.
pub(super) const NO_NORMAL: [f32; 3] = [0.0; 3];

/// Samples on triangles whose normals have a smaller cosine ignore each other, unless the normals are the same; with
/// -1, none do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Facing(f64);

impl Facing {
    /// No sample ignores others.
    pub const ANY: Self = Self(-1.0);

    /// Refuses a value that is not a cosine.
    pub fn new(cosine: f64) -> Result<Self> {
        if (-1.0..=1.0).contains(&cosine) {
            Ok(Self(cosine))
        } else {
            Err(Error::invalid("cosine", format!("{cosine:?} is not in -1..=1")))
        }
    }

    /// True if normals matter at all.
    #[inline(always)]
    pub fn asks_normals(self) -> bool {
        self.0 > -1.0
    }

    /// The normal of a triangle, where normals matter.
    #[inline(always)]
    pub fn normal(self, mesh: &Mesh, triangle: u32) -> [f32; 3] {
        if self.asks_normals() { mesh.normal(triangle) } else { NO_NORMAL }
    }

    /// True if two samples with these normals matter to each other. Those of one triangle always do: the square of a
    /// rounded normal can be below a cosine of 1, and such a triangle would be sampled without end.
    pub fn sees(self, a: [f32; 3], b: [f32; 3]) -> bool {
        !self.asks_normals() || a == b || exact(a).dot(exact(b)) >= self.0
    }
}
