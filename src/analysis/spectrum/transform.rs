//! Fourier sums of points anywhere, for all frequencies of a grid at once.
//!
//! Σ w exp(-2πi k·x) is the transform of spikes at the points. Spread into bumps on a grid they can be transformed
//! fast, and the transform of the bumps is divided out again (Dutt and Rokhlin 1993, "Fast Fourier transforms for
//! nonequispaced data"). The bump is exp(β(√(1 - x²) - 1)) of Barnett, Magland and af Klinteberg 2019, "A parallel
//! nonuniform fast Fourier transform library based on an exponential of semicircle kernel": on a grid of at least four
//! points per period of the highest frequency the error is below 1e-10 of the sum of the weights.

use std::f64::consts::PI;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::{cos, exp, sincos};

/// The bump's width in grid points, and its β.
const WIDTH: usize = 12;
const BETA: f64 = 2.3 * WIDTH as f64;

/// Lines along the last axis that one task transforms, and the grid points of the slices across it that one task fills: as
/// many slices as lines, unless these are large.
const LINES: usize = 64;
const SLICE_POINTS: usize = 1 << 22;
const FEWEST_SLICES: usize = 4;

/// A point as a source of waves: its place in periods from the centre of the domain, and its weight.
pub(super) struct Weighted<const D: usize> {
    pub turns: [f64; D],
    pub weight: f64,
}

/// A value for each frequency of at most `half` periods along the axes, of a frequency and its opposite for one of them: in
/// one dimension all, otherwise those from 0 along the first axis.
pub(super) struct Coefficients<T, const D: usize> {
    half: [usize; D],
    /// Lines along the last axis, the first one changing fastest from each to the next.
    lines: Vec<Vec<T>>,
}

impl<T: Copy, const D: usize> Coefficients<T, D> {
    /// The value at a frequency, or at its opposite, of which it is known.
    pub fn at(&self, frequency: [i64; D]) -> T {
        let is_known = D == 1 || frequency[0] >= 0;
        let known = if is_known { frequency } else { frequency.map(|k| -k) };
        let line = (0..D - 1).rev().fold(0, |line, axis| {
            line * kept::<D>(self.half, axis) + (known[axis] - lowest::<D>(self.half, axis)) as usize
        });
        self.lines[line][(known[D - 1] + self.half[D - 1] as i64) as usize]
    }
}

/// The lowest frequency along an axis that is kept, and their number.
fn lowest<const D: usize>(half: [usize; D], axis: usize) -> i64 {
    if axis == 0 && D > 1 { 0 } else { -(half[axis] as i64) }
}

fn kept<const D: usize>(half: [usize; D], axis: usize) -> usize {
    (half[axis] as i64 - lowest::<D>(half, axis)) as usize + 1
}

/// The grid points along an axis, at least four per period of the highest frequency. In the plane a power of two, the fastest;
/// in space that would take up to eight times as much memory, and it is a product of 2, 3 and 5.
fn grid_side<const D: usize>(half: usize) -> usize {
    let least = (4 * half).max(2 * WIDTH);
    let rest = |side: usize| {
        [2, 3, 5].into_iter().fold(side, |rest, prime| {
            std::iter::successors(Some(rest), |rest| (rest % prime == 0).then_some(rest / prime)).last().unwrap_or(rest)
        })
    };
    if D < 3 { least.next_power_of_two() } else { (least..).find(|&side| rest(side) == 1).unwrap_or(least) }
}

/// The bytes that [`transform`] takes at its peak, besides the points and the values.
pub(super) fn bytes<const D: usize>(half: [usize; D], points: usize, threads: usize) -> f64 {
    let side = half.map(|half| grid_side::<D>(half) as f64);
    let slice: f64 = side[..D - 1].iter().product();
    let lines: f64 = (0..D - 1).map(|axis| kept::<D>(half, axis) as f64).product();
    let in_work = (slices_of_task(slice as usize) * threads) as f64 * slice;
    // The vectors of references to points grow in steps. Each slice and line is a vector of its own.
    let vectors = side[D - 1] + lines;
    (in_work + lines * side[D - 1]) * size_of::<Complex<f64>>() as f64 + 16.0 * points as f64 + 48.0 * vectors
}

fn slices_of_task(slice: usize) -> usize {
    (SLICE_POINTS / slice).clamp(FEWEST_SLICES, LINES)
}

