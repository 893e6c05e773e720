//! The part of a set that is shown, and the power spectrum of it or of many such parts.

use std::ops::Range;

use azulejo::analysis::spectrum::{Periodogram, periodogram, sparse_periodogram};
use azulejo::{Boundary, Context, Domain, Progress, Result};

/// Frequencies are shown up to this many sqrt(density).
pub const FREQUENCY_LIMIT: f64 = 2.5;

/// A set with more points is shown in part. Both are numbers at which single points can be seen on a page.
const WHOLE_LIMIT: usize = 10_000;
const WINDOW_POINTS: f64 = 5_000.0;

/// Windows whose spectra are averaged: the speckle of one falls to a quarter.
const WINDOW_LIMIT: usize = 16;

/// The parts of a set that are analysed, of which the first is the one that is shown.
pub struct Windows {
    /// The rectangles; on a torus the whole domain.
    pub domains: Vec<Domain>,
    /// Points per area of the whole set.
    pub density: f64,
}

impl Windows {
    /// The whole domain of a small set; squares spread evenly over that of a large one, the middle one first.
    pub fn of(domain: &Domain, count: usize) -> Self {
        let density = count as f64 / domain.area();
        if count <= WHOLE_LIMIT {
            return Self { domains: vec![*domain], density };
        }
        let extent = domain.extent();
        let side = (WINDOW_POINTS / density).sqrt().min(extent[0]).min(extent[1]);
        let cells = extent.map(|length| (length / side) as usize);
        let total = cells[0] * cells[1];
        let middle = cells[1] / 2 * cells[0] + cells[0] / 2;
        let windows = total.min(WINDOW_LIMIT);
        let window = |i: usize| {
            let cell = (middle + i * total / windows) % total;
            let place = [cell % cells[0], cell / cells[0]];
            let min = std::array::from_fn(|axis| {
                let rest = extent[axis] - cells[axis] as f64 * side;
                domain.min[axis] + 0.5 * rest + place[axis] as f64 * side
            });
            Domain { min, max: min.map(|x: f64| x + side), boundary: Boundary::Bounded }
        };
        Self { domains: (0..windows).map(window).collect(), density }
    }

    /// The remark on a spectrum of these windows.
    pub fn remark(&self) -> String {
        let count = self.domains.len();
        if count > 1 { format!("mean of {count} windows") } else { String::new() }
    }

    /// The mean of the periodograms of all windows, out to the [`FREQUENCY_LIMIT`].
    pub fn spectrum(&self, context: &Context, points: &[[f32; 2]], progress: &Progress) -> Result<Periodogram> {
        let count = self.domains.len() as f64;
        let spectra = self.domains.iter().enumerate().map(|(i, domain)| {
            let waves = domain.extent().map(|length| FREQUENCY_LIMIT * length * self.density.sqrt());
            let size = 2 * waves[0].max(waves[1]).ceil() as usize + 3;
            let progress = |done| progress((i as f64 + done) / count);
            periodogram(context, domain, &inside(domain, points), size, Some(&progress))
        });
        Periodogram::mean(&spectra.collect::<Result<Vec<_>>>()?)
    }
}

/// The power of `points` up to `limit`, in units of sqrt(density), on a grid of no more than about `most` frequencies
/// per side: of a large set only every n-th frequency is computed. Sets of `count` points have the same grid.
pub fn spectrum_up_to(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    count: usize,
    limit: f64,
    most: usize,
    progress: Option<&Progress>,
) -> Result<Periodogram> {
    let [width, height] = domain.extent();
    let waves = limit * width.max(height) * (count as f64 / domain.area()).sqrt();
    let stride = (2.0 * waves / most as f64).ceil().max(1.0);
    let half = (waves / stride).ceil() as usize;
    sparse_periodogram(context, domain, points, 2 * half + 1, stride as usize, progress)
}

/// The points of a window; on a torus all points.
pub fn inside(domain: &Domain, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let within = |point: &[f32; 2]| {
        let beside = |axis: usize| (domain.min[axis]..domain.max[axis]).contains(&point[axis].into());
        domain.boundary == Boundary::Periodic || (beside(0) && beside(1))
    };
    points.iter().copied().filter(within).collect()
}

