//! Forces in each level of vector instructions, the same to the bit. Those in stars are the portable code compiled for
//! AVX2, so that its loops over lanes become vectors. Those in cells, of which the compiler makes no good vectors, are
//! written in intrinsics.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::law::Constraints;
use crate::dcr::torus::TorusPoint;
use crate::dcr::uniform::cells::VerletCells;
use crate::dcr::uniform::stars::{Stars, Visitor};
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;

/// Gathers in the stars of a range of points and passes the results to `visitor`.
pub fn gather_in_stars(level: Level, stars: &Stars, points: Range<usize>, visitor: &mut impl Visitor) {
    match level {
        // SAFETY: both levels hold the proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { gather_in_stars_avx2(stars, points, visitor) },
        Level::Portable => stars.gather(points, visitor),
    }
}

/// The portable code, compiled for AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
fn gather_in_stars_avx2(stars: &Stars, points: Range<usize>, visitor: &mut impl Visitor) {
    stars.gather(points, visitor);
}

/// Adds the forces on a range of points by all others that conflict with them to `forces`.
pub fn gather_in_cells(
    level: Level,
    cells: &VerletCells,
    places: &[TorusPoint],
    constraints: &Constraints,
    points: Range<usize>,
    forces: &mut Vec<Vec2>,
) {
    match level {
        // SAFETY: both levels hold the proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe {
            gather_in_cells_avx2(cells, places, constraints, points, forces);
        },
        Level::Portable => {
            let force = |point| cells.force(places[point], constraints, cells.around(point));
            forces.extend(points.map(force));
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
fn gather_in_cells_avx2(
    cells: &VerletCells,
    places: &[TorusPoint],
    constraints: &Constraints,
    points: Range<usize>,
    forces: &mut Vec<Vec2>,
) {
    for point in points {
        forces.push(avx2::force(cells, places[point], constraints, cells.around(point)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::torus::Torus;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Against all pairs, on grids of many cells and of a few, before and after the points have moved a little.
    #[test]
    fn forces_in_cells_are_those_of_all_pairs() {
        let context = Context::new(1).unwrap();
        let constraints = Constraints { conflict_radius: 0.92, coverage_radius: f32::INFINITY, push: 0.4, pull: 0.2 };
        for (width, count, boundary) in [
            (1.0, 403, Boundary::Periodic),
            (40.0, 60, Boundary::Periodic),
            (1.0, 9, Boundary::Periodic),
            (2.0, 90, Boundary::Bounded),
        ] {
            let torus = Torus::new(Domain { min: [0.0; 2], max: [width, 1.0], boundary }, count);
            let mut rng = Rng::at(6, Draw::Probe, &[]);
            let points: Vec<_> = (0..count).map(|_| [rng.unit() * width, rng.unit()].map(|x| x as f32)).collect();
            let mut places = torus.with_images(&torus.enter(&points, 0));
            let mut cells = VerletCells::new(&torus, &places, 0.92);
            for distance in [0.0, 0.04, 0.05] {
                for place in &mut places[..count] {
                    *place = torus.moved(*place, Vec2::from_angle(rng.unit() as f32 * 6.3) * distance);
                }
                context.run(None, |job| torus.mirror(job, &mut places, count)).unwrap();
                assert!(cells.still_serve(distance, 0.92));
                context.run(None, |job| cells.update(job, &places)).unwrap();
                let mut portable = None;
                for level in Level::available() {
                    let mut forces = Vec::new();
                    gather_in_cells(level, &cells, &places, &constraints, 0..count, &mut forces);
                    for (&place, force) in places.iter().zip(&forces) {
                        let offsets = places.iter().map(|&other| torus.offset_f32(place, other));
                        let expected: Vec2 =
                            offsets.map(|offset| constraints.push(offset, offset.length_squared())).sum();
                        assert!(force.distance(expected) < 1e-5, "{level:?}: {force}, not {expected}");
                    }
                    assert_eq!(&forces, portable.get_or_insert_with(|| forces.clone()), "{level:?}");
                }
            }
            assert!(!cells.still_serve(0.03, 0.92));
        }
    }
}
