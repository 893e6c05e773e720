//! Elementary functions with the same bits on every processor and system: those of the crate `libm`, a port of musl's.
//!
//! The platform's own differ between libraries, their versions, and processors with and without fused multiplication; so
//! do sets that are made with them. Clippy refuses these in the library (`clippy.toml`). Square roots and the four
//! operations are exact to the last bit everywhere.

use std::ops::Mul;

use glam::DVec2;

pub(crate) use libm::{acos, atan2, cos, exp, exp2, hypot, j0, log, log2, pow, scalbn, sin, sincos};

/// The unit vector at an angle to the first axis.
pub(crate) fn direction(angle: f64) -> DVec2 {
    let (sin, cos) = sincos(angle);
    DVec2::new(cos, sin)
}

/// A power by repeated multiplication, from the highest bit of the exponent on.
pub(crate) fn power(x: f64, exponent: u32) -> f64 {
    let bits = (0..u32::BITS - exponent.leading_zeros()).rev();
    bits.fold(1.0, |power, bit| power * power * if exponent >> bit & 1 == 1 { x } else { 1.0 })
}

/// The square.
pub(crate) fn square<T: Copy + Mul<Output = T>>(x: T) -> T {
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_products() {
        assert_eq!((power(3.0, 0), power(3.0, 1), power(3.0, 5), power(0.5, 40)), (1.0, 3.0, 243.0, 0.5f64.powi(40)));
        assert_eq!((power(0.0, 0), power(-2.0, 3), power(1.5, 7)), (1.0, -8.0, 17.0859375));
    }

    #[test]
    fn directions_are_unit_vectors() {
        for i in 0..1000 {
            let angle = 0.1 * f64::from(i) - 50.0;
            let direction = direction(angle);
            assert!((direction.length() - 1.0).abs() < 1e-15 && (direction.y - sin(angle)).abs() < 1e-15);
            assert!((atan2(direction.y, direction.x) - angle).rem_euclid(std::f64::consts::TAU).sin().abs() < 1e-13);
        }
    }
}
