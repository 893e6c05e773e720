//! The integrands of pixels: functions whose mean over each pixel is known.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::reference::stream;

/// A function on the image. All but the plate are another one in each pixel.
#[derive(Clone, Copy, PartialEq)]
pub enum Integrand {
    /// sin(x² + y²), whose frequency grows from 0 in a corner to one wave per pixel on the far sides.
    Plate,
    /// 1 on one side of a straight line through the pixel, 0 on the other.
    Edge,
    /// From 1 to 0 evenly over half a pixel across such a line: a penumbra.
    Shadow,
    /// Linear, with a slope of 1 per pixel.
    Gradient,
}

pub const INTEGRANDS: [Integrand; 4] = [Integrand::Plate, Integrand::Edge, Integrand::Shadow, Integrand::Gradient];

impl Integrand {
    pub fn name(self) -> &'static str {
        match self {
            Self::Plate => "zone plate",
            Self::Edge => "edge",
            Self::Shadow => "soft shadow",
            Self::Gradient => "gradient",
        }
    }
}

/// The width of the penumbra, in pixels.
const WIDTH: f64 = 0.5;

/// The pixels of a square image, each with a direction of its own between the axes, and a place in [0, 1) for its line.
pub struct Pixels {
    side: usize,
    lines: Vec<([f64; 2], f64)>,
}

impl Pixels {
    pub fn new(side: usize, seed: u64) -> Self {
        let mut unit = stream(!seed);
        let mut line = || {
            // Off the axes, along which the exact value would be a quotient of zeros.
            let (sin, cos) = (FRAC_PI_2 * (0.001 + 0.998 * f64::from(unit()))).sin_cos();
            ([cos, sin], f64::from(unit()))
        };
        Self { side, lines: (0..side * side).map(|_| line()).collect() }
    }

    /// The phase of the plate at a distance of 1 pixel from its corner.
    fn chirp(&self) -> f64 {
        PI / self.side as f64
    }

    /// The value at a position from a pixel's lower left corner.
    fn value(&self, integrand: Integrand, pixel: usize, [x, y]: [f64; 2]) -> f64 {
        let ([a, b], place) = self.lines[pixel];
        let along = a * x + b * y;
        match integrand {
            Integrand::Plate => {
                let [x, y] = [x + (pixel % self.side) as f64, y + (pixel / self.side) as f64];
                (self.chirp() * (x * x + y * y)).sin()
            }
            Integrand::Edge => f64::from(u8::from(along < place * (a + b))),
            Integrand::Shadow => ((place * (a + b + WIDTH) - along) / WIDTH).clamp(0.0, 1.0),
            Integrand::Gradient => along,
        }
    }

    /// The mean over a pixel.
    fn exact(&self, integrand: Integrand, pixel: usize) -> f64 {
        let ([a, b], place) = self.lines[pixel];
        match integrand {
            Integrand::Plate => {
                let [[x, y], [u, v]] = [pixel % self.side, pixel / self.side].map(|first| self.wave(first as f64));
                x * v + y * u
            }
            Integrand::Edge => below(&[a, b], place * (a + b)),
            Integrand::Shadow => below(&[a, b, WIDTH], place * (a + b + WIDTH)),
            Integrand::Gradient => (a + b) / 2.0,
        }
    }

    /// The mean of exp(i chirp x²) from a number to the next, by Simpson's rule.
    fn wave(&self, first: f64) -> [f64; 2] {
        const PARTS: u32 = 256;
        (0..=PARTS).fold([0.0; 2], |[real, imaginary], i| {
            let weight = f64::from(if i == 0 || i == PARTS { 1 } else { 2 + 2 * (i % 2) }) / f64::from(3 * PARTS);
            let (sin, cos) = (self.chirp() * (first + f64::from(i) / f64::from(PARTS)).powi(2)).sin_cos();
            [real + weight * cos, imaginary + weight * sin]
        })
    }

    /// The root mean square over all pixels of what the mean of the samples of each differs from the exact mean.
    pub fn error(&self, integrand: Integrand, samples: &[Vec<[f64; 2]>]) -> f64 {
        let squared = |(pixel, samples): (usize, &Vec<[f64; 2]>)| {
            let sum: f64 = samples.iter().map(|&at| self.value(integrand, pixel, at)).sum();
            (sum / samples.len() as f64 - self.exact(integrand, pixel)).powi(2)
        };
        (samples.iter().enumerate().map(squared).sum::<f64>() / samples.len() as f64).sqrt()
    }
}

/// The part of the unit cube in which the scalar product with a vector is below a number, by the corners that are.
fn below(vector: &[f64], limit: f64) -> f64 {
    let n = vector.len();
    let corners = (0u32..1 << n).map(|corner| {
        let left = (0..n).filter(|axis| corner >> axis & 1 == 1).fold(limit, |left, axis| left - vector[axis]);
        let sign = if corner.count_ones() % 2 == 0 { 1.0 } else { -1.0 };
        sign * left.max(0.0).powi(n as i32)
    });
    corners.sum::<f64>() / vector.iter().zip(1..).map(|(length, k)| length * f64::from(k)).product::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fine_lattice_gives_the_exact_means() {
        let place = |i: usize| (i as f64 + 0.5) / 300.0;
        let lattice: Vec<_> = (0..90_000).map(|i| [place(i % 300), place(i / 300)]).collect();
        let (pixels, samples) = (Pixels::new(6, 4), vec![lattice; 36]);
        for integrand in INTEGRANDS {
            let error = pixels.error(integrand, &samples);
            let most = if integrand == Integrand::Edge { 1e-3 } else { 1e-5 };
            assert!(error < most, "{}: {error}", integrand.name());
        }
    }

    #[test]
    fn a_sample_in_the_middle_errs_by_what_it_does_not_see() {
        let (pixels, samples) = (Pixels::new(16, 4), vec![vec![[0.5; 2]]; 256]);
        let errors = INTEGRANDS.map(|integrand| pixels.error(integrand, &samples));
        assert!(errors[0] > 0.2 && errors[1] > 0.1 && errors[2] > 0.02 && errors[3] < 1e-12, "{errors:?}");
    }
}
