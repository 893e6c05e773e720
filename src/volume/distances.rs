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
    /// Visits some places of a grid in the box, whose coordinates along each axis are given, with a lower and an upper bound of the
    /// squared distance. A bit stands for each place: x is the fastest.
    pub fn for_each(&self, grid: &[[f64; 4]; 3], among: u64, mut bounded: impl FnMut(u32, [f64; 2])) {
        let columns = self.shares(grid, 0);
        let (rows, layers) = (self.shares(grid, 1), self.shares(grid, 2));
        for (z, layer) in (0..).zip(&layers) {
            if among >> (16 * z) & 0xffff == 0 {
                continue;
            }
            let least = |corner: usize| layer.between(self.corners[corner].least, self.corners[corner + 4].least);
            let ends = [[least(0), least(1)], [least(2), least(3)]];
            for (y, row) in (4 * z..).zip(&rows) {
                let mut left = among >> (4 * y) & 0xf;
                let [from, to] = [row.between(ends[0][0], ends[1][0]), row.between(ends[0][1], ends[1][1])];
                while left != 0 {
                    let x = left.trailing_zeros();
                    left &= left - 1;
                    let column = &columns[x as usize];
                    let least = column.between(from, to) - (layer.spread + row.spread + column.spread);
                    let foot = self.corners[column.nearest | row.nearest << 1 | layer.nearest << 2].foot;
                    let most = between_squared([column.place, row.place, layer.place], foot);
                    bounded(4 * y + x, [least.max(0.0), most]);
                }
            }
        }
    }

    #[inline(always)]
    fn shares(&self, grid: &[[f64; 4]; 3], axis: usize) -> [Share; 4] {
        let of = |place: f64| {
            let share = (place - self.low[axis]) / self.sides[axis];
            let spread = share * (1.0 - share) * square(self.sides[axis]);
            Share { place, share, spread, nearest: usize::from(share > 0.5) }
        };
        let [a, b, c, d] = grid[axis];
        [of(a), of(b), of(c), of(d)]
    }
}

/// A coordinate along an axis of a box.
struct Share {
    place: f64,
    /// Of the side.
    share: f64,
    /// The most by which the squared distance, which is convex, is less than interpolated.
    spread: f64,
    /// The nearest end: 0 or 1.
    nearest: usize,
}

impl Share {
    /// Interpolates between the ends.
    #[inline(always)]
    fn between(&self, from: f64, to: f64) -> f64 {
        from + self.share * (to - from)
    }
}

/// The number of a corner along an axis, 0 or 1.
pub fn number_along(corner: usize, axis: usize) -> usize {
    corner >> axis & 1
}

/// The squared distance of two places.
pub fn between_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// A box among places of a set, with the bounds of random places in it, and their distances.
    fn bounds(places: &[[f64; 3]], low: [f64; 3], sides: [f64; 3], rng: &mut Rng) -> Vec<([f64; 2], f64)> {
        let nearest = |place: [f64; 3]| {
            let nearer =
                |a: &&[f64; 3], b: &&[f64; 3]| between_squared(place, **a).total_cmp(&between_squared(place, **b));
            *places.iter().min_by(nearer).unwrap()
        };
        let corners = std::array::from_fn(|corner| {
            let place = std::array::from_fn(|axis| low[axis] + number_along(corner, axis) as f64 * sides[axis]);
            let foot = nearest(place);
            Corner { least: between_squared(place, foot), foot }
        });
        let distances = Distances { low, sides, corners };
        let (mut found, mut all) = (Vec::new(), 0);
        for among in [0; 6].map(|_: i32| rng.bits() & rng.bits()) {
            let grid: [[f64; 4]; 3] =
                std::array::from_fn(|axis| [0; 4].map(|_: i32| low[axis] + rng.unit() * sides[axis]));
            let mut seen = 0;
            distances.for_each(&grid, among, |bit, bounds| {
                let place = [grid[0][bit as usize % 4], grid[1][bit as usize / 4 % 4], grid[2][bit as usize / 16]];
                found.push((bounds.map(f64::sqrt), between_squared(place, nearest(place)).sqrt()));
                seen |= 1 << bit;
            });
            assert_eq!(seen, among);
            all += among.count_ones();
        }
        assert_eq!(found.len(), all as usize);
        found
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
