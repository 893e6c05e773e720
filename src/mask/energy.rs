//! The energy of a pattern of pixels: the sum of a Gaussian around every pixel that is set, on the torus.
//!
//! Ulichney's filter is evaluated in fixed point: the weights are integers, and so is every sum of them. Adding a pixel
//! and removing it again restores the energies exactly, in any order of changes, and they are equal on all processors.
//! A change adds the weights within the distance from which they round to zero, about six standard deviations.
//!
//! Energies of all pixels set have the same sum everywhere, as the torus has no boundary. So with what is left of it to
//! a pixel that is not set, the tightest cluster of these is the largest void between the others, exactly: the third
//! phase of the paper, which exchanges the two, goes on as the second.

use crate::math;

/// Pixels along the axes x, y and z of a torus; a plane has a depth of one.
pub type Size = [usize; 3];

/// The sum of all weights, before they are rounded, is no more than 2^31.
const SUM_BITS: u32 = 31;

/// The weights around a pixel in fixed point, row by row. Where the torus is smaller than they reach, those of all
/// images of a pixel are added up.
struct Stamp {
    rows: Vec<Row>,
    weights: Vec<u32>,
}

/// Weights of consecutive pixels of one row.
struct Row {
    /// The first pixel, from the one in the middle on, in steps along the axes that are not negative.
    first: Size,
    /// The range of the weights.
    weights: (usize, usize),
}

impl Stamp {
    fn new(size: Size, sigma: f64) -> Self {
        let falloff = 1.0 / (2.0 * sigma * sigma);
        let gaussian = |square: usize| math::exp(-(square as f64) * falloff);
        let axes = if size[2] > 1 { 3 } else { 2 };
        let tail = (1..).map(|step: usize| gaussian(step * step)).take_while(|&weight| weight > 1e-20).sum::<f64>();
        let sum = math::power(1.0 + 2.0 * tail, axes);
        let whole = (0..SUM_BITS)
            .rev()
            .map(|bit| f64::from(1u32 << bit))
            .find(|whole| whole * sum <= f64::from(1u32 << SUM_BITS));
        let whole = whole.expect("the sum of weights is below 2^31");
        let weight = |square: usize| (whole * gaussian(square)).round() as u32;
        let reach = (1..).take_while(|&step: &usize| weight(step * step) > 0).count();
        // The box of the weights, folded to the torus: entry k of an axis is k - reach steps from the middle.
        let spans = size.map(|pixels| if pixels == 1 { 1 } else { 2 * reach + 1 });
        let folded: Size = std::array::from_fn(|axis| spans[axis].min(size[axis]));
        let mut dense = vec![0u32; folded.iter().product()];
        let square = |axis: usize, k: usize| if spans[axis] == 1 { 0 } else { math::square(k.abs_diff(reach)) };
        for z in 0..spans[2] {
            for y in 0..spans[1] {
                let row = ((z % folded[2]) * folded[1] + y % folded[1]) * folded[0];
                for x in 0..spans[0] {
                    dense[row + x % folded[0]] += weight(square(0, x) + square(1, y) + square(2, z));
                }
            }
        }
        let start = |axis: usize, k: usize| {
            let back = if spans[axis] == 1 { 0 } else { reach % size[axis] };
            (k + size[axis] - back) % size[axis]
        };
        let mut stamp = Self { rows: Vec::new(), weights: Vec::new() };
        for (row, weights) in dense.chunks_exact(folded[0]).enumerate() {
            let (Some(from), Some(last)) = (weights.iter().position(|&w| w > 0), weights.iter().rposition(|&w| w > 0))
            else {
                continue;
            };
            let begin = stamp.weights.len();
            stamp.weights.extend_from_slice(&weights[from..=last]);
            stamp.rows.push(Row {
                first: [start(0, from), start(1, row % folded[1]), start(2, row / folded[1])],
                weights: (begin, stamp.weights.len()),
            });
        }
        stamp
    }
}

/// A step along an axis of the torus.
fn step(from: usize, by: usize, pixels: usize) -> usize {
    let to = from + by;
    if to < pixels { to } else { to - pixels }
}

/// A pattern of pixels and the energy at each pixel.
pub struct Energy {
    size: Size,
    stamp: Stamp,
    energies: Vec<u32>,
    is_set: Vec<bool>,
    /// The ranges of pixels whose energies the last change has altered.
    altered: Vec<(usize, usize)>,
}

impl Energy {
    /// No pixel is set.
    pub fn new(size: Size, sigma: f64) -> Self {
        let pixels = size.iter().product();
        let stamp = Stamp::new(size, sigma);
        Self { size, stamp, energies: vec![0; pixels], is_set: vec![false; pixels], altered: Vec::new() }
    }

    /// The number of pixels.
    pub fn pixels(&self) -> usize {
        self.is_set.len()
    }

    /// For every pixel whether it is set.
    pub fn pattern(&self) -> &[bool] {
        &self.is_set
    }

    /// The energies of all pixels.
    pub fn energies(&self) -> &[u32] {
        &self.energies
    }

    /// The ranges of pixels whose energies the last change has altered.
    pub fn altered(&self) -> &[(usize, usize)] {
        &self.altered
    }

