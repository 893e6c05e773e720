//! Positions and barycentrics between `f32` and `f64`.

use glam::DVec3;

/// A position in `f64`.
pub(crate) fn exact(position: [f32; 3]) -> DVec3 {
    let [x, y, z] = position;
    DVec3::new(x.into(), y.into(), z.into())
}

/// A point of a triangle, before it is rounded.
pub(crate) fn exact_point(corners: &[[f32; 3]; 3], [u, v]: [f64; 2]) -> DVec3 {
    let [a, b, c] = corners;
    (1.0 - u - v) * exact(*a) + u * exact(*b) + v * exact(*c)
}

/// The largest float below a positive one.
pub(crate) fn next_below(x: f32) -> f32 {
    f32::from_bits(x.to_bits() - 1)
}

/// Barycentrics rounded to floats that name a point of the triangle: not negative, and their sum (in `f64`) not above 1.
pub(crate) fn round_barycentrics([u, v]: [f64; 2]) -> [f32; 2] {
    let [mut u, mut v] = [u, v].map(|x| x.clamp(0.0, 1.0) as f32);
    let (larger, smaller) = if u > v { (&mut u, v) } else { (&mut v, u) };
    if f64::from(*larger) + f64::from(smaller) > 1.0 {
        let rest = 1.0 - f64::from(smaller);
        *larger = rest as f32;
        if f64::from(*larger) > rest {
            *larger = next_below(*larger);
        }
    }
    [u, v]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn rounded_barycentrics_stay_on_the_triangle_and_move_by_a_rounding() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let edge = (0..1000).map(|_| rng.unit()).map(|u| [u, 1.0 - u]).collect::<Vec<_>>();
        for [u, v] in edge.into_iter().chain([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [1.0 / 3.0, 2.0 / 3.0]]) {
            let rounded = round_barycentrics([u, v]).map(f64::from);
            assert!(rounded[0] >= 0.0 && rounded[1] >= 0.0 && rounded[0] + rounded[1] <= 1.0);
            assert!((rounded[0] - u).abs() <= 6e-8 && (rounded[1] - v).abs() <= 6e-8, "{u} {v}");
        }
        assert_eq!(round_barycentrics([-1e-9, 1.0 + 1e-7]), [0.0, 1.0]);
        assert_eq!(round_barycentrics([0.7, 0.7]).map(|x| x as f64).iter().sum::<f64>(), 1.0);
    }
}
