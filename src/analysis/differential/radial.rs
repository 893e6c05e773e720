//! What p(d) is like by length alone: the radial distribution function, its spectrum, and how even it is all around.

use std::f64::consts::PI;
use std::ops::Range;

use crate::analysis::differential::{Differences, GRID_REACH, GRID_SIZE, REACH, SHELL_WIDTH, ratio};
use crate::math::{hypot, j0, square};

/// The differences of about one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    /// The middle of its lengths, in mean spacings.
    pub distance: f64,
    /// The mean of p(d): the radial distribution function; 1 for a Poisson process.
    pub density: f64,
    /// The number of pairs in it that a Poisson process would have; its density has a standard error of about one over
    /// the square root.
    pub expected: f64,
}

/// The area between the circles that bound a shell.
pub(super) fn shell_area(shell: usize) -> f64 {
    PI * SHELL_WIDTH * SHELL_WIDTH * (2 * shell + 1) as f64
}

impl Differences {
    /// The radial mean of p(d), in shells of [`SHELL_WIDTH`] out to the [`REACH`].
    pub fn radial(&self) -> Vec<Shell> {
        let counts = self.found.shells.iter().zip(&self.expected.shells);
        let shell = |(i, (&found, &expected)): (usize, (&f64, &f64))| Shell {
            distance: (i as f64 + 0.5) * SHELL_WIDTH,
            density: ratio(found, expected),
            expected,
        };
        counts.enumerate().map(shell).collect()
    }

    /// The radial mean of the power at frequencies in units of sqrt(density), 1 for a Poisson process: the Hankel
    /// transform of p(d) - 1, of which lengths near the [`REACH`] count less and less. That makes it the spectrum seen
    /// through a blur of 1 / [`REACH`].
    ///
    /// Takes O(1) for each frequency.
    pub fn power(&self, frequencies: &[f64]) -> Vec<f64> {
        let shells = self.radial();
        let excess = |(i, shell): (usize, &Shell)| {
            let fade = square(1.0 - square(shell.distance / REACH));
            // Where not even a Poisson process has a pair nothing is known.
            let excess = if shell.expected > 0.0 { shell.density - 1.0 } else { 0.0 };
            [shell.distance, shell_area(i) * fade * excess]
        };
        let terms: Vec<_> = shells.iter().enumerate().map(excess).collect();
        let power = |&frequency: &f64| {
            let wave = |&[distance, excess]: &[f64; 2]| excess * j0(2.0 * PI * frequency * distance);
            1.0 + terms.iter().map(wave).sum::<f64>()
        };
        frequencies.iter().map(power).collect()
    }

    /// How uneven p(d) is all around, over the lengths in `range` (mean spacings, within [`GRID_REACH`]): twice the mean
    /// of cos 2φ, weighted by p, φ being the angle from x. 0 for a set that is the same in all directions, positive
    /// where pairs of these lengths lie along x rather than across, 1 for p proportional to 1 + cos 2φ. 0 without pairs.
    pub fn elongation(&self, range: Range<f64>) -> f64 {
        let place = |i: usize| (i as f64 + 0.5) * (2.0 * GRID_REACH / GRID_SIZE as f64) - GRID_REACH;
        let (mut all, mut along) = (0.0, 0.0);
        for (i, density) in self.density().into_iter().enumerate() {
            let (x, y) = (place(i % GRID_SIZE), place(i / GRID_SIZE));
            if range.contains(&hypot(x, y)) {
                all += density;
                along += density * (x * x - y * y) / (x * x + y * y);
            }
        }
        2.0 * ratio(along, all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of Abramowitz and Stegun 1964, table 9.1, and an asymptotic one.
    #[test]
    fn the_bessel_function_of_order_0_is_that_of_the_tables() {
        for (x, expected) in [
            (0.0, 1.0),
            (1.0, 0.765_197_686_557_966_6),
            (2.404_825_557_695_773, 0.0),
            (10.0, -0.245_935_764_451_348_35),
            (100.0, 0.019_985_850_304_223_12),
        ] {
            assert!((j0(x) - expected).abs() < 1e-12, "{x}: {}", j0(x));
        }
    }
}
