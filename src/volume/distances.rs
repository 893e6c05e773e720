//! Bounds of the distance from a surface in a box, by the distances of its corners.
//!
//! The squared distance d² of a place x from a set is the least |x − y|² of its places y. So |x|² − d² is the largest of
//! functions that are linear in x: it is convex, whatever the set (Cannarsa and Sinestrari 2004, "Semiconcave functions,
//! Hamilton-Jacobi equations, and optimal control", section 2.2), and in a box at most what trilinear interpolation gives between
//! the corners. For a place that lies at the shares s of the box's sides a,
//!
//! d² ≥ the interpolated d² of the corners − the sum of s (1 − s) a² over the axes.
//!
//! Where the surface is flat the bound is a²/2 too small at most for a cube, and so d by about a²/4d: less than the cube, from
//! a distance of its side on. The place of the surface that is nearest to a corner bounds d from above.

use crate::math::square;

/// The surface as seen from a corner of a box.
#[derive(Clone, Copy)]
pub struct Corner {
    /// A lower bound of the squared distance.
    pub least: f64,
    /// The place that is nearest, or any other one; infinitely far if none is known.
    pub foot: [f64; 3],
}

/// A box with what is known at its corners: x is the fastest.
pub struct Distances {
    pub low: [f64; 3],
    pub sides: [f64; 3],
    pub corners: [Corner; 8],
}

impl Distances {
    /// A lower and an upper bound of the distance at a place of the box.
    pub fn at(&self, place: [f64; 3]) -> [f64; 2] {
        let shares: [f64; 3] = std::array::from_fn(|axis| (place[axis] - self.low[axis]) / self.sides[axis]);
        let (mut squares, mut nearest, mut spread) = (self.corners.map(|corner| corner.least), 0, 0.0);
        for axis in (0..3).rev() {
            let (share, half) = (shares[axis], 1 << axis);
            for corner in 0..half {
                squares[corner] += share * (squares[corner + half] - squares[corner]);
            }
            spread += share * (1.0 - share) * square(self.sides[axis]);
            nearest |= if share > 0.5 { half } else { 0 };
        }
        [(squares[0] - spread).max(0.0).sqrt(), between(place, self.corners[nearest].foot)]
    }
}

/// The number of a corner along an axis, 0 or 1.
pub fn number_along(corner: usize, axis: usize) -> usize {
    corner >> axis & 1
}

/// The distance of two places.
pub fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| square(a[k] - b[k])).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// A box among places of a set, with the bounds of random places in it, and their distances.
    fn bounds(places: &[[f64; 3]], low: [f64; 3], sides: [f64; 3], rng: &mut Rng) -> Vec<([f64; 2], f64)> {
        let nearest = |place: [f64; 3]| {
            let nearer = |a: &&[f64; 3], b: &&[f64; 3]| between(place, **a).total_cmp(&between(place, **b));
            *places.iter().min_by(nearer).unwrap()
        };
        let corners = std::array::from_fn(|corner| {
            let place = std::array::from_fn(|axis| low[axis] + number_along(corner, axis) as f64 * sides[axis]);
            let foot = nearest(place);
            Corner { least: square(between(place, foot)), foot }
        });
        let distances = Distances { low, sides, corners };
        let inside = (0..200).map(|_| std::array::from_fn(|axis| low[axis] + rng.unit() * sides[axis]));
        inside.map(|place| (distances.at(place), between(place, nearest(place)))).collect()
    }

    #[test]
    fn distances_lie_between_their_bounds() {
        let mut rng = Rng::at(8, Draw::Probe, &[]);
        for count in [1, 2, 5, 40] {
            for _ in 0..60 {
                let places: Vec<[f64; 3]> = (0..count).map(|_| [0; 3].map(|_: i32| 2.0 * rng.unit() - 1.0)).collect();
                let low = [0; 3].map(|_: i32| 2.0 * rng.unit() - 1.0);
                let sides = [0; 3].map(|_: i32| 0.01 + rng.unit());
                for ([least, most], distance) in bounds(&places, low, sides, &mut rng) {
                    assert!(least <= distance + 1e-12 && distance <= most + 1e-12, "{least} {distance} {most}");
                }
            }
        }
    }

    /// A grid of places at z = 0, as good as a plane.
    #[test]
    fn bounds_are_close_where_a_box_is_small_beside_its_distance() {
        let along = |k: usize| (k as f64 - 100.0) / 50.0;
        let places: Vec<_> = (0..40_401).map(|k| [along(k % 201), along(k / 201), 0.0]).collect();
        let mut rng = Rng::at(8, Draw::Probe, &[]);
        for side in [0.25, 0.5, 1.0] {
            let found = bounds(&places, [-0.5 * side, -0.4 * side, 1.0], [side; 3], &mut rng);
            for ([least, most], distance) in found {
                let spread = 0.5 * square(side);
                assert!(least > (square(distance) - spread).sqrt() - 1e-3, "{side}: {least} {distance}");
                assert!(most < (square(distance) + spread).sqrt() + 1e-2, "{side}: {most} {distance}");
            }
        }
    }
}
