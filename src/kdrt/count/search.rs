//! The radius of a maximal set with a given number of samples, from the density of such sets and from what was made.

use crate::math::{exp, hypot, log};
use crate::points::MAXIMAL_DENSITY;
use crate::points::{Boundary, Domain};

/// Samples per radius on a line: Rényi's parking constant.
const LINE_DENSITY: f64 = 0.7475979;

/// The share of additional samples at the seams, times the leaf size: 1.4 % for leaves of 6 radii, 0.5 % for 20. Small
/// domains, which have no seams, get it too: there it is less than chance.
const SEAM_DENSITY: f64 = 0.09;

/// A set is near its count if it differs by less than this share of it, three times what patterns differ by.
const NEAR: f64 = 0.01;

/// Or by less than this many times the square root of it. Counts differ by a quarter of the root.
const NEAR_ROOTS: f64 = 1.5;

/// Secant steps on the logarithms of radius and count.
pub struct Search {
    count: f64,
    radius: f64,
    /// The logarithms of the radius and of the count at the step before.
    last: Option<[f64; 2]>,
}

impl Search {
    /// Begins with the radius at which the density says that there are `count` samples.
    pub fn new(domain: &Domain, leaf_size: f64, count: u64) -> Self {
        let [width, height] = domain.extent();
        let count = count as f64;
        let mut low = (MAXIMAL_DENSITY * (width / count) * height).sqrt();
        let mut high = hypot(width, height).max(low);
        while high > low * (1.0 + 1e-12) {
            let middle = (low * high).sqrt();
            if middle <= low || middle >= high {
                break;
            }
            if expected(domain, leaf_size, middle) > count { low = middle } else { high = middle }
        }
        Self { count, radius: high, last: None }
    }

    /// The radius to try.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether a set can be expected to reach the count by small changes.
    pub fn is_near(&self, made: u64) -> bool {
        (made as f64 - self.count).abs() <= (NEAR * self.count).max(NEAR_ROOTS * self.count.sqrt())
    }

    /// Goes on to the radius that `made`, the number of samples made with the last one, lets expect.
    pub fn correct(&mut self, made: u64) {
        let here = [log(self.radius), log(made as f64)];
        // Counts fall with the square of the radius, on thin domains with the radius; anything else is chance.
        let slope = match self.last {
            Some(last) if here[0] != last[0] => ((here[1] - last[1]) / (here[0] - last[0])).clamp(-2.0, -1.0),
            _ => -2.0,
        };
        self.radius = exp(here[0] + (log(self.count) - here[1]) / slope);
        self.last = Some(here);
    }
}

/// About how many samples a maximal set has: see [`crate::plane::lattice::Lattice::expected_samples`], which this refines.
fn expected(domain: &Domain, leaf_size: f64, radius: f64) -> f64 {
    let beyond = if domain.boundary == Boundary::Bounded { 1.0 } else { 0.0 };
    // A domain thinner than the radius is a line.
    let [width, height] = domain.extent().map(|side| (side / radius + beyond).max(LINE_DENSITY / MAXIMAL_DENSITY));
    MAXIMAL_DENSITY * (1.0 + SEAM_DENSITY / leaf_size) * width * height
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_radius_is_that_of_the_expected_number() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for extent in [[1.0, 1.0], [30.0, 1.0], [1e38, 2e38], [3e-30, 1e-30], [1e-3, 5.0]] {
                let domain = Domain { min: [0.0; 2], max: extent, boundary };
                for count in [3, 10, 1000, 1_000_000_000] {
                    let radius = Search::new(&domain, 20.0, count).radius();
                    let found = expected(&domain, 20.0, radius);
                    assert!((found / count as f64 - 1.0).abs() < 1e-9, "{found} of {count} in {extent:?}");
                }
                let one = Search::new(&domain, 20.0, 1).radius();
                assert!(one > 0.0 && one <= extent[0].hypot(extent[1]));
            }
        }
    }

    /// Sets whose numbers follow other laws than the expected one.
    #[test]
    fn corrections_end_near_the_count() {
        let laws: [fn(f64) -> f64; 3] = [|r| 0.7 / (r * r), |r| 3.0 / r, |r| 0.6 / (r * r) + 5.0 / r];
        for law in laws {
            let mut search = Search::new(&Domain::unit(Boundary::Periodic), 20.0, 100_000);
            let near = (0..8).any(|_| {
                let made = law(search.radius()) as u64;
                search.correct(made);
                search.is_near(made)
            });
            assert!(near);
        }
    }
}