/// The results of `value` from the sums up to `half` periods. O(points + frequencies · log frequencies).
pub(super) fn transform<T: Send, const D: usize>(
    job: &Job,
    points: &[Weighted<D>],
    half: [usize; D],
    value: impl Fn([i64; D], Complex<f64>) -> T + Sync,
) -> Result<Coefficients<T, D>> {
    let side = half.map(grid_side::<D>);
    let mut planner = FftPlannerScalar::new();
    let fft = side.map(|side| planner.plan_fft_forward(side));
    let smoothing: [Vec<f64>; D] =
        std::array::from_fn(|axis| (0..=half[axis]).map(|k| bump_transform(k as f64 / side[axis] as f64)).collect());
    let grid = Grid::new(side, points);
    let last = D - 1;
    let chunks = chunks_of(side[last], slices_of_task(side[..last].iter().product()));
    let slices = job.part(0.0, 0.8).flat_map(chunks.len(), |chunk| {
        let slices = grid.slices(chunks.range(chunk)).into_iter();
        slices.map(|slice| (0..last).fold(slice, |slice, axis| across(slice, axis, half, side, &fft[axis]))).collect()
    })?;
    let count = slices[0].len();
    let chunks = chunks_of(count, LINES);
    let lines = job.part(0.8, 1.0).flat_map(chunks.len(), |chunk| {
        let mut scratch = vec![Complex::default(); fft[last].get_inplace_scratch_len()];
        let range = chunks.range(chunk);
        let mut lines = vec![Vec::with_capacity(side[last]); range.len()];
        // Slice by slice, as neighbouring lines share what the processor loads.
        for slice in &slices {
            lines.iter_mut().zip(&slice[range.clone()]).for_each(|(line, &sum)| line.push(sum));
        }
        let transformed = range.zip(lines).map(|(number, mut line)| {
            fft[last].process_with_scratch(&mut line, &mut scratch);
            let (mut frequency, mut number) = ([0; D], number);
            for (axis, along) in frequency[..last].iter_mut().enumerate() {
                *along = (number % kept::<D>(half, axis)) as i64 + lowest::<D>(half, axis);
                number /= kept::<D>(half, axis);
            }
            let along = half[last] as i64;
            let sums = (-along..=along).map(|k| {
                frequency[last] = k;
                let factors = std::iter::zip(&smoothing, frequency).map(|(of, k)| of[k.unsigned_abs() as usize]);
                value(frequency, line[k.rem_euclid(side[last] as i64) as usize] / factors.product::<f64>())
            });
            sums.collect()
        });
        transformed.collect()
    })?;
    Ok(Coefficients { half, lines })
}

/// A slice of the grid transformed along one of its axes, those before it being so already; only frequencies that are kept.
fn across<const D: usize>(
    slice: Vec<Complex<f64>>,
    axis: usize,
    half: [usize; D],
    side: [usize; D],
    fft: &Arc<dyn Fft<f64>>,
) -> Vec<Complex<f64>> {
    let mut scratch = vec![Complex::default(); fft.get_inplace_scratch_len()];
    let (length, kept, lowest) = (side[axis], kept::<D>(half, axis), lowest::<D>(half, axis));
    let before = (0..axis).map(|axis| self::kept::<D>(half, axis)).product::<usize>();
    let mut transformed = vec![Complex::default(); slice.len() / length * kept];
    let mut lines = vec![Complex::default(); length * LINES.min(before)];
    for (rows, into) in slice.chunks(before * length).zip(transformed.chunks_mut(before * kept)) {
        for first in (0..before).step_by(LINES) {
            let count = LINES.min(before - first);
            let lines = &mut lines[..length * count];
            for (place, row) in rows.chunks(before).enumerate() {
                (0..count).for_each(|line| lines[line * length + place] = row[first + line]);
            }
            fft.process_with_scratch(lines, &mut scratch);
            for (k, row) in into.chunks_mut(before).enumerate() {
                let place = (k as i64 + lowest).rem_euclid(length as i64) as usize;
                (0..count).for_each(|line| row[first + line] = lines[line * length + place]);
            }
        }
    }
    transformed
}

/// The points sorted into slices of a periodic grid, across its last axis.
struct Grid<'a, const D: usize> {
    side: [usize; D],
    /// For each slice the points whose bump begins in it.
    slices: Vec<Vec<&'a Weighted<D>>>,
}

impl<'a, const D: usize> Grid<'a, D> {
    fn new(side: [usize; D], points: &'a [Weighted<D>]) -> Self {
        let mut slices = vec![Vec::new(); side[D - 1]];
        for point in points {
            slices[Bump::new(side[D - 1], point.turns[D - 1]).first].push(point);
        }
        Self { side, slices }
    }

