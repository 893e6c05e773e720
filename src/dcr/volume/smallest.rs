//! The smallest distance between two points of a cuboid, around the torus if it is one.

use crate::error::Result;
use crate::index::{Grid3, smallest_distance as smallest_in_space};
use crate::job::{Job, chunks};
use crate::math::square;
use crate::points::{Boundary, Domain};

/// The smallest distance, in `f64` from the floats; infinite for fewer than two points.
///
/// Pairs that are nearer across a seam than any two points in space are among those next to a face: no two of these are closer
/// than that bound, so that few are near each other.
pub fn smallest_distance(job: &Job, domain: &Domain<3>, points: &[[f32; 3]]) -> Result<f64> {
    let bound = smallest_in_space(&job.part(0.0, 0.6), points)?;
    if domain.boundary == Boundary::Bounded || bound == 0.0 || bound == f64::INFINITY {
        return Ok(bound);
    }
    let (extent, exact) = (domain.extent(), |point: [f32; 3]| point.map(f64::from));
    let is_next_to_face = |point: &&[f32; 3]| {
        let at = exact(**point);
        (0..3).any(|axis| at[axis] - domain.min[axis] <= bound || domain.max[axis] - at[axis] <= bound)
    };
    let near: Vec<[f32; 3]> = points.iter().filter(is_next_to_face).copied().collect();
    let grid = Grid3::of(&job.part(0.6, 0.7), domain.min, bound, &near)?;
    // Half of the neighbouring copies: the other half would show the same pairs.
    let copies: Vec<[f64; 3]> =
        (14..27).map(|copy| [copy % 3, copy / 3 % 3, copy / 9].map(|k| f64::from(k) - 1.0)).collect();
    let tasks = chunks(near.len());
    let least = job.part(0.7, 1.0).map(tasks.len(), |task| {
        let mut least = square(bound);
        for i in tasks.range(task) {
            let at = exact(near[i]);
            for copy in &copies {
                let image: [f64; 3] = std::array::from_fn(|axis| at[axis] + copy[axis] * extent[axis]);
                let is_far =
                    |axis: usize| image[axis] < domain.min[axis] - bound || image[axis] > domain.max[axis] + bound;
                if (0..3).any(is_far) {
                    continue;
                }
                for other in grid.candidates(image, bound).filter(|&other| other as usize != i) {
                    let offset = domain.offset(at, exact(near[other as usize]));
                    least = least.min(offset.iter().map(|x| x * x).sum());
                }
            }
        }
        least
    })?;
    Ok(least.into_iter().fold(square(bound), f64::min).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// Against all pairs, some of which are nearest across a face, an edge or a corner.
    #[test]
    fn the_smallest_distance_is_that_of_all_pairs() {
        let context = Context::new(1).unwrap();
        let mut across = 0;
        for case in 0..400 {
            let mut rng = Rng::at(5, Draw::Probe, &[case]);
            let max = [1.0, [1.0, 0.01, 20.0][case as usize % 3], [1.0, 1e-4][case as usize / 3 % 2]];
            for boundary in [Boundary::Periodic, Boundary::Bounded] {
                let domain = Domain { min: [0.0; 3], max, boundary };
                let place =
                    |x: f64, length: f64| ((x * length) as f32).min(crate::math::rounded_down(length).next_down());
                let points: Vec<[f32; 3]> =
                    (0..2 + case as usize % 9).map(|_| max.map(|length| place(rng.unit(), length))).collect();
                let mut least = f64::INFINITY;
                for (i, &a) in points.iter().enumerate() {
                    for &b in &points[..i] {
                        let offset = domain.offset(a.map(f64::from), b.map(f64::from));
                        least = least.min(offset.iter().map(|x| x * x).sum());
                    }
                }
                let found = context.run(None, |job| smallest_distance(job, &domain, &points)).unwrap();
                assert_eq!(found, least.sqrt(), "{points:?}");
                let plain = context.run(None, |job| smallest_in_space(job, &points)).unwrap();
                across += usize::from(found < plain);
            }
        }
        assert!(across > 100, "{across}");
    }
}