    /// Sets a pixel.
    pub fn set(&mut self, pixel: usize) {
        debug_assert!(!self.is_set[pixel]);
        self.is_set[pixel] = true;
        self.alter(pixel, |energy, weight| *energy += weight);
    }

    /// Takes a pixel out that is set.
    pub fn clear(&mut self, pixel: usize) {
        debug_assert!(self.is_set[pixel]);
        self.is_set[pixel] = false;
        self.alter(pixel, |energy, weight| *energy -= weight);
    }

    fn alter(&mut self, pixel: usize, change: impl Fn(&mut u32, u32)) {
        self.altered.clear();
        let [width, height, depth] = self.size;
        let (x, row) = (pixel % width, pixel / width);
        let (y, z) = (row % height, row / height);
        for Row { first, weights } in &self.stamp.rows {
            let weights = &self.stamp.weights[weights.0..weights.1];
            let row = (step(z, first[2], depth) * height + step(y, first[1], height)) * width;
            let from = step(x, first[0], width);
            // What does not fit before the end of the row goes on at its begin.
            let (ahead, around) = weights.split_at(weights.len().min(width - from));
            for (start, weights) in [(row + from, ahead), (row, around)] {
                if weights.is_empty() {
                    continue;
                }
                let range = (start, start + weights.len());
                self.energies[range.0..range.1].iter_mut().zip(weights).for_each(|(e, &w)| change(e, w));
                self.altered.push(range);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    const SIZES: [Size; 8] =
        [[2, 2, 1], [3, 7, 1], [40, 5, 1], [64, 64, 1], [31, 45, 1], [2, 2, 2], [5, 9, 4], [33, 30, 29]];

    /// The energy of a pixel by its definition: the rounded Gaussian of every image of every pixel that is set.
    fn energy_at(size: Size, sigma: f64, set: &[usize], pixel: usize) -> u64 {
        let place = |p: usize| [p % size[0], p / size[0] % size[1], p / size[0] / size[1]].map(|c| c as i64);
        let axes = if size[2] > 1 { 3 } else { 2 };
        // Sums of Gaussians over the integers, far enough, and the largest power of two that keeps them below 2^31.
        let line: f64 = (-60..=60).map(|k: i32| (-f64::from(k * k) / (2.0 * sigma * sigma)).exp()).sum();
        let whole = (0..31).map(|bit| 2f64.powi(bit)).rfind(|whole| whole * line.powi(axes) <= 2f64.powi(31)).unwrap();
        let images = |axis: usize| if axis < axes as usize { 30 / size[axis] as i64 + 1 } else { 0 };
        let mut sum = 0;
        for &other in set {
            let [a, b] = [place(pixel), place(other)];
            for z in -images(2)..=images(2) {
                for y in -images(1)..=images(1) {
                    for x in -images(0)..=images(0) {
                        let offset = [x, y, z];
                        let square: i64 = (0..3).map(|i| (a[i] - b[i] + offset[i] * size[i] as i64).pow(2)).sum();
                        sum += (whole * (-(square as f64) / (2.0 * sigma * sigma)).exp()).round() as u64;
                    }
                }
            }
        }
        sum
    }

    #[test]
    fn energies_are_sums_over_all_images() {
        for (number, size) in SIZES.into_iter().enumerate() {
            let sigma = [1.0, 1.5, 2.5][number % 3];
            let mut energy = Energy::new(size, sigma);
            let mut rng = Rng::at(number as u64, Draw::Darts, &[]);
            let mut set: Vec<usize> = (0..7).map(|_| rng.below(energy.pixels() as u64) as usize).collect();
            set.sort_unstable();
            set.dedup();
            set.iter().for_each(|&pixel| energy.set(pixel));
            for _ in 0..40 {
                let pixel = rng.below(energy.pixels() as u64) as usize;
                let expected = energy_at(size, sigma, &set, pixel);
                assert_eq!(u64::from(energy.energies()[pixel]), expected, "{size:?} {pixel}");
            }
        }
    }

    #[test]
    fn changes_in_any_order_restore_the_energies() {
        for size in SIZES {
            let mut energy = Energy::new(size, 1.9);
            energy.set(1);
            let before = energy.energies().to_vec();
            let pixels: Vec<usize> = (0..energy.pixels()).filter(|&p| p != 1).collect();
            pixels.iter().for_each(|&pixel| energy.set(pixel));
            let full = energy.energies()[0];
            assert!(energy.energies().iter().all(|&e| e == full) && full <= 1 << SUM_BITS, "{size:?}: {full}");
            assert!(full > 1 << (SUM_BITS - 2), "{size:?}: {full}");
            pixels.iter().for_each(|&pixel| energy.clear(pixel));
            assert_eq!(energy.energies(), before);
        }
    }

    #[test]
    fn altered_are_all_pixels_that_have_changed() {
        for size in SIZES {
            let mut energy = Energy::new(size, 1.5);
            for pixel in [0, energy.pixels() - 1, energy.pixels() / 2] {
                let before = energy.energies().to_vec();
                energy.set(pixel);
                let mut altered = vec![false; before.len()];
                energy.altered().iter().for_each(|range| altered[range.0..range.1].fill(true));
                assert!((0..before.len()).all(|p| altered[p] == (energy.energies()[p] != before[p])), "{size:?}");
            }
        }
    }
}
