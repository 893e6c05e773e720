//! Windows relative to their corner, on a torus anywhere on the images of the plane: what makes a plane endless.
//!
//! The images of a torus are numbered through: lattice point `j` is the point `j mod size` of the period `j div size`,
//! which begins at a multiple of the user's period `max - min`. Each edge of a window is the first of these numbers that
//! is not below it: a function of the edge alone, which grows with it. So windows that share an edge share no sample and
//! lose none there, however the arithmetic below rounds.
//!
//! A position is the difference of two sums that are exact for lattice points, in `f64`, and is then rounded down to a
//! float: so it is exact for a corner that is a lattice point, in windows of less than 2^24 units a side.

use crate::error::{Error, Result};
use crate::math::rounded_down;
use crate::plane::{Lattice, Rect};
use crate::points::{Boundary, Domain};

/// The largest number of periods between a corner and the domain, so that lattice points of all images have numbers.
const MOST_TURNS: f64 = (1u64 << 32) as f64;

/// A window of a plane, seen from its corner.
#[derive(Debug)]
pub struct RelativeWindow {
    /// The lattice points of the window. On a torus they begin in the first period and may reach into the second one.
    pub rect: Rect,
    /// The corner in the first period.
    corner: [f64; 2],
    /// The user's period.
    period: [f64; 2],
    size: [i32; 2],
}

/// The place of an edge along an axis: its period, the rest in the first one, and the first lattice point from there on.
struct Edge {
    turn: i64,
    rest: f64,
    point: i32,
}

impl RelativeWindow {
    /// The window between two corners of a torus, anywhere, at most a period wide and high; or of a bounded domain.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a window that is empty, too large, or too far away for its edges to have a place.
    pub fn new(domain: &Domain, lattice: &Lattice, min: [f64; 2], max: [f64; 2]) -> Result<Self> {
        let (mut rect, mut corner) = (Rect { min: [0; 2], max: [0; 2] }, [0.0; 2]);
        let period = domain.extent();
        for axis in 0..2 {
            for (argument, x) in [("window_min", min[axis]), ("window_max", max[axis])] {
                let (from, to) = (domain.min[axis], domain.max[axis]);
                let is_in_reach = match domain.boundary {
                    Boundary::Bounded => (from..=to).contains(&x),
                    Boundary::Periodic => ((x - from) / period[axis]).abs() <= MOST_TURNS,
                };
                if !is_in_reach {
                    let reason = match domain.boundary {
                        Boundary::Bounded => format!("[{axis}] is {x}, outside the domain {from} to {to}"),
                        Boundary::Periodic => format!("[{axis}] is {x}, more than 2^32 periods of {}", period[axis]),
                    };
                    return Err(Error::invalid(argument, reason));
                }
            }
            let (low, high) = (min[axis], max[axis]);
            if low >= high {
                return Err(Error::invalid("window_max", format!("[{axis}] is {high}, not above window_min {low}")));
            }
            if high - low > period[axis] {
                let reason = format!("[{axis}] is {high}, more than the period {} above {low}", period[axis]);
                return Err(Error::invalid("window_max", reason));
            }
            let [first, last] = [low, high].map(|x| edge(domain, lattice, axis, x));
            let length = (last.turn - first.turn) * i64::from(lattice.size[axis]) + i64::from(last.point - first.point);
            // A point at the end of a period is the first of the next one.
            rect.min[axis] = first.point;
            rect.max[axis] = first.point + length.min(i64::from(lattice.size[axis])) as i32;
            corner[axis] = first.rest;
        }
        Ok(Self { rect, corner, period, size: lattice.size })
    }

    /// The position of a lattice point of the window, from its corner.
    pub fn position(&self, lattice: &Lattice, point: [i32; 2]) -> [f32; 2] {
        std::array::from_fn(|axis| {
            let is_beyond = point[axis] >= self.size[axis];
            let (x, turned) =
                if is_beyond { (point[axis] - self.size[axis], self.period[axis]) } else { (point[axis], 0.0) };
            rounded_down(((lattice.coordinate(axis, x) - self.corner[axis]) + turned).max(0.0))
        })
    }
}

