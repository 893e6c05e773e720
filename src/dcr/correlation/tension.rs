//! The forces by which a set gets the pair correlation that is wanted: a potential of pairs, made anew in every step from
//! the pairs that were counted.
//!
//! Thesis eq. 4.3 and 4.4, after Heck et al. 2013, sum for each point the excess of others up to a distance,
//! `f(r) = ∫ (g - g_t)`, along the directions to its neighbours. In the plane that excess is a Hankel transform of the
//! excess of power, `f(r) = ∫ (P - P_t)(ν) J1(2π ν r) dν`, with lengths in mean spacings: the displacement that removes
//! each wave in proportion to its excess, as `torus/waves.rs` removes long ones. As a sum over waves it can be weighted:
//! here each wave by one over the power that it has and should have. Otherwise those that should vanish do so ever more
//! slowly, by the square of what is left.
//!
//! Correlations are matched up to a reach only, towards which they fade out: the power is matched as smoothed over
//! about 1 / reach.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use crate::math::{cos, j0, j1};

/// The width of rings of distances, in mean spacings, and the entries of the table of forces in each: odd, so that every
/// ring has one in its middle.
const RING: f64 = 0.05;
const FINE: usize = 3;

/// The most rings.
pub const MOST_RINGS: usize = 320;

/// The length of the table of forces: a power of two, so that a mask makes an index of any number.
pub const TABLE: usize = 1024;

/// The distances in a ring at which a target is evaluated.
const SAMPLES: usize = 8;

/// The frequencies that are matched, in units of sqrt(density): the middles of bins of this width.
const FREQUENCIES: usize = 100;
const FREQUENCY_WIDTH: f64 = 0.02;

/// The share of the reach from which on correlations fade out.
const FADING: f64 = 0.5;

/// The share of the excess of a wave that a step removes, to first order, at the first step and from the last of
/// [`SETTLING`] on: waves change each other, and with all of it sets do not come to rest.
const SHARE: Range<f64> = 0.1..1.0;

/// The steps over which shares fall.
const SETTLING: u32 = 50;

/// The least sum of powers by which the excess of a wave is divided.
const LEAST_POWER: f64 = 0.15;

/// The forces of pairs, by their distance: entry `k` is the displacement by a point at the distance of `k` steps, over
/// its offset.
pub type Table = [f32; TABLE];

/// The pairs by their distance, both ends counted, in the steps of a [`Table`].
pub type Counts = [u32; TABLE];

/// The transforms between distances and frequencies, and the correlation that is wanted.
pub struct Tension {
    /// The width of a ring, in mean spacings.
    ring: f64,
    rings: usize,
    /// The transform of rings to frequencies, frequency by frequency, and that of frequencies to forces, ring by ring.
    to_power: Vec<f64>,
    to_force: Vec<f64>,
    /// The correlation in each ring, and the power at each frequency, smoothed as what is counted.
    correlation: Vec<f64>,
    power: Vec<f64>,
}

impl Tension {
    /// For a correlation as a function of the distance, up to a reach, both in mean spacings.
    pub fn new(reach: f64, correlation: impl Fn(f64) -> f64) -> Self {
        let rings = ((reach / RING).ceil() as usize).clamp(1, MOST_RINGS);
        // The first ring is a disk of half its width.
        let ring = reach / (rings as f64 - 0.5);
        let distance = |k: usize| k as f64 * ring;
        let fading = |k: usize| {
            let t = (distance(k) / reach - FADING) / (1.0 - FADING);
            if t <= 0.0 { 1.0 } else { 0.5 + 0.5 * cos(PI * t) }
        };
        let weights: Vec<f64> = (0..rings).map(|k| fading(k) * area(ring, k)).collect();
        let transform =
            |frequency: f64| (0..rings).map(|k| weights[k] * j0(TAU * frequency * distance(k))).collect::<Vec<_>>();
        let to_power: Vec<f64> = (0..FREQUENCIES).flat_map(|m| transform(frequency(m))).collect();
        let force = |k: usize| {
            let at = move |m: usize| match k {
                0 => PI * frequency(m),
                _ => j1(TAU * frequency(m) * distance(k)) / distance(k),
            };
            (0..FREQUENCIES).map(move |m| fading(k) * FREQUENCY_WIDTH * at(m)).collect::<Vec<_>>()
        };
        let to_force = (0..rings).flat_map(force).collect();
        let correlation: Vec<f64> = (0..rings).map(|k| mean_over_ring(ring, k, &correlation)).collect();
        let excess: Vec<f64> = correlation.iter().map(|value| value - 1.0).collect();
        let power = products(&to_power, &excess).map(|excess| 1.0 + excess).collect();
        Self { ring, rings, to_power, to_force, correlation, power }
    }

