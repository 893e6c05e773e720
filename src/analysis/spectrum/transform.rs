//! Fourier sums of points anywhere, for all frequencies of a grid at once.
//!
//! Σ w exp(-2πi k·x) is the transform of spikes at the points. Spread into bumps on a grid they can be transformed
//! fast, and the transform of the bumps is divided out again (Dutt and Rokhlin 1993, "Fast Fourier transforms for
//! nonequispaced data"). The bump is exp(β(√(1 - x²) - 1)) of Barnett, Magland and af Klinteberg 2019, "A parallel
//! nonuniform fast Fourier transform library based on an exponential of semicircle kernel": on a grid of at least four
//! points per period of the highest frequency the error is below 1e-10 of the sum of the weights.

use std::f64::consts::PI;

use rustfft::FftPlannerScalar;
use rustfft::num_complex::Complex;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::{cos, exp, sincos};

/// The bump's width in grid points, and its β.
const WIDTH: usize = 12;
const BETA: f64 = 2.3 * WIDTH as f64;

/// Rows and columns that one task transforms.
const LINES: usize = 64;

/// A point as a source of waves: its place in periods from the centre of the domain, and its weight.
pub(super) struct Weighted {
    pub turns: [f64; 2],
    pub weight: f64,
}

/// The Fourier sums of points.
pub(super) struct Coefficients {
    half: usize,
    /// By columns from 0 to `half`, in each by rows from -`half` to `half`.
    columns: Vec<Vec<Complex<f64>>>,
}

impl Coefficients {
    /// The sum at a frequency of at most `half` periods in columns and rows.
    pub fn at(&self, column: i64, row: i64) -> Complex<f64> {
        let place = |row: i64| (row + self.half as i64) as usize;
        if column >= 0 {
            self.columns[column as usize][place(row)]
        } else {
            self.columns[column.unsigned_abs() as usize][place(-row)].conj()
        }
    }
}

/// The sums up to `half` periods. O(points + half² log half).
pub(super) fn transform(job: &Job, points: &[Weighted], half: usize) -> Result<Coefficients> {
    let side = (4 * half).max(2 * WIDTH).next_power_of_two();
    let fft = FftPlannerScalar::new().plan_fft_forward(side);
    let scratch = || vec![Complex::default(); fft.get_inplace_scratch_len()];
    let grid = Grid::new(side, points);
    let chunks = chunks_of(side, LINES);
    let rows = job.part(0.0, 0.8).flat_map(chunks.len(), |chunk| {
        let mut scratch = scratch();
        let transformed = grid.rows(chunks.range(chunk)).into_iter().map(|mut row| {
            fft.process_with_scratch(&mut row, &mut scratch);
            row[..=half].to_vec()
        });
        transformed.collect()
    })?;
    let smoothing: Vec<f64> = (0..=half).map(|k| bump_transform(k as f64 / side as f64)).collect();
    let chunks = chunks_of(half + 1, LINES);
    let columns = job.part(0.8, 1.0).flat_map(chunks.len(), |chunk| {
        let mut scratch = scratch();
        let transformed = chunks.range(chunk).map(|column| {
            let mut sums: Vec<_> = rows.iter().map(|row| row[column]).collect();
            fft.process_with_scratch(&mut sums, &mut scratch);
            let half = half as i64;
            let sum = |row: i64| {
                sums[row.rem_euclid(side as i64) as usize]
                    / (smoothing[column] * smoothing[row.unsigned_abs() as usize])
            };
            (-half..=half).map(sum).collect()
        });
        transformed.collect()
    })?;
    Ok(Coefficients { half, columns })
}

/// The points sorted into the rows of a periodic grid.
struct Grid<'a> {
    side: usize,
    /// For each row the points whose bump begins in it.
    rows: Vec<Vec<&'a Weighted>>,
}

impl<'a> Grid<'a> {
    fn new(side: usize, points: &'a [Weighted]) -> Self {
        let mut rows = vec![Vec::new(); side];
        for point in points {
            rows[Bump::new(side, point.turns[1]).first].push(point);
        }
        Self { side, rows }
    }

