//! Windows of a plane, and what they owe.

use azulejo::Domain;

use crate::common::sets::Random;

/// The corners of a window.
pub type Rect = ([f64; 2], [f64; 2]);

/// The promise of a window: the part of the whole that lies in it.
pub fn part_of(whole: &[[f32; 2]], (min, max): Rect) -> Vec<[f32; 2]> {
    let inside = |sample: &[f32; 2]| {
        (0..2).all(|axis| min[axis] <= f64::from(sample[axis]) && f64::from(sample[axis]) < max[axis])
    };
    whole.iter().copied().filter(inside).collect()
}

/// Any number between two.
pub fn between(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * f64::from(random.unit())
}

/// A window of a domain; each side anything from the whole side to a thousandth of it, less than a radius.
pub fn random_window(random: &mut Random, domain: &Domain) -> Rect {
    let mut rect = (domain.min, domain.max);
    for axis in 0..2 {
        let side = domain.extent()[axis] * 10f64.powf(between(random, -3.0, 0.0));
        rect.0[axis] = between(random, domain.min[axis], domain.max[axis] - side);
        rect.1[axis] = (rect.0[axis] + side).min(domain.max[axis]);
    }
    rect
}
