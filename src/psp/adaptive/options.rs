//! The options of sets whose radius varies: the radius, or the density that it follows from, and the rest.

use crate::given::Given;
use crate::order::{DEFAULT_QUOTIENT, Order};
use crate::setters::setters;

/// The options of [`sample`](super::sample).
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The radius on the surface. Radii larger than four times the diagonal of the mesh's box are reduced to that,
    /// those of vertices before they are interpolated.
    pub radius: Radius<'a>,
    /// Samples on triangles whose normals have a smaller cosine ignore each other, and so do samples and uncovered
    /// surface: the sides of a thin wall are sampled as if they were far apart. From -1, which is off, to 1, where only
    /// samples with the same normal interact. The triangles must be wound consistently.
    pub cosine: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Existing samples, each with its clearance: there is no radius that could replace it. They act on all sides of a
    /// thin wall.
    pub given: Given<'a, 3>,
    /// The order of the samples; by default any.
    pub order: Order,
    /// In progressive order, the largest ratio of the covering radius of the first samples to their rank: see
    /// [`psp::Options::quotient`](crate::psp::Options::quotient).
    pub quotient: f64,
}

impl<'a> Options<'a> {
    /// No sample ignores others; any order.
    pub fn new(radius: Radius<'a>) -> Self {
        let given = Given::default();
        Self { radius, cosine: -1.0, seed: 0, given, order: Order::Any, quotient: DEFAULT_QUOTIENT }
    }
}

setters!(Options<'a> { cosine: f64, seed: u64, given: Given<'a, 3>, order: Order, quotient: f64 });

/// A radius for every place of space; called from several threads at once, unless the context has only one.
pub type RadiusFunction<'a> = dyn Fn([f64; 3]) -> f64 + Sync + 'a;

/// A density for every place of space, finite and 0 or above; called like a [`RadiusFunction`].
pub type DensityFunction<'a> = dyn Fn([f64; 3]) -> f64 + Sync + 'a;

/// The radius as it varies over the surface.
#[derive(Clone, Copy)]
pub enum Radius<'a> {
    /// A radius for each vertex of the mesh, positive and finite, interpolated on the triangles: at the barycentrics
    /// `(u, v)` of a sample it is `(1 - u - v) * a + u * b + v * c` in `f64`. It may be arbitrarily steep.
    PerVertex(&'a [f32]),
    /// A radius for each position.
    Function {
        /// Gives the radius at a position; for a sample, at the floats that are returned.
        at: &'a RadiusFunction<'a>,
        /// The least radius that it gives.
        smallest: f64,
        /// The largest radius that it gives.
        largest: f64,
        /// The largest change of the radius per unit of distance between two positions on a triangle: 0 or above.
        /// Coverage is proved with it, so it must hold; if a violation is found, the call fails. The work grows with
        /// its square from about 1 on; from about 30 on it may be too much, which is refused. At most `smallest` / 24
        /// per float spacing at the largest coordinate of the mesh.
        slope: f64,
    },
    /// The radius that gives each place a density of samples.
    Density {
        /// The density, in any unit.
        density: Density<'a>,
        /// The meaning of a density of 1.
        scale: Scale,
    },
}

/// The density of samples as it varies over the surface, per unit of area. Densities are finite, 0 or above, and not 0
/// everywhere. Where they are 0 there are no samples, which does not reduce the number beside such places.
#[derive(Clone, Copy)]
pub enum Density<'a> {
    /// A density for each vertex of the mesh, interpolated on the triangles.
    PerVertex(&'a [f32]),
    /// The density at each vertex of the mesh, interpolated on the triangles: the function is called once for each
    /// vertex, in their order, before any work. No bounds of it are required, and its values between vertices do not
    /// matter.
    AtVertices(&'a DensityFunction<'a>),
    /// A density for each position.
    Function {
        /// Gives the density at a position.
        at: &'a DensityFunction<'a>,
        /// The largest density that it gives, above 0.
        largest: f64,
        /// The largest change of the density per unit of distance between two positions on a triangle: 0 or above.
        /// Coverage is proved with it, so it must hold; if a violation is found, the call fails. Where the density is
        /// 0, or nearly so, over many times the radius beside it, that takes very many calls, which is refused: use
        /// [`Density::AtVertices`] there.
        slope: f64,
    },
    /// An image that is mapped onto the mesh by texture coordinates, linear between the centres of its pixels, and
    /// repeated.
    Image {
        /// The pixels, row by row; the first row lies along v = 0.
        values: &'a [f32],
        /// Pixels in a row, over which u goes from 0 to 1; at least 1.
        width: usize,
        /// Rows; at least 1.
        height: usize,
        /// The positions of the vertices in the image.
        texture: Texture<'a>,
    },
}

/// Texture coordinates u, v: finite, at most 1e6 in absolute value.
#[derive(Clone, Copy)]
pub enum Texture<'a> {
    /// For each vertex of the mesh.
    PerVertex(&'a [[f32; 2]]),
    /// For each corner of each triangle: they differ along seams.
    PerCorner(&'a [[[f32; 2]; 3]]),
}

/// The meaning of a density of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The radius at density 1: a maximal set of that radius has this density. The radius at a density d is this over
    /// the square root of d.
    Radius(f64),
    /// The approximate number of samples of the whole set; above 0. The radius follows from the integral of the
    /// density, for a flat surface: where parts of it are nearer to each other than the radius, there are fewer. In
    /// progressive order the number is exact, and must be whole.
    Count(f64),
}
