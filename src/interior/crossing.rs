//! Crossings of rays and triangles, exactly as in real arithmetic.
//!
//! A ray runs from a point along +x. It is that of the point moved by (e³, e, e²) for an e that is smaller than any number
//! (Edelsbrunner and Mücke 1990, "Simulation of simplicity"), so that it passes through no edge and begins on no triangle.
//! Signs are those of sums of products of floats: `f64` with an error bound decides nearly all, and the rest is summed without
//! error (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", section 2).

type Point = [f32; 3];

/// A sum in two dimensions is right to this, relative to its terms; one in three to the other.
const ERROR_2D: f64 = 1e-15;
const ERROR_3D: f64 = 2e-15;

/// The crossing of the ray from a point with a triangle: 1 if the ray leaves on the side that the triangle faces, -1 if it comes
/// from there, 0 without a crossing.
#[inline]
pub fn crossing(point: Point, corners: &[Point; 3]) -> i32 {
    let [a, b, c] = corners;
    let side = side_of_edge(point, a, b);
    if side == 0 || side_of_edge(point, b, c) != side || side_of_edge(point, c, a) != side {
        return 0;
    }
    // Seen along x the triangle has the side of the point inside it; that is the sign of its normal along x.
    if side_of_plane(point, corners) == -side { side } else { 0 }
}

/// The side of an edge on which the moved point lies, seen along x: 1 for the left, 0 if the edge is seen as a point.
#[inline]
fn side_of_edge(point: Point, from: &Point, to: &Point) -> i32 {
    let side = turn([1, 2], from, to, &point);
    if side != 0 {
        return side;
    }
    if from[2] != to[2] { if from[2] > to[2] { 1 } else { -1 } } else { sign(f64::from(to[1]) - f64::from(from[1])) }
}

/// The side of a triangle's plane on which the moved point lies: 1 where its normal leads, 0 if there is no plane.
#[inline]
pub fn side_of_plane(point: Point, corners: &[Point; 3]) -> i32 {
    let [a, b, c] = corners;
    // Spelt out, since functions of arrays are calls.
    let from_a = |q: &Point| {
        let along = |k: usize| f64::from(q[k]) - f64::from(a[k]);
        [along(0), along(1), along(2)]
    };
    let (u, v, w) = (from_a(b), from_a(c), from_a(&point));
    let (mut volume, mut size) = (0.0, 0.0);
    for (k, along) in w.into_iter().enumerate() {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (left, right) = (u[i] * v[j], u[j] * v[i]);
        volume += (left - right) * along;
        size += (left.abs() + right.abs()) * along.abs();
    }
    if volume.abs() > ERROR_3D * size {
        return sign(volume);
    }
    let exact = side_of_plane_exactly(&point, corners);
    // Moved along y, then z, then x.
    [exact, turn([2, 0], a, b, c), turn([0, 1], a, b, c), turn([1, 2], a, b, c)]
        .into_iter()
        .find(|&sign| sign != 0)
        .unwrap_or(0)
}

#[cold]
fn side_of_plane_exactly(point: &Point, [a, b, c]: &[Point; 3]) -> i32 {
    let mut sum = Sum::default();
    for (k, i, j) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        // The determinant of three of the four points, for each of them.
        for (factor, x, y, z) in [(1.0, b, c, point), (-1.0, a, c, point), (1.0, a, b, point), (-1.0, a, b, c)] {
            sum.add_product(x[i], y[j], factor * z[k]);
            sum.add_product(x[j], y[i], -factor * z[k]);
        }
    }
    sum.sign()
}

/// The sign of the turn from a to b to c, seen along the third axis: 1 to the left.
#[inline]
fn turn([x, y]: [usize; 2], a: &Point, b: &Point, c: &Point) -> i32 {
    let place = |p: &Point| [f64::from(p[x]), f64::from(p[y])];
    let (a, b, c) = (place(a), place(b), place(c));
    let (left, right) = ((b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0]));
    let area = left - right;
    if area.abs() > ERROR_2D * (left.abs() + right.abs()) { sign(area) } else { turn_exactly(a, b, c) }
}