    /// Rows of the grid, with the bumps of all points.
    fn rows(&self, range: std::ops::Range<usize>) -> Vec<Vec<Complex<f64>>> {
        let mut rows = vec![vec![Complex::default(); self.side]; range.len()];
        for start in range.start + self.side + 1 - WIDTH..range.end + self.side {
            for point in &self.rows[start % self.side] {
                let [across, up] = point.turns.map(|turns| Bump::new(self.side, turns));
                for (value, row) in up.values.into_iter().zip(start..) {
                    // Only the last of these rows can be in the range where the bump begins before it.
                    let Some(row) = row.checked_sub(range.start + self.side).and_then(|row| rows.get_mut(row)) else {
                        continue;
                    };
                    across.add(point.weight * value, row);
                }
            }
        }
        rows
    }
}

/// A point's bump along one axis.
struct Bump {
    /// The first grid point that it reaches.
    first: usize,
    values: [f64; WIDTH],
}

impl Bump {
    fn new(side: usize, turns: f64) -> Self {
        let place = (turns - turns.floor()) * side as f64;
        let first = (place - 0.5 * WIDTH as f64).ceil();
        let value = |i: usize| {
            let x = (first + i as f64 - place) * (2.0 / WIDTH as f64);
            exp(BETA * ((1.0 - x * x).max(0.0).sqrt() - 1.0))
        };
        Self { first: (first as i64).rem_euclid(side as i64) as usize, values: std::array::from_fn(value) }
    }

    /// Adds the bump to the real parts of a row.
    fn add(&self, weight: f64, row: &mut [Complex<f64>]) {
        let (begin, end) = row.split_at_mut(self.first);
        for (cell, value) in end.iter_mut().chain(begin).zip(self.values) {
            cell.re += weight * value;
        }
    }
}

/// The Fourier transform of the bump at a frequency per grid point, by the rectangle rule over the semicircle's angle.
fn bump_transform(frequency: f64) -> f64 {
    const NODES: usize = 200;
    let angles = (0..NODES).map(|i| ((i as f64 + 0.5) / NODES as f64 - 0.5) * PI);
    let reach = 0.5 * WIDTH as f64;
    let terms = angles.map(|angle| {
        let (sin, cosine) = sincos(angle);
        exp(BETA * (cosine - 1.0)) * cos(2.0 * PI * frequency * reach * sin) * cosine
    });
    terms.sum::<f64>() * reach * PI / NODES as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// Points everywhere, on the seam of the torus, on grid points and outside of the first period.
    #[test]
    fn agrees_with_the_definition_to_the_documented_error() {
        for half in [1, 2, 5, 30, 64] {
            let mut rng = Rng::at(half as u64, Draw::Probe, &[]);
            let special = [[0.0, 0.0], [0.5, -0.5], [0.25, 0.125], [-0.5, 1e-17], [3.7, -8.2], [-1e-17, 0.499_999_999]];
            let random = (0..40).map(|_| [rng.unit() - 0.5, rng.unit() - 0.5]);
            let turns: Vec<[f64; 2]> = special.into_iter().chain(random).collect();
            let points: Vec<_> = turns.into_iter().map(|turns| Weighted { turns, weight: 0.1 + rng.unit() }).collect();
            let weight: f64 = points.iter().map(|point| point.weight).sum();
            let waves = Context::new(2).unwrap().run(None, |job| transform(job, &points, half)).unwrap();
            let half = half as i64;
            for (column, row) in (-half..=half).flat_map(|column| (-half..=half).map(move |row| (column, row))) {
                let sum = points.iter().fold([0.0; 2], |sum, point| {
                    let cycles = column as f64 * point.turns[0] + row as f64 * point.turns[1];
                    let (sin, cos) = (-2.0 * PI * cycles).sin_cos();
                    [sum[0] + point.weight * cos, sum[1] + point.weight * sin]
                });
                let found = waves.at(column, row);
                let error = (found.re - sum[0]).hypot(found.im - sum[1]);
                assert!(error < 1e-10 * weight, "{half}: {error} at {column}, {row}");
            }
        }
    }
}
