//! Darts of uniform density on a row of areas, however the surface is cut into them.
//!
//! A row that is known as a whole receives any number of darts, one by one ([`Weights`](crate::index::Weights)). Darts
//! on areas that are passed once are a Poisson process ([`PoissonProcess`]): from one dart to the next the area passed
//! is Exp(1) over the density.

use crate::math::log;
use crate::rng::Rng;

/// The darts of a Poisson process on areas, one after the other.
pub struct PoissonProcess<'a> {
    rng: &'a mut Rng,
    per_area: f64,
    /// The remaining area before the next dart falls.
    left: f64,
}

impl<'a> PoissonProcess<'a> {
    pub fn new(rng: &'a mut Rng, per_area: f64) -> Self {
        let left = waiting(rng, per_area);
        Self { rng, per_area, left }
    }

    /// True if no dart falls on the next area, which then has been passed.
    pub fn passes(&mut self, area: f64) -> bool {
        let is_empty = area <= self.left;
        if is_empty {
            self.left -= area;
        }
        is_empty
    }

    /// The number of darts on the next area.
    pub fn darts_on(&mut self, area: f64) -> usize {
        let mut darts = 0;
        self.left -= area;
        while self.left < 0.0 {
            darts += 1;
            self.left += waiting(self.rng, self.per_area);
        }
        darts
    }
}

fn waiting(rng: &mut Rng, per_area: f64) -> f64 {
    -log(1.0 - rng.unit()) / per_area
}

/// Puts items into random order (Fisher and Yates).
pub fn shuffle<T>(rng: &mut Rng, items: &mut [T]) {
    for last in (1..items.len()).rev() {
        items.swap(last, rng.below(last as u64 + 1) as usize);
    }
}

/// Barycentrics of a random point of a triangle.
pub fn random_point(rng: &mut Rng) -> [f64; 2] {
    let [s, t] = [rng.unit(), rng.unit()];
    if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] }
}
