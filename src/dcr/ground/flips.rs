//! When an edge of a triangulation of the torus must be flipped.
//!
//! As long as no triangle turns over, a triangulation of moving points stays one, and flipping the edges that are not
//! locally Delaunay, in any order, makes it the Delaunay triangulation again (Lawson 1977). No exact predicates are
//! needed: forces do not feel the difference, and flips end because edges within rounding of 180 degrees are left
//! alone.

use glam::DVec2;

use crate::dcr::ground::torus::{Torus, TorusPoint};

/// The sum of two cotangents that counts as negative: below the rounding of `f64`, flips could go on for ever.
const NEGATIVE: f64 = -1e-7;

/// Whether the angles that face the edge from `p` to `q`, at `r` and at `s`, sum up to more than 180 degrees: the sum of
/// their cotangents is negative.
pub(in crate::dcr) fn must_flip(torus: &Torus, [p, q, r, s]: [TorusPoint; 4]) -> bool {
    let angle = |apex: TorusPoint, from: TorusPoint, to: TorusPoint| -> [f64; 2] {
        let (from, to): (DVec2, DVec2) = (torus.offset(apex, from), torus.offset(apex, to));
        [from.dot(to), from.perp_dot(to)]
    };
    let ([cos_r, sin_r], [cos_s, sin_s]) = (angle(r, p, q), angle(s, q, p));
    cos_r * sin_s + cos_s * sin_r < NEGATIVE * sin_r * sin_s
}
