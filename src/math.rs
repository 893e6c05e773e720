//! Elementary functions with the same bits on every processor and system: those of the crate `libm`, a port of musl's.
//!
//! The platform's own differ between libraries, their versions, and processors with and without fused multiplication;
//! so do sets that are made with them. Clippy refuses these in the library (`clippy.toml`). Square roots and the four
//! operations are exact to the last bit everywhere.

use std::ops::Mul;

use glam::DVec2;

pub(crate) use libm::{acos, atan2, cbrt, cos, erfc, exp, exp2, hypot, j0, j1, log, log2, pow, scalbn, sin, sincos};

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

/// The side of a square, if `D` is 2, or of a cube of this content.
pub(crate) fn side<const D: usize>(content: f64) -> f64 {
    [|x| x, f64::sqrt, cbrt][D - 1](content)
}

/// The squared distance of two points in space, in `f64`.
pub(crate) fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|axis| square(a[axis] as f64 - b[axis] as f64)).sum()
}

/// The largest float that is not above a number.
pub(crate) fn rounded_down(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The smallest float that is not below a number: infinity beyond all.
pub(crate) fn rounded_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x { nearest.next_up() } else { nearest }
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
    fn floats_are_rounded_one_way() {
        assert_eq!((rounded_down(0.25), rounded_up(0.25)), (0.25, 0.25));
        for x in [0.0, 0.1, 1.0 + 1e-9, 3e38, 1e300, 1e-44, -1e-60, -0.1, f64::from(f32::MAX), f64::INFINITY] {
            let (down, up) = (rounded_down(x), rounded_up(x));
            assert!(f64::from(down) <= x && (f64::from(down.next_up()) > x || down >= f32::MAX), "{x}");
            assert!(f64::from(up) >= x && f64::from(up.next_down()) < x, "{x}");
        }
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
