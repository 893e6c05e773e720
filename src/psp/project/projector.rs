//! Projectors: three orthogonal planes that carry the pattern, rotated at random from iteration to iteration (thesis
//! §3.3.1 and §3.3.3).

use glam::{DMat3, DQuat, DVec3};

use crate::math::sincos;
use crate::rng::{Draw, Rng};

/// The cosine above which two axes of successive iterations are too near each other: 20 degrees.
const NEAREST_AXES: f64 = 0.94;

/// Three orthogonal directions.
pub type Frame = DMat3;

/// A plane through the centre of the mesh that carries the pattern along its normal.
pub struct Projector {
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    /// The shift of the pattern on the torus, as a share of its side.
    shift: [f64; 2],
}

impl Projector {
    /// The three projectors of an iteration.
    pub fn all(frame: DMat3, seed: u64, iteration: u32) -> [Self; 3] {
        [0, 1, 2].map(|axis| {
            let [right, up, forward] = [1, 2, 0].map(|step| frame.col((axis + step) % 3));
            let mut rng = Rng::at(seed, Draw::Shift, &[iteration.into(), axis as u64]);
            Self { right, up, forward, shift: [rng.unit(), rng.unit()] }
        })
    }

    /// The position of the corner of a pattern with this side.
    pub fn shift(&self, side: f64) -> [f64; 2] {
        self.shift.map(|share| share * side)
    }
}

/// The frame of an iteration: a uniformly random rotation none of whose axes is near one of the frame before. Near
/// projectors find little that is new (thesis §3.3.3).
pub fn frame(seed: u64, iteration: u32, previous: Option<DMat3>) -> DMat3 {
    let mut attempt = 0;
    loop {
        let frame = rotation(Rng::at(seed, Draw::Rotation, &[iteration.into(), attempt]));
        let near = |other: DMat3| (other.transpose() * frame).to_cols_array().iter().any(|x| x.abs() > NEAREST_AXES);
        if !previous.is_some_and(near) {
            return frame;
        }
        attempt += 1;
    }
}

/// A uniformly random rotation: a uniformly random unit quaternion (Shoemake 1992).
fn rotation(mut rng: Rng) -> DMat3 {
    let share = rng.unit();
    let (sin1, cos1) = sincos(std::f64::consts::TAU * rng.unit());
    let (sin2, cos2) = sincos(std::f64::consts::TAU * rng.unit());
    let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
    DMat3::from_quat(DQuat::from_xyzw(a * sin1, a * cos1, b * sin2, b * cos2).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_random_and_apart_from_the_one_before() {
        let mut previous = None;
        let mut mean = DVec3::ZERO;
        for iteration in 0..2000 {
            let frame = frame(3, iteration, previous);
            assert!((frame * frame.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-12));
            if let Some(previous) = previous {
                let cosines = DMat3::transpose(&previous) * frame;
                assert!(cosines.to_cols_array().iter().all(|x| x.abs() <= NEAREST_AXES));
            }
            mean += frame.x_axis / 2000.0;
            previous = Some(frame);
        }
        assert!(mean.length() < 0.05, "{mean}");
    }
}
