//! The zone plate sin(x² + y²), sampled and filtered (thesis fig. 2.12, third row).
//!
//! Its origin is the lower left corner of a square picture, and its frequency grows evenly from there: along the far
//! sides to one wave per pixel. It is seen through a Gaussian of half a pixel. What that filter leaves of the plate is
//! known exactly: the mean of exp(iu²) over a Gaussian of the deviation s around x is
//! (1 - 2is²)^(-1/2) exp(ix² / (1 - 2is²)), and the plate's is the imaginary part of the product of two of those.

use std::f64::consts::PI;

/// The frequency on the far sides, in waves per pixel; and the highest that a picture can show.
const HIGHEST: f64 = 1.0;
const NYQUIST: f64 = 0.5;

/// The standard deviation of the filter, and where it is cut off, in pixels.
const DEVIATION: f64 = 0.5;
const REACH: f64 = 2.0;

/// The length of a pixel in the plate's own units.
fn pixel(side: usize) -> f64 {
    // The wave number is 2x, so the far sides, at x = side · pixel, have x · pixel / π waves per pixel.
    (PI * HIGHEST / side as f64).sqrt()
}

/// The middle of the pixels in a column, or in a row from the bottom, in pixels.
fn middle(i: usize) -> f64 {
    i as f64 + 0.5
}

/// The picture that the plate should give, of `side` pixels per side, row by row from the bottom.
pub fn reference(side: usize) -> Vec<f64> {
    let variance = (DEVIATION * pixel(side)).powi(2);
    let shrink = 1.0 + 4.0 * variance * variance;
    let value = |i: usize| {
        let squared = (middle(i % side).powi(2) + middle(i / side).powi(2)) * pixel(side).powi(2);
        let (phase, amplitude) = (squared / shrink, (-2.0 * variance * squared / shrink).exp());
        // The imaginary part of amplitude · exp(i phase) / (1 - 2i variance).
        amplitude * (phase.sin() + 2.0 * variance * phase.cos()) / shrink
    };
    (0..side * side).map(value).collect()
}

/// The picture that points of the unit torus make of the plate: at each pixel the mean of the samples near it, weighted
/// by the filter. Beyond the picture's edge the torus is repeated, the plate goes on.
pub fn sampled(points: &[[f32; 2]], side: usize) -> Vec<f64> {
    let (length, margin) = (side as f64, REACH + 1.0);
    let (mut sums, mut weights) = (vec![0.0; side * side], vec![0.0; side * side]);
    for shift in (0..9).map(|i| [(i % 3) as f64 - 1.0, (i / 3) as f64 - 1.0]) {
        let image = |point: &[f32; 2]| [0, 1].map(|axis| (f64::from(point[axis]) + shift[axis]) * length);
        let inside = |place: &[f64; 2]| place.iter().all(|x| (-margin..length + margin).contains(x));
        for [x, y] in points.iter().map(image).filter(inside) {
            let value = ((x * x + y * y) * pixel(side).powi(2)).sin();
            for (row, column) in near(y, side).flat_map(|row| near(x, side).map(move |column| (row, column))) {
                let squared = (middle(column) - x).powi(2) + (middle(row) - y).powi(2);
                if squared < REACH * REACH {
                    let weight = (-squared / (2.0 * DEVIATION * DEVIATION)).exp();
                    sums[row * side + column] += weight * value;
                    weights[row * side + column] += weight;
                }
            }
        }
    }
    std::iter::zip(sums, weights).map(|(sum, weight)| if weight > 0.0 { sum / weight } else { 0.0 }).collect()
}

/// The pixels that a sample may count for, along an axis.
fn near(x: f64, side: usize) -> std::ops::Range<usize> {
    let clamp = |place: f64| place.clamp(0.0, side as f64) as usize;
    clamp((x - REACH - 0.5).ceil())..clamp((x + REACH + 0.5).floor())
}

/// The difference of a picture from the [`reference()`]: root mean squares over pixels, in units of the plate's
/// amplitude.
#[derive(Clone, Copy)]
pub struct Errors {
    /// The part of the plate with frequencies that a picture can show, along both axes together.
    pub low: f64,
    /// The part with others: what is not grey there is aliasing.
    pub high: f64,
}

impl Errors {
    pub fn of(plate: &[f64], side: usize) -> Self {
        let limit = NYQUIST / HIGHEST * side as f64;
        let [mut low, mut high] = [(0.0, 0.0); 2];
        for (i, (value, expected)) in std::iter::zip(plate, reference(side)).enumerate() {
            let is_low = middle(i % side).hypot(middle(i / side)) < limit;
            let (squares, count) = if is_low { &mut low } else { &mut high };
            *squares += (value - expected).powi(2);
            *count += 1.0;
        }
        let [low, high] = [low, high].map(|(squares, count): (f64, f64)| (squares / count).sqrt());
        Self { low, high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples on a lattice so fine that their mean is the integral.
    fn lattice(per_side: usize) -> Vec<[f32; 2]> {
        let place = |i: usize| (i as f32 + 0.5) / per_side as f32;
        (0..per_side * per_side).map(|i| [place(i % per_side), place(i / per_side)]).collect()
    }

    #[test]
    fn many_samples_give_the_reference() {
        let side = 24;
        let plate = sampled(&lattice(24 * 24), side);
        let worst = std::iter::zip(&plate, reference(side)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The tail beyond four deviations has exp(-8) of the weight.
        assert!(worst < 4e-4, "{worst}");
        let errors = Errors::of(&plate, side);
        assert!(errors.low < 2e-4 && errors.high < 2e-4);
    }

    #[test]
    fn a_picture_of_grey_errs_by_what_there_is_to_see() {
        let side = 128;
        let errors = Errors::of(&vec![0.0; side * side], side);
        assert!((0.3..0.7).contains(&errors.low), "{}", errors.low);
        assert!(errors.high < 0.1, "{}", errors.high);
    }

    #[test]
    fn a_lattice_of_a_sample_per_pixel_shows_rings_that_are_not_there() {
        let side = 64;
        let errors = Errors::of(&sampled(&lattice(side), side), side);
        assert!(errors.high > 0.4, "{}", errors.high);
    }
}
