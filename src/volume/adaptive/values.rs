//! A radius by values on a grid: its interpolation, bounds and slope.

use crate::error::{Error, Result};
use crate::math::hypot;
use crate::points::Domain;

/// The share that rounding can add to the slope between two positions.
const ROUNDING: f64 = 1e-9;

/// Values on a grid over a domain, linear along each axis.
pub struct Values<'a> {
    values: &'a [f32],
    size: [usize; 3],
    min: [f64; 3],
    /// Steps of the grid per unit of length; 0 along an axis with one value.
    per_length: [f64; 3],
    /// The least and the largest value.
    pub bounds: [f64; 2],
    /// The largest change per unit of length.
    pub slope: f64,
}

impl<'a> Values<'a> {
    /// Checks values and their number.
    pub fn new(domain: &Domain<3>, values: &'a [f32], size: [usize; 3]) -> Result<Self> {
        let count = size.iter().try_fold(1usize, |count, &along| count.checked_mul(along));
        if count != Some(values.len()) || values.is_empty() {
            let reason = format!("{size:?} is not the size of a grid with {} values, at least one", values.len());
            return Err(Error::invalid("grid_size", reason));
        }
        if let Some(index) = values.iter().position(|value| !(value.is_finite() && *value > 0.0)) {
            let reason = format!("[{index}] is {:?}, not a positive finite number", values[index]);
            return Err(Error::invalid("grid_values", reason));
        }
        let extent = domain.extent();
        let per_length = std::array::from_fn(|axis| (size[axis] - 1) as f64 / extent[axis]);
        let bounds = values.iter().map(|&value| f64::from(value));
        let bounds = bounds.fold([f64::INFINITY, 0.0], |[least, most], x| [least.min(x), most.max(x)]);
        let mut grid = Self { values, size, min: domain.min, per_length, bounds, slope: 0.0 };
        grid.slope = grid.steepest();
        Ok(grid)
    }

    /// The value at a position of the domain.
    pub fn at(&self, position: [f64; 3]) -> f64 {
        let (mut lower, mut share) = ([0; 3], [0.0; 3]);
        for axis in 0..3 {
            let last = self.size[axis] - 1;
            let along = ((position[axis] - self.min[axis]) * self.per_length[axis]).clamp(0.0, last as f64);
            lower[axis] = (along as usize).min(last.saturating_sub(1));
            share[axis] = along - lower[axis] as f64;
        }
        let between = |[a, b]: [f64; 2], share: f64| a + share * (b - a);
        let [x, y, z] = lower;
        let row = |y, z| between([self.value([x, y, z]), self.value([x + 1, y, z])], share[0]);
        let layer = |z| between([row(y, z), row(y + 1, z)], share[1]);
        // Rounding may lead out of the bounds by a part of a float.
        between([layer(z), layer(z + 1)], share[2]).clamp(self.bounds[0], self.bounds[1])
    }

    /// A value by its numbers along the axes, the last one for larger ones.
    fn value(&self, numbers: [usize; 3]) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|axis| numbers[axis].min(self.size[axis] - 1));
        f64::from(self.values[x + self.size[0] * (y + self.size[1] * z)])
    }

    /// A bound of the gradient: in a cell its part along an axis lies between those on the edges along it.
    fn steepest(&self) -> f64 {
        let cells = self.size.map(|along| along.saturating_sub(1).max(1));
        let mut steepest = 0.0f64;
        for z in 0..cells[2] {
            for (x, y) in (0..cells[1]).flat_map(|y| (0..cells[0]).map(move |x| (x, y))) {
                let corner = |bits: usize| self.value([x + (bits & 1), y + (bits >> 1 & 1), z + (bits >> 2)]);
                let along = |axis: usize| {
                    let edges = (0..8).filter(|bits| bits >> axis & 1 == 0);
                    edges.map(|bits| (corner(bits | 1 << axis) - corner(bits)).abs()).fold(0.0, f64::max)
                        * self.per_length[axis]
                };
                steepest = steepest.max(hypot(hypot(along(0), along(1)), along(2)));
            }
        }
        steepest * (1.0 + ROUNDING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Boundary;
    use crate::rng::{Draw, Rng};

    fn domain() -> Domain<3> {
        Domain { min: [-1.0, 2.0, 0.0], max: [1.0, 5.0, 0.5], boundary: Boundary::Bounded }
    }

    #[test]
    fn values_are_met_at_the_nodes_and_changed_no_faster_than_the_slope() {
        let (domain, size) = (domain(), [3, 4, 2]);
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let values: Vec<f32> = (0..24).map(|_| 0.1 + rng.unit() as f32).collect();
        let grid = Values::new(&domain, &values, size).unwrap();
        for (number, &value) in values.iter().enumerate() {
            let numbers = [number % 3, number / 3 % 4, number / 12];
            let place = std::array::from_fn(|axis| {
                domain.min[axis] + domain.extent()[axis] * numbers[axis] as f64 / (size[axis] - 1) as f64
            });
            assert!((grid.at(place) - f64::from(value)).abs() < 1e-12);
        }
        let mut steepest = 0.0f64;
        for _ in 0..20_000 {
            let place: [f64; 3] = std::array::from_fn(|axis| domain.min[axis] + domain.extent()[axis] * rng.unit());
            let next: [f64; 3] = std::array::from_fn(|axis| place[axis] + 1e-4 * (rng.unit() - 0.5));
            let length = hypot(hypot(next[0] - place[0], next[1] - place[1]), next[2] - place[2]);
            let slope = (grid.at(next) - grid.at(place)).abs() / length;
            assert!(slope <= grid.slope * 1.000001);
            steepest = steepest.max(slope);
        }
        assert!(steepest > 0.6 * grid.slope, "{steepest} of {}", grid.slope);
    }

    #[test]
    fn one_value_is_for_a_whole_axis_and_bad_ones_are_refused() {
        let grid = Values::new(&domain(), &[0.25, 0.5], [1, 2, 1]).unwrap();
        assert_eq!((grid.at([0.3, 3.5, 0.1]), grid.bounds), (0.375, [0.25, 0.5]));
        assert!((grid.slope - 0.25 / 3.0).abs() < 1e-6);
        let refused = |values: &[f32], size| Values::new(&domain(), values, size).err().unwrap().to_string();
        assert!(refused(&[0.1; 3], [1, 2, 1]).starts_with("grid_size"));
        assert!(refused(&[], [0, 2, 1]).starts_with("grid_size"));
        assert!(refused(&[0.1; 3], [usize::MAX, 3, 3]).starts_with("grid_size"));
        for bad in [f32::NAN, 0.0, -1.0, f32::INFINITY] {
            assert!(refused(&[0.1, bad], [2, 1, 1]).starts_with("grid_values: [1] is "));
        }
    }
}
