//! Levels sets that are heaped: crowded in some places and empty in others.
//!
//! In a step a point moves by half a spacing at most, less in a crowd, and where holes are as wide as the domain no
//! triangulation can be kept: from a corner, a line or a single place, forces lead nowhere in a hundred steps. So before
//! the first step such sets are spread by the displacement `u` that removes long waves (`waves.rs`), pass after pass.
//! That is of first order in the excess; `2 / (1 + √ρ)` times `u`, where the density is `ρ` times the mean, turns a disk
//! of whatever density into one of density 1 in one pass: its radius `r` becomes `r + u = (1 + ρ) r / 2` by `u` alone,
//! but it should be `√ρ r`. Heaps of other shapes become lower.

use glam::Vec2;

use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::ground::waves::WaveGrid;
use crate::error::Result;
use crate::job::{Job, chunks};

/// What is too much for forces.
pub(in crate::dcr) struct Bounds {
    /// The longest displacement of a point, in spacings, or in cells of the grid if these are wider.
    farthest: f32,
    /// The highest density over the mean.
    densest: f32,
}

/// Sets beyond these bounds are heaped. A million uniform random points are moved by 3.3 and have a density of 3.6; only
/// on domains that are very long for their width they may be moved farther.
pub(in crate::dcr) const HEAPED: Bounds = Bounds { farthest: 4.0, densest: 5.0 };

/// Heaped sets are levelled until they are within these bounds: from there they need no more time than random sets.
pub(in crate::dcr) const LEVEL: Bounds = Bounds { farthest: 0.75, densest: 2.0 };

/// A set is also heaped if so many points that follow each other on the curve are within [`CROWDED`] spacings: too small
/// a heap for the grid to show, but forces would not get such points apart. Coincident points, once they are parted, are
/// that close. In a million random points there is no crowd, but for one set in a thousand.
const CROWD: usize = 3;
const CROWDED: f32 = 0.004;

/// Waves are removed up to this frequency, in units of sqrt(density).
const HIGHEST: f64 = 0.4;

/// The largest number of passes: a single place needs ten.
const PASSES: usize = 24;

/// The displacement of a point, in spacings, and the density there over the mean.
#[derive(Clone, Copy, Default)]
struct Excess {
    displacement: Vec2,
    density: f32,
}

/// A set beyond `bounds` after it was levelled, parted so that no two points coincide; `places` are its points in the
/// order of the curve, and after them their images. None if the set is within the bounds.
pub(in crate::dcr) fn leveled(
    job: &Job,
    torus: &Torus,
    waves: &WaveGrid,
    places: &[TorusPoint],
    bounds: &Bounds,
    seed: u64,
) -> Result<Option<Vec<TorusPoint>>> {
    let count = places.len() / torus.copies();
    let cell = waves.cell().as_vec2().max_element().max(1.0);
    let longest = torus.frame.size().as_vec2() / 4.0;
    let mut bounds = bounds;
    let mut leveled: Option<Vec<TorusPoint>> = None;
    for pass in 0..PASSES {
        let share = |pass: usize| pass as f64 / PASSES as f64;
        let now = leveled.as_deref().unwrap_or(places);
        let excess = excess(&job.part(share(pass), share(pass + 1)), waves, now, count)?;
        let is_beyond = |excess: &Excess| {
            excess.density >= bounds.densest || excess.displacement.length() >= bounds.farthest * cell
        };
        if !excess.iter().any(is_beyond) && !has_crowd(torus, &now[..count]) {
            break;
        }
        bounds = &LEVEL;
        let moved =
            |(&place, excess): (&TorusPoint, &Excess)| torus.moved(place, excess.displacement.clamp(-longest, longest));
        let moved: Vec<TorusPoint> = now.iter().zip(&excess).map(moved).collect();
        leveled = Some(torus.with_images(&moved));
    }
    Ok(leveled.map(|places| torus.parted(&places[..count], seed)))
}

/// The excess at each of the first `count` points.
fn excess(job: &Job, waves: &WaveGrid, places: &[TorusPoint], count: usize) -> Result<Vec<Excess>> {
    let density = waves.draw(&job.part(0.0, 0.2), places.len(), |point| (places[point], 1.0))?;
    let field = waves.displacements(&job.part(0.2, 0.8), density.clone(), places.len(), HIGHEST)?;
    let nodes_per_point = density.len() as f32 / places.len() as f32;
    let chunks = chunks(count);
    job.part(0.8, 1.0).concat(chunks.len(), |chunk| {
        let at = |&place: &TorusPoint| {
            let density = nodes_per_point * waves.read(&density, place).x;
            Excess { displacement: waves.read(&field, place) * (2.0 / (1.0 + density.sqrt())), density }
        };
        places[chunks.range(chunk)].iter().map(at).collect()
    })
}

