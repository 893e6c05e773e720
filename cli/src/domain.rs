//! The domain of a set of the plane: the one asked for, or the one of the file, or a guess from the points; and the cuboid
//! of a set in space.

use azulejo::{Boundary, Domain};
use clap::Args;

use crate::formats::set::PlaneSet;

/// The help of `--domain` for [`DomainArgs::of_or_around`].
pub const OF_OR_AROUND: &str = "The corners of the rectangle [default: that of the input, or the unit square if the points \
                                fill it, or else the smallest around them, bounded]";

#[derive(Args)]
pub struct DomainArgs {
    /// The corners of the rectangle [default: that of the input, or the unit square if the points fill it].
    #[arg(long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"], allow_negative_numbers = true)]
    domain: Option<Vec<f64>>,
    /// The rectangle ends at its boundary; otherwise it is periodic.
    #[arg(long)]
    bounded: bool,
}

/// The cuboid of a set in space.
#[derive(Args)]
pub struct CuboidArgs {
    /// The corners of the cuboid [default: the unit cube].
    #[arg(
        long, visible_alias = "box", num_args = 6, value_names = ["X0", "Y0", "Z0", "X1", "Y1", "Z1"],
        allow_negative_numbers = true
    )]
    domain: Option<Vec<f64>>,
    /// The cuboid ends at its faces; otherwise it is periodic.
    #[arg(long)]
    bounded: bool,
}

impl CuboidArgs {
    /// The cuboid asked for, or the unit cube.
    pub fn or_unit(&self) -> Domain<3> {
        let boundary = if self.bounded { Boundary::Bounded } else { Boundary::Periodic };
        match self.domain.as_deref() {
            Some(&[x0, y0, z0, x1, y1, z1]) => Domain { min: [x0, y0, z0], max: [x1, y1, z1], boundary },
            _ => Domain::unit(boundary),
        }
    }
}

impl DomainArgs {
    fn boundary(&self) -> Boundary {
        if self.bounded { Boundary::Bounded } else { Boundary::Periodic }
    }

    /// The cuboid of six numbers, x y z of both corners.
    pub fn cuboid(&self, corners: [f64; 6]) -> Domain<3> {
        let [x0, y0, z0, x1, y1, z1] = corners;
        Domain { min: [x0, y0, z0], max: [x1, y1, z1], boundary: self.boundary() }
    }

    /// The domain asked for, or the unit square.
    pub fn or_unit(&self) -> Domain {
        self.asked().unwrap_or(Domain::unit(self.boundary()))
    }

    /// The domain asked for, or the smallest around some rectangles, or the unit square.
    pub fn or_box_of(&self, rectangles: &[Domain]) -> Domain {
        let around = rectangles.iter().copied().reduce(|a, b| Domain {
            min: [0, 1].map(|axis: usize| a.min[axis].min(b.min[axis])),
            max: [0, 1].map(|axis: usize| a.max[axis].max(b.max[axis])),
            ..a
        });
        let around = around.map(|around| Domain { boundary: self.boundary(), ..around });
        self.asked().or(around).unwrap_or(Domain::unit(self.boundary()))
    }

    fn asked(&self) -> Option<Domain> {
        let [x0, y0, x1, y1] = self.domain.as_deref()?.try_into().ok()?;
        Some(Domain { min: [x0, y0], max: [x1, y1], boundary: self.boundary() })
    }

    /// The domain asked for, or that of the file, or the unit square if the points lie in it and nearly fill it.
    pub fn of(&self, set: &PlaneSet) -> Option<Domain> {
        let named = set.domain.map(|domain| match self.bounded {
            true => Domain { boundary: Boundary::Bounded, ..domain },
            false => domain,
        });
        self.asked().or(named).or_else(|| {
            let (low, high) = bounds(&set.points);
            let fills = (0..2).all(|axis| low[axis] >= 0.0 && high[axis] < 1.0 && high[axis] - low[axis] > 0.8);
            fills.then(|| Domain::unit(self.boundary()))
        })
    }

    /// [`DomainArgs::of`], or the smallest rectangle around the points, which has no period.
    pub fn of_or_around(&self, set: &PlaneSet) -> Domain {
        self.of(set).unwrap_or_else(|| {
            let (low, high) = bounds(&set.points);
            let side = (0..2).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
            // A line of points, or a single one, gets a rectangle around it too.
            let margin = if side > 0.0 { side * 1e-3 } else { 0.5 };
            let corner = |end: [f64; 2], margin: f64| end.map(|x| x + margin);
            Domain { min: corner(low, -margin), max: corner(high, margin), boundary: Boundary::Bounded }
        })
    }
}

/// The corners of the smallest rectangle around points.
fn bounds(points: &[[f32; 2]]) -> ([f64; 2], [f64; 2]) {
    points.iter().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(low, high), point| {
        let point = point.map(f64::from);
        let pick = |a: [f64; 2], choose: fn(f64, f64) -> f64| std::array::from_fn(|i| choose(a[i], point[i]));
        (pick(low, f64::min), pick(high, f64::max))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(corners: [[f32; 2]; 2], domain: Option<Domain>) -> PlaneSet {
        PlaneSet { points: corners.to_vec(), domain, ..PlaneSet::default() }
    }

    #[test]
    fn flags_come_before_the_file_and_the_file_before_guesses() {
        let none = DomainArgs { domain: None, bounded: false };
        let asked = DomainArgs { domain: Some(vec![-1.0, 0.0, 3.0, 2.0]), bounded: true };
        let named = Domain { min: [0.0; 2], max: [7.0; 2], boundary: Boundary::Periodic };
        let filled = [[0.01, 0.02], [0.97, 0.99]];
        let expected = Domain { min: [-1.0, 0.0], max: [3.0, 2.0], boundary: Boundary::Bounded };
        assert_eq!(asked.of(&set(filled, Some(named))), Some(expected));
        assert_eq!(none.of(&set(filled, Some(named))), Some(named));
        let bounded = DomainArgs { domain: None, bounded: true };
        assert_eq!(bounded.of(&set(filled, Some(named))).unwrap().boundary, Boundary::Bounded);
        assert_eq!(none.of(&set(filled, None)), Some(Domain::unit(Boundary::Periodic)));
        for corners in [[[0.0, 0.0], [0.5, 0.99]], [[-0.1, 0.0], [0.9, 0.9]], [[0.1, 0.0], [1.0, 0.9]]] {
            assert_eq!(none.of(&set(corners, None)), None);
        }
    }

    #[test]
    fn a_rectangle_around_points_holds_them_and_is_never_empty() {
        let none = DomainArgs { domain: None, bounded: false };
        for corners in [[[2.0, 3.0], [5.0, 4.0]], [[2.0, 3.0], [2.0, 9.0]], [[2.0, 3.0], [2.0, 3.0]]] {
            let domain = none.of_or_around(&set(corners, None));
            assert_eq!(domain.boundary, Boundary::Bounded);
            for point in corners {
                assert!((0..2).all(|axis| domain.min[axis] < point[axis].into()));
                assert!((0..2).all(|axis| domain.max[axis] > point[axis].into()));
            }
        }
    }
}