#[cold]
fn turn_exactly(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i32 {
    let mut sum = Sum::default();
    for (p, q) in [(b, c), (c, a), (a, b)] {
        // Products of two floats are exact.
        sum.add(p[0] * q[1]);
        sum.add(-p[1] * q[0]);
    }
    sum.sign()
}

fn sign(x: f64) -> i32 {
    i32::from(x > 0.0) - i32::from(x < 0.0)
}

/// A sum without error: numbers of growing size that do not overlap.
struct Sum {
    parts: [f64; 64],
    len: usize,
}

impl Default for Sum {
    fn default() -> Self {
        Self { parts: [0.0; 64], len: 0 }
    }
}

impl Sum {
    /// Adds a number: Shewchuk's Grow-Expansion without zeros. There are up to 64 of them.
    fn add(&mut self, mut x: f64) {
        let mut kept = 0;
        for i in 0..self.len {
            let (y, sum) = (self.parts[i], x + self.parts[i]);
            let of_y = sum - x;
            let error = (x - (sum - of_y)) + (y - of_y);
            if error != 0.0 {
                self.parts[kept] = error;
                kept += 1;
            }
            x = sum;
        }
        if x != 0.0 {
            self.parts[kept] = x;
            kept += 1;
        }
        self.len = kept;
    }

    /// Adds the product of three floats, as two products of 26 and 22 bits with 24.
    fn add_product(&mut self, a: f32, b: f32, c: f32) {
        let (ab, c) = (f64::from(a) * f64::from(b), f64::from(c));
        let high = f64::from_bits(ab.to_bits() & !((1 << 27) - 1));
        self.add(high * c);
        self.add((ab - high) * c);
    }

    fn sign(&self) -> i32 {
        if self.len == 0 { 0 } else { sign(self.parts[self.len - 1]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// The crossing in integers for coordinates below 8: an e of 2^-10 is small enough for them.
    fn crosses_in_integers(point: [i32; 3], corners: [[i32; 3]; 3]) -> bool {
        let scaled = |p: [i32; 3]| p.map(|x| i128::from(x) << 30);
        let ([a, b, c], [x, y, z]) = (corners.map(scaled), scaled(point));
        let q = [x + 1, y + (1 << 20), z + (1 << 10)];
        let minus = |p: [i128; 3], q: [i128; 3]| -> [i128; 3] { std::array::from_fn(|k| p[k] - q[k]) };
        let side = |p: [i128; 3], r: [i128; 3]| {
            let (edge, to) = (minus(r, p), minus(q, p));
            (edge[1] * to[2] - edge[2] * to[1]).signum()
        };
        let (u, v, w) = (minus(b, a), minus(c, a), minus(q, a));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        // The crossing is at a.x - (n.y w.y + n.z w.z) / n.x, if n.x is not 0.
        let beyond = -normal.iter().zip(w).map(|(n, w)| n * w).sum::<i128>().signum() * normal[0].signum() > 0;
        [side(a, b), side(b, c), side(c, a)].iter().all(|&s| s != 0 && s == normal[0].signum()) && beyond
    }

    /// Few coordinates, so that points lie on lines and planes of triangles; also scaled and moved, so that products have many
    /// bits and are far from 1.
    #[test]
    fn crossings_are_those_in_integers() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let mut crossed = 0;
        for case in 0..60_000 {
            let width = [2, 3, 8][case % 3];
            let mut place = || [0; 3].map(|_: i32| rng.below(width) as i32);
            let (point, corners) = (place(), [place(), place(), place()]);
            let expected = crosses_in_integers(point, corners);
            for (scale, shift) in
                [(1.0, 0.0), (2f32.powi(-140), 0.0), (2f32.powi(120), 0.0), (1.0, 2e6 + 1.0), (0.25, -1e6)]
            {
                let float = |p: [i32; 3]| p.map(|x| x as f32 * scale + shift);
                assert_eq!(crossing(float(point), &corners.map(float)) != 0, expected, "{point:?} {corners:?} {scale}");
            }
            crossed += usize::from(expected);
        }
        assert!(crossed > 1_000, "{crossed}");
    }

    /// Floats of all sizes, against sums in integers: a point on the edge between two triangles is on one side of it.
    #[test]
    fn turns_of_floats_of_all_sizes_are_exact() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let mut flat = 0;
        for _ in 0..20_000 {
            let mut float = || (rng.below(1 << 24) as f32 - 8e6) * f32::from_bits((97 + rng.below(20) as u32) << 23);
            let [a, b] = [[float(), float(), 0.0], [float(), float(), 0.0]];
            let share = rng.below(9) as f32 / 8.0;
            let c = [0, 1, 2].map(|k: usize| a[k] + (b[k] - a[k]) * share);
            let integer = |p: Point| p.map(|x| (f64::from(x) * 2f64.powi(40)) as i128);
            let [p, q, r] = [a, b, c].map(integer);
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            assert_eq!(turn([0, 1], &a, &b, &c), area.signum() as i32);
            assert_eq!(turn([0, 1], &b, &a, &c), -area.signum() as i32);
            flat += usize::from(area == 0);
        }
        assert!(flat > 1_000, "{flat}");
    }

    #[test]
    fn sums_have_no_error() {
        let mut sum = Sum::default();
        for x in [1e300, 1.0, -1e300, 1e-300, -1.0] {
            sum.add(x);
        }
        assert_eq!((sum.sign(), sum.len, sum.parts[0]), (1, 1, 1e-300));
        sum.add(-1e-300);
        assert_eq!((sum.sign(), sum.len), (0, 0));
        let mut sum = Sum::default();
        let [a, b, c] = [16_777_213.0, 16_777_211.0, 16_777_199.0];
        sum.add_product(a, b, c);
        sum.add_product(-b, c, a);
        assert_eq!(sum.sign(), 0);
    }
}