/// Whether there is a crowd among points in the order of the curve.
fn has_crowd(torus: &Torus, places: &[TorusPoint]) -> bool {
    places.windows(CROWD).any(|crowd| {
        let is_near = |&other: &TorusPoint| torus.offset_f32(crowd[0], other).length_squared() < CROWDED * CROWDED;
        crowd.iter().all(is_near)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dcr::ground::curve::CurveOrder;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// The start of so many points, whose places are made from random numbers, and what levels them.
    fn leveled_points(
        boundary: Boundary,
        max: [f64; 2],
        count: usize,
        place: impl Fn(usize, [f64; 2]) -> [f64; 2],
    ) -> Option<Vec<[f64; 2]>> {
        let torus = Torus::new(Domain { min: [0.0; 2], max, boundary }, count);
        let mut rng = Rng::at(9, Draw::Probe, &[count as u64]);
        let points: Vec<[f32; 2]> =
            (0..count).map(|i| place(i, [rng.unit() * max[0], rng.unit() * max[1]]).map(|x| x as f32)).collect();
        let start = torus.with_images(CurveOrder::new(&torus, &points, 1).start());
        let waves = WaveGrid::new(&torus, None, count);
        let [one, three] = [1, 3].map(|threads| {
            Context::new(threads).unwrap().run(None, |job| leveled(job, &torus, &waves, &start, &HEAPED, 1)).unwrap()
        });
        assert_eq!(one, three);
        one.map(|places| places.iter().map(|&place| torus.leave(place).map(f64::from)).collect())
    }

    #[test]
    fn random_sets_are_left_alone() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for count in [2, 10, 100, 1000, 30_000] {
                assert_eq!(leveled_points(boundary, [1.0; 2], count, |_, place| place), None, "{boundary:?} {count}");
            }
        }
    }

    /// Each cell of a coarse grid gets its share.
    #[test]
    fn heaps_are_levelled() {
        type Start = fn(usize, [f64; 2]) -> [f64; 2];
        let starts: [Start; 6] = [
            |_, [x, y]| [0.05 * x, 0.05 * y],
            |_, _| [0.5, 0.5],
            |_, [x, _]| [x, 0.3],
            |i, [x, y]| if i % 2 == 0 { [1e-6 * x, 0.1] } else { [0.7, 0.9 + 1e-3 * y] },
            |_, [x, y]| [0.5 * x, y],
            |i, [x, y]| if i % 5 == 0 { [x, y] } else { [0.2 + 0.1 * x, 0.4] },
        ];
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (number, start) in starts.into_iter().enumerate() {
                for max in [[1.0, 1.0], [100.0, 0.01]] {
                    let place = |i: usize, [x, y]: [f64; 2]| {
                        let [x, y] = start(i, [x / max[0], y / max[1]]);
                        [x * max[0], y * max[1]]
                    };
                    let points = leveled_points(boundary, max, 5000, place).unwrap();
                    let mut cells = [0; 25];
                    for [x, y] in points {
                        let cell = match max[1] == 1.0 {
                            true => (5.0 * x) as usize + 5 * (5.0 * y) as usize,
                            false => (25.0 * x / max[0]) as usize,
                        };
                        cells[cell.min(24)] += 1;
                    }
                    let is_level = cells.iter().all(|count: &i32| (count - 200).abs() < 60);
                    assert!(is_level, "start {number}, {boundary:?}, {max:?}: {cells:?}");
                }
            }
        }
    }

    #[test]
    fn small_crowds_are_parted() {
        let points =
            leveled_points(Boundary::Periodic, [1.0; 2], 1000, |i, place| if i < 5 { [0.33, 0.61] } else { place });
        let points = points.unwrap();
        for i in 0..5 {
            let is_apart = |j: usize| (points[i][0] - points[j][0]).hypot(points[i][1] - points[j][1]) > 0.004 * 0.03;
            assert!((0..i).filter(|&j| !is_apart(j)).count() < 2, "{:?}", &points[..5]);
        }
    }
}
