//! The circle through the corners of a triangle, one of which is the origin: `a` and `b` are the other two.

use glam::{DVec2, Vec2};

use crate::math::square;

/// The centre.
pub fn circumcentre(a: DVec2, b: DVec2) -> DVec2 {
    (b.length_squared() * a.perp() - a.length_squared() * b.perp()) / (2.0 * a.perp_dot(b))
}

/// The centre in single precision, times `2 a × b`: the caller divides, as the triangle may have no area.
#[inline(always)]
pub fn scaled_circumcentre(a: Vec2, b: Vec2) -> Vec2 {
    b.length_squared() * a.perp() - a.length_squared() * b.perp()
}

/// The square of the radius, of the triangle with the edges `a`, `b` and `a - b`: the product of the edges over four
/// times the area.
pub fn circumradius_squared(a: DVec2, b: DVec2, opposite: DVec2) -> f64 {
    let edges = a.length_squared() * b.length_squared() * opposite.length_squared();
    edges / (4.0 * square(a.perp_dot(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_corners_are_as_far_from_the_centre_as_the_radius_says() {
        for (a, b) in [(DVec2::X, DVec2::Y), (DVec2::new(3.0, -1.0), DVec2::new(0.5, 2.0)), (DVec2::Y, DVec2::X)] {
            let centre = circumcentre(a, b);
            let radius = circumradius_squared(a, b, a - b).sqrt();
            for corner in [DVec2::ZERO, a, b] {
                assert!((corner.distance(centre) - radius).abs() < 1e-12);
            }
            let scaled = scaled_circumcentre(a.as_vec2(), b.as_vec2()).as_dvec2() / (2.0 * a.perp_dot(b));
            assert!(scaled.distance(centre) < 1e-6);
        }
    }
}
