//! How a caller says what the radius is.

/// A radius for every place of space; called from several threads at once, unless the context has only one.
pub type RadiusFunction<'a> = dyn Fn([f64; 3]) -> f64 + Sync + 'a;

/// How far samples are apart from place to place.
#[derive(Clone, Copy)]
pub enum Radius<'a> {
    /// A radius for each vertex of the mesh, positive and finite, interpolated on the triangles: at the barycentrics
    /// `(u, v)` of a sample it is `(1 - u - v) * a + u * b + v * c` in `f64`. It may change as steeply as it likes.
    PerVertex(&'a [f32]),
    /// A radius for each position.
    Function {
        /// Gives the radius at a position; for a sample, at the floats that are returned.
        at: &'a RadiusFunction<'a>,
        /// The least that it gives.
        smallest: f64,
        /// The largest that it gives.
        largest: f64,
        /// How much the radius changes at most per unit of distance between two positions on a triangle: 0 and up. What
        /// is covered is proved with it, so it must hold; where a violation is seen, the call fails. The work grows
        /// with its square from about 1 on; from about 30 on it may be too much, which is refused. At most `smallest` /
        /// 24 per float spacing at the largest coordinate of the mesh.
        slope: f64,
    },
}