    /// The steps of a table per mean spacing.
    pub fn per_spacing(&self) -> f64 {
        FINE as f64 / self.ring
    }

    /// The first entry of a table that is beyond all rings.
    pub fn beyond(&self) -> usize {
        FINE * self.rings - 1
    }

    /// The excess of the power of `points` over that wanted, at each frequency; points are not counted as pairs with
    /// themselves.
    pub fn excess(&self, counts: &[u64], points: usize) -> Vec<f64> {
        let found = |k: usize| counts[(FINE * k).saturating_sub(FINE / 2)..=FINE * k + FINE / 2].iter().sum::<u64>();
        let of_ring = |k: usize| found(k) as f64 / (points as f64 * area(self.ring, k)) - self.correlation[k];
        let excess: Vec<f64> = (0..self.rings).map(of_ring).collect();
        products(&self.to_power, &excess).collect()
    }

    /// The forces of a step that remove an excess.
    pub fn table(&self, excess: &[f64], iteration: u32) -> Table {
        let left = 1.0 - f64::from(iteration.min(SETTLING)) / f64::from(SETTLING);
        let share = SHARE.start + (SHARE.end - SHARE.start) * left;
        let weighted = |(excess, wanted): (&f64, &f64)| {
            let powers = (wanted + excess).max(0.0) + wanted.max(0.0);
            share * excess / powers.max(LEAST_POWER)
        };
        let waves: Vec<f64> = excess.iter().zip(&self.power).map(weighted).collect();
        let mut nodes: Vec<f64> = products(&self.to_force, &waves).collect();
        nodes.push(0.0);
        let mut table = [0.0; TABLE];
        for (k, entry) in table[..self.beyond()].iter_mut().enumerate() {
            let (node, share) = (k / FINE, (k % FINE) as f64 / FINE as f64);
            *entry = (nodes[node] * (1.0 - share) + nodes[node + 1] * share) as f32;
        }
        table
    }
}

/// The root mean square of an excess.
pub fn residual(excess: &[f64]) -> f64 {
    (excess.iter().map(|excess| excess * excess).sum::<f64>() / excess.len() as f64).sqrt()
}

/// The middle of a bin of frequencies.
fn frequency(bin: usize) -> f64 {
    (bin as f64 + 0.5) * FREQUENCY_WIDTH
}

/// The area of the ring about `k` times the width.
fn area(ring: f64, k: usize) -> f64 {
    match k {
        0 => 0.25 * PI * ring * ring,
        _ => TAU * k as f64 * ring * ring,
    }
}

/// The mean of a function of the distance over the ring about `k` times the width: measured correlations have noise from
/// bin to bin, which single distances would take for waves.
fn mean_over_ring(ring: f64, k: usize, function: impl Fn(f64) -> f64) -> f64 {
    let (from, to) = ((k as f64 - 0.5).max(0.0), k as f64 + 0.5);
    let distance = |i: usize| ring * (from + (to - from) * (i as f64 + 0.5) / SAMPLES as f64);
    let sums = (0..SAMPLES).map(distance).map(|r| [r, r * function(r)]);
    let [weights, values] = sums.fold([0.0; 2], |sums, of| [sums[0] + of[0], sums[1] + of[1]]);
    values / weights
}

/// The product of each row of a matrix and a vector.
fn products(matrix: &[f64], vector: &[f64]) -> impl Iterator<Item = f64> {
    // Eight sums, of which the compiler makes vectors.
    matrix.chunks_exact(vector.len()).map(|row| {
        let mut sums = [0.0; 8];
        let (rows, vectors) = (row.chunks_exact(8), vector.chunks_exact(8));
        let rest: f64 = rows.remainder().iter().zip(vectors.remainder()).map(|(a, b)| a * b).sum();
        for (row, vector) in rows.zip(vectors) {
            (0..8).for_each(|i| sums[i] += row[i] * vector[i]);
        }
        rest + sums.iter().sum::<f64>()
    })
}
