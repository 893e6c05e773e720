//! The candidates that others can be too near to: those with candidates of another chart, or with samples of other
//! blocks, in the cells around them.
//!
//! All others are accepted without a test. Two hits of one chart are at least as far apart as their points of the
//! pattern, since a projection shortens every distance; unless they are hits of one point.

use glam::DVec3;

use crate::psp::fill::Extent;

/// The side of a cell in radii.
const CELL: f64 = 4.0;
/// A ball of a radius reaches so far, in cells, with a margin for the rounding of places.
const REACH: f64 = 1.0 / CELL + 1e-4;
/// The mark of a cell that several charts have candidates in, or that has a sample.
const SEVERAL: u16 = u16::MAX;

/// Cells around a block, each with a mark: 0, the number of its only chart and 1, or [`SEVERAL`].
pub struct Marks {
    low: DVec3,
    per_cell: f64,
    size: [usize; 3],
    marks: Vec<u16>,
}

impl Marks {
    /// No marks yet, in a box around a block.
    pub fn new(extent: &Extent, radius: f64) -> Self {
        let [low, high] = extent.corners().map(|corner| DVec3::from_array(corner.map(f64::from)));
        let per_cell = 1.0 / (CELL * radius);
        let low = low - 2.0 * radius;
        let size = ((high + 2.0 * radius - low) * per_cell).to_array().map(|cells| cells as usize + 1);
        Self { low, per_cell, size, marks: vec![0; size.iter().product()] }
    }

    fn place(&self, position: [f32; 3]) -> [f64; 3] {
        ((DVec3::from_array(position.map(f64::from)) - self.low) * self.per_cell).to_array()
    }

    fn mark(&mut self, position: [f32; 3], mark: impl FnOnce(u16) -> u16) {
        let place = self.place(position);
        let [x, y, z] = [0, 1, 2].map(|axis| (place[axis].max(0.0) as usize).min(self.size[axis] - 1));
        let cell = &mut self.marks[(z * self.size[1] + y) * self.size[0] + x];
        *cell = mark(*cell);
    }

    /// Marks the cell of a candidate of a chart.
    #[inline]
    pub fn add(&mut self, position: [f32; 3], chart: u16) {
        self.mark(position, |mark| if mark == 0 || mark == chart + 1 { chart + 1 } else { SEVERAL });
    }

    /// Marks the cell of a sample that was there before.
    pub fn add_sample(&mut self, position: [f32; 3]) {
        self.mark(position, |_| SEVERAL);
    }

    /// True if a sample or a candidate of another chart can be within a radius of a candidate.
    #[inline]
    pub fn is_near_another(&self, position: [f32; 3], chart: u16) -> bool {
        let place = self.place(position);
        let end = |axis: usize, reach: f64| ((place[axis] + reach).max(0.0) as usize).min(self.size[axis] - 1);
        let [x, y, z] = [0, 1, 2].map(|axis| end(axis, -REACH)..end(axis, REACH) + 1);
        for z in z {
            for y in y.clone() {
                let row = (z * self.size[1] + y) * self.size[0];
                let differs = |&mark: &u16| mark != 0 && mark != chart + 1;
                if self.marks[row + x.start..row + x.end].iter().any(differs) {
                    return true;
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::distance_squared;
    use crate::rng::{Draw, Rng};

    #[test]
    fn no_candidate_with_another_one_within_a_radius_is_missed() {
        let (mut rng, mut alone, mut close) = (Rng::at(1, Draw::Probe, &[]), 0, 0);
        for round in 0..60 {
            let (size, radius, offset) =
                ([3.0, 30.0, 60.0][round % 3], [0.1, 2.0][round % 2], [0.0, -500.0][round / 2 % 2]);
            let mut place = |size: f64| [(); 3].map(|()| (offset + radius * size * rng.unit()) as f32);
            let extent = Extent::of([0.0, size].map(|share| [(offset + radius * share) as f32; 3]));
            let candidates: Vec<_> = (0..40).map(|i| (place(size), i % 3)).collect();
            let samples: Vec<_> = (0..2).map(|_| place(size + 1.0)).collect();
            let mut marks = Marks::new(&extent, radius);
            candidates.iter().for_each(|&(position, chart)| marks.add(position, chart));
            samples.iter().for_each(|&sample| marks.add_sample(sample));
            let is_near = |a: [f32; 3], b: [f32; 3]| distance_squared(a, b) < radius * radius;
            for &(position, chart) in &candidates {
                let others = candidates.iter().any(|&(other, of)| of != chart && is_near(position, other));
                let is_close = others || samples.iter().any(|&sample| is_near(position, sample));
                let found = marks.is_near_another(position, chart);
                assert!(found || !is_close);
                close += usize::from(is_close);
                alone += usize::from(!found);
            }
        }
        assert!(close > 100 && alone > 100, "{close} {alone}");
    }
}