/// The place of an edge.
fn edge(domain: &Domain, lattice: &Lattice, axis: usize, x: f64) -> Edge {
    let (from, period) = (domain.min[axis], domain.extent()[axis]);
    let turns = match domain.boundary {
        Boundary::Bounded => 0.0,
        Boundary::Periodic => ((x - from) / period).floor(),
    };
    let rest = x - turns * period;
    Edge { turn: turns as i64, rest, point: lattice.first_from(axis, rest) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    fn lattice(domain: &Domain) -> Lattice {
        Lattice::of_any_size(domain, 0.01).unwrap()
    }

    fn torus(min: [f64; 2], max: [f64; 2]) -> Domain {
        Domain { min, max, boundary: Boundary::Periodic }
    }

    /// Periods that are and are not multiples of the unit; corners on lattice points, between them, and far away.
    #[test]
    fn windows_that_share_an_edge_share_no_lattice_point() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for domain in [torus([0.0; 2], [1.0; 2]), torus([-0.3, 0.1], [0.7, 1.3]), torus([2.0, -7.1], [2.77, -6.5])] {
            let lattice = lattice(&domain);
            for far in [1.0, 1e3, 1e9] {
                for _ in 0..300 {
                    let start = [0, 1].map(|axis| (rng.unit() - 0.5) * far * domain.extent()[axis]);
                    // Three windows side by side are the one window over all of them.
                    let mut edges = [start; 4];
                    for part in 1..4 {
                        edges[part][0] = edges[part - 1][0] + rng.unit() * 0.33 * domain.extent()[0];
                    }
                    let top = start[1] + 0.4 * domain.extent()[1];
                    let window = |from: usize, to: usize| {
                        RelativeWindow::new(&domain, &lattice, edges[from], [edges[to][0], top]).unwrap().rect
                    };
                    if edges.windows(2).any(|pair| pair[0][0] >= pair[1][0]) {
                        continue;
                    }
                    let lengths = (0..3).map(|part| window(part, part + 1).length(0)).sum::<i32>();
                    assert_eq!(lengths, window(0, 3).length(0), "{domain:?} {edges:?}");
                    for part in 0..2 {
                        let (end, next) = (window(part, part + 1).max[0], window(part + 1, part + 2).min[0]);
                        assert_eq!((end - next).rem_euclid(lattice.size[0]), 0);
                    }
                }
            }
        }
    }

    #[test]
    fn positions_are_exact_for_corners_on_the_lattice() {
        let domain = torus([-3.0, 5.0], [5.0, 9.0]);
        let lattice = lattice(&domain);
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        for _ in 0..500 {
            let steps = [0, 1].map(|axis: usize| rng.below(1 << 40) as i64 - (1 << 39) + axis as i64);
            let corner = [0, 1].map(|axis| domain.min[axis] + steps[axis] as f64 * lattice.unit());
            let side = 0.5 + rng.unit();
            let window = RelativeWindow::new(&domain, &lattice, corner, corner.map(|x| x + side)).unwrap();
            let first = [0, 1].map(|axis| steps[axis].rem_euclid(i64::from(lattice.size[axis])) as i32);
            assert_eq!(window.rect.min, first);
            for _ in 0..20 {
                let by = [0, 1].map(|axis| rng.below(window.rect.length(axis) as u64) as i32);
                let position = window.position(&lattice, [first[0] + by[0], first[1] + by[1]]);
                assert_eq!(position.map(f64::from), by.map(|by| f64::from(by) * lattice.unit()));
            }
        }
    }

    #[test]
    fn positions_lie_in_the_window() {
        let mut rng = Rng::at(5, Draw::Probe, &[]);
        for domain in [torus([-0.3, 0.1], [0.7, 1.3]), torus([1000.0; 2], [1000.7, 1001.1])] {
            let lattice = Lattice::of_any_size(&domain, 0.02).unwrap();
            for _ in 0..500 {
                let min = [0, 1].map(|axis: usize| (rng.unit() - 0.5) * 1e4 + axis as f64);
                let max = [0, 1].map(|axis: usize| min[axis] + 0.6 * rng.unit() + 1e-3);
                let window = RelativeWindow::new(&domain, &lattice, min, max).unwrap();
                for corner in [window.rect.min, window.rect.max.map(|x| x - 1)] {
                    for (axis, x) in window.position(&lattice, corner).into_iter().enumerate() {
                        // Corners so far away are rounded to 1e-12 when they are brought back.
                        assert!(x >= 0.0 && f64::from(x) < max[axis] - min[axis] + 1e-11, "{x} {min:?} {max:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_has_no_place_is_refused_by_name() {
        let domain = torus([0.0; 2], [2.0; 2]);
        let bounded = Domain { boundary: Boundary::Bounded, ..domain };
        let refuse = |domain: &Domain, min: [f64; 2], max: [f64; 2]| {
            RelativeWindow::new(domain, &lattice(domain), min, max).unwrap_err().to_string()
        };
        assert_eq!(refuse(&domain, [0.0; 2], [0.5, 2.5]), "window_max: [1] is 2.5, more than the period 2 above 0");
        assert_eq!(
            refuse(&domain, [1e11, 0.0], [2e11, 1.0]),
            "window_min: [0] is 100000000000, more than 2^32 periods of 2"
        );
        assert_eq!(refuse(&domain, [f64::NAN, 0.0], [1.0; 2]), "window_min: [0] is NaN, more than 2^32 periods of 2");
        assert_eq!(refuse(&domain, [1.0; 2], [1.5, 1.0]), "window_max: [1] is 1, not above window_min 1");
        assert_eq!(refuse(&bounded, [-0.5, 0.0], [1.0; 2]), "window_min: [0] is -0.5, outside the domain 0 to 2");
        assert_eq!(refuse(&bounded, [0.5, 0.0], [1.0, 3.0]), "window_max: [1] is 3, outside the domain 0 to 2");
    }
}
