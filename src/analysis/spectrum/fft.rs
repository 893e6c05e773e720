//! The fast Fourier transform of a power of two of complex numbers (Stockham's order, which needs no bit reversal).

use std::f64::consts::PI;

/// A complex number: its real and its imaginary part.
pub(super) type Complex = [f64; 2];

pub(super) fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

/// Transforms of one length.
pub(super) struct Fft {
    /// exp(-2πi k/n) for k below n/2.
    roots: Vec<Complex>,
}

impl Fft {
    /// Transforms of `n` numbers; `n` is a power of two.
    pub fn new(n: usize) -> Self {
        let root = |k| {
            let (sin, cos) = (-2.0 * PI * k as f64 / n as f64).sin_cos();
            [cos, sin]
        };
        Self { roots: (0..n / 2).map(root).collect() }
    }

    /// Replaces `data` by its transform: the sums of data[j] exp(-2πi jk/n). `scratch` is as long, and overwritten.
    pub fn run(&self, data: &mut Vec<Complex>, scratch: &mut Vec<Complex>) {
        let mut stride = 1;
        while stride < data.len() {
            self.pass(data, scratch, stride);
            std::mem::swap(data, scratch);
            stride *= 2;
        }
    }

    /// One halving of all transforms, `stride` of which lie interleaved.
    fn pass(&self, from: &[Complex], to: &mut [Complex], stride: usize) {
        let (low, high) = from.split_at(from.len() / 2);
        let pairs = low.chunks_exact(stride).zip(high.chunks_exact(stride));
        for ((p, (low, high)), to) in pairs.enumerate().zip(to.chunks_exact_mut(2 * stride)) {
            let root = self.roots[p * stride];
            let (sums, differences) = to.split_at_mut(stride);
            for (((&[a, b], &[c, d]), sum), difference) in low.iter().zip(high).zip(sums).zip(differences) {
                *sum = [a + c, b + d];
                *difference = times([a - c, b - d], root);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn agrees_with_the_definition() {
        for n in [1, 2, 4, 64, 128] {
            let mut rng = Rng::at(n as u64, Draw::Probe, &[]);
            let data: Vec<Complex> = (0..n).map(|_| [rng.unit() - 0.5, rng.unit() - 0.5]).collect();
            let (mut transformed, mut scratch) = (data.clone(), data.clone());
            Fft::new(n).run(&mut transformed, &mut scratch);
            for (k, &found) in transformed.iter().enumerate() {
                let mut sum = [0.0; 2];
                for (j, &value) in data.iter().enumerate() {
                    let (sin, cos) = (-2.0 * PI * (j * k % n) as f64 / n as f64).sin_cos();
                    let term = times(value, [cos, sin]);
                    sum = [sum[0] + term[0], sum[1] + term[1]];
                }
                assert!((0..2).all(|part| (sum[part] - found[part]).abs() < 1e-13 * n as f64), "{n}, {k}");
            }
        }
    }
}