    /// Slices of the grid, the first axis changing fastest, with the bumps of all points.
    fn slices(&self, range: std::ops::Range<usize>) -> Vec<Vec<Complex<f64>>> {
        let side = self.side[D - 1];
        let mut slices = vec![vec![Complex::default(); self.side[..D - 1].iter().product()]; range.len()];
        for start in range.start + side + 1 - WIDTH..range.end + side {
            for point in &self.slices[start % side] {
                let bumps: [_; D] = std::array::from_fn(|axis| Bump::new(self.side[axis], point.turns[axis]));
                for (value, slice) in bumps[D - 1].values.into_iter().zip(start..) {
                    // Only the last of these slices can be in the range where the bump begins before it.
                    if let Some(slice) = slice.checked_sub(range.start + side).and_then(|slice| slices.get_mut(slice)) {
                        self.add(&bumps[..D - 1], point.weight * value, slice);
                    }
                }
            }
        }
        slices
    }

    /// Adds a product of bumps along the first axes to a slice.
    fn add(&self, bumps: &[Bump], weight: f64, slice: &mut [Complex<f64>]) {
        match bumps {
            [] => slice[0].re += weight,
            [along] => along.add(weight, slice),
            [others @ .., last] => {
                let size = self.side[..others.len()].iter().product::<usize>();
                for (value, row) in last.values.into_iter().zip(last.first..) {
                    let start = row % self.side[others.len()] * size;
                    self.add(others, weight * value, &mut slice[start..start + size]);
                }
            }
        }
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
        [1, 2, 5, 30, 64].into_iter().for_each(|half| check([half, half], 46));
        [[0], [1], [2000]].into_iter().for_each(|half| check(half, 60));
        [[1, 1, 1], [2, 0, 5], [0, 9, 3], [12, 7, 14]].into_iter().for_each(|half| check(half, 30));
    }

    fn check<const D: usize>(half: [usize; D], count: usize) {
        let special = [
            [0.0; 3],
            [0.5, -0.5, 0.5],
            [0.25, 0.125, -0.5],
            [-0.5, 1e-17, 0.375],
            [3.7, -8.2, 5.1],
            [-1e-17, 0.499_999_999, -0.499_999_999],
        ];
        let mut rng = Rng::at(half[0] as u64, Draw::Probe, &[D as u64]);
        let mut place = |i: usize| special.get(i).copied().unwrap_or_else(|| [(); 3].map(|()| rng.unit() - 0.5));
        let places: Vec<[f64; 3]> = (0..count).map(&mut place).collect();
        let points: Vec<_> = places
            .iter()
            .map(|place| Weighted { turns: std::array::from_fn(|axis| place[axis]), weight: 0.1 + rng.unit() })
            .collect();
        let weight: f64 = points.iter().map(|point| point.weight).sum();
        let context = Context::new(2).unwrap();
        let waves = context.run(None, |job| transform(job, &points, half, |of, sum| (of, sum))).unwrap();
        let sizes = half.map(|half| 2 * half + 1);
        for mut number in 0..sizes.into_iter().product::<usize>() {
            let frequency: [i64; D] = std::array::from_fn(|axis| {
                let along = (number % sizes[axis]) as i64 - half[axis] as i64;
                number /= sizes[axis];
                along
            });
            let (of, found) = waves.at(frequency);
            assert!(of == frequency || of == frequency.map(|k| -k), "{of:?} for {frequency:?}");
            let sum = points.iter().fold([0.0; 2], |sum, point| {
                let cycles: f64 = std::iter::zip(of, point.turns).map(|(k, turns)| k as f64 * turns).sum();
                let (sin, cos) = (-2.0 * PI * cycles).sin_cos();
                [sum[0] + point.weight * cos, sum[1] + point.weight * sin]
            });
            let error = (found.re - sum[0]).hypot(found.im - sum[1]);
            assert!(error < 1e-10 * weight, "{half:?}: {error} at {frequency:?}");
        }
    }

    #[test]
    fn the_grid_has_four_points_for_the_highest_frequency_and_no_large_prime() {
        for half in [0, 1, 5, 6, 7, 100, 149, 1023] {
            let (plane, space) = (grid_side::<2>(half), grid_side::<3>(half));
            assert!(
                plane.is_power_of_two() && (4 * half).max(24) <= space && space <= plane,
                "{half}: {plane} {space}"
            );
            let rest = [2, 3, 5].into_iter().fold(space, |mut rest, prime| {
                while rest % prime == 0 {
                    rest /= prime;
                }
                rest
            });
            assert_eq!(rest, 1, "{half}: {space}");
        }
    }
}