/// The power at a frequency, in units of sqrt(density), interpolated between those of the grid; 0 outside of it.
pub fn power_at(spectrum: &Periodogram, frequency: [f64; 2]) -> f64 {
    let size = spectrum.size();
    let [x, y] = [0, 1].map(|axis| frequency[axis] / spectrum.frequency_step()[axis] + (size / 2) as f64);
    let at = |column: f64, row: f64| {
        let inside = |k: f64| (0.0..size as f64).contains(&k);
        if inside(column) && inside(row) { spectrum.power()[row as usize * size + column as usize] as f64 } else { 0.0 }
    };
    let [(left, u), (low, v)] = [x, y].map(|k| (k.floor(), k - k.floor()));
    let row = |row| at(left, row) * (1.0 - u) + at(left + 1.0, row) * u;
    row(low) * (1.0 - v) + row(low + 1.0) * v
}

/// The mean power of the grid's frequencies in a rectangle; where there is none, the power in its middle.
pub fn mean_power(spectrum: &Periodogram, x: Range<f64>, y: Range<f64>) -> f64 {
    let size = spectrum.size();
    let within = |range: &Range<f64>, axis: usize| {
        let place = |frequency: f64| (frequency / spectrum.frequency_step()[axis]).ceil() + (size / 2) as f64;
        let [start, end] = [range.start, range.end].map(|frequency| place(frequency).clamp(0.0, size as f64) as usize);
        start..end
    };
    let (columns, rows) = (within(&x, 0), within(&y, 1));
    if columns.is_empty() || rows.is_empty() {
        return power_at(spectrum, [0.5 * (x.start + x.end), 0.5 * (y.start + y.end)]);
    }
    let count = columns.len() * rows.len();
    let row = |row: usize| spectrum.power()[row * size..][columns.clone()].iter().map(|&power| f64::from(power));
    rows.flat_map(row).sum::<f64>() / count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_of_a_large_set_are_apart_and_within_the_domain() {
        let domain = Domain { min: [-3.0, 1.0], max: [5.0, 4.0], boundary: Boundary::Periodic };
        for (count, expected) in [(10_001, 2), (50_000, 5), (100_000, 14), (1_000_000, 16)] {
            let windows = Windows::of(&domain, count);
            assert_eq!(windows.domains.len(), expected);
            for (i, a) in windows.domains.iter().enumerate() {
                assert!((3000.0..5000.1).contains(&(a.area() * windows.density)));
                for axis in 0..2 {
                    assert!(a.min[axis] > domain.min[axis] - 1e-9 && a.max[axis] < domain.max[axis] + 1e-9);
                }
                let apart = |b: &Domain| {
                    (0..2).any(|axis| a.max[axis] <= b.min[axis] + 1e-9 || b.max[axis] <= a.min[axis] + 1e-9)
                };
                assert!(windows.domains[..i].iter().all(apart), "{count}");
            }
        }
        assert_eq!(Windows::of(&domain, 10_000).domains, [domain]);
    }

    #[test]
    fn power_between_frequencies_is_that_of_its_neighbours() {
        let context = Context::new(1).unwrap();
        let points = [[0.1, 0.2], [0.5, 0.9], [0.3, 0.4], [0.7, 0.1]];
        let spectrum = periodogram(&context, &Domain::unit(Boundary::Periodic), &points, 5, None).unwrap();
        let power = |column: usize, row: usize| spectrum.power()[row * 5 + column] as f64;
        assert_eq!(power_at(&spectrum, [0.5, -0.5]), power(3, 1));
        let between = 0.5 * (power(3, 3) + power(3, 4));
        assert!((power_at(&spectrum, [0.5, 0.75]) - between).abs() < 1e-12);
        assert_eq!(power_at(&spectrum, [9.0, 0.0]), 0.0);
    }

    #[test]
    fn the_mean_power_of_a_rectangle_is_that_of_its_frequencies() {
        let context = Context::new(1).unwrap();
        let points = [[0.1, 0.2], [0.5, 0.9], [0.3, 0.4], [0.7, 0.1]];
        let spectrum = periodogram(&context, &Domain::unit(Boundary::Periodic), &points, 5, None).unwrap();
        // Frequencies are half of whole numbers. The end of a range is not in it.
        let mean = mean_power(&spectrum, 0.4..1.1, -0.6..0.0);
        let expected = 0.5 * (power_at(&spectrum, [0.5, -0.5]) + power_at(&spectrum, [1.0, -0.5]));
        assert!((mean - expected).abs() < 1e-12);
        assert_eq!(mean_power(&spectrum, 0.1..0.3, 0.4..0.6), power_at(&spectrum, [0.2, 0.5]));
        assert_eq!(mean_power(&spectrum, 7.0..8.0, 0.0..1.0), 0.0);
    }
}
