//! Push-pull optimisation (Ahmed, Guo, Yan, Franceschi, Zhang and Deussen 2016): one point after another, in random
//! order, moves its Voronoi neighbours, until a round moves none.

use glam::DVec2;

use super::torus::{Side, Torus};
use super::{HEXAGONAL, Outcome, shuffled};

/// The smallest distance and the covering radius that are aimed at, in units of d_max, and by how much of the mean an
/// area may differ.
#[derive(Clone, Copy)]
pub struct Aims {
    pub distance: f64,
    pub cover: f64,
    pub area: f64,
}

/// The distance to which a neighbour is pushed, over the smallest distance, so that it is not found too near again.
const EXCESS: f64 = 1.001;

/// The excess of a circle that is left as it is: pulled points reach their distance up to rounding.
const ROUNDING: f64 = 1e-6;

/// Rounds until one moves no point.
pub fn relax(points: &[[f32; 2]], seed: u64, aims: Aims, rounds: u32) -> Outcome {
    let mut torus = Torus::new(points);
    let mut is_met = false;
    let mut round = 0;
    while round < rounds && !is_met {
        is_met = true;
        for i in shuffled(points.len(), seed.wrapping_add(u64::from(round))) {
            for shifts in [coverage, conflict, capacity] {
                for (neighbour, by) in shifts(&torus, i, aims) {
                    torus.shift(neighbour as usize, by);
                    is_met = false;
                }
            }
        }
        round += 1;
    }
    Outcome { points: torus.to_unit(), steps: round, is_met }
}

type Shifts = Vec<(u32, DVec2)>;

/// Pulls the neighbours of large empty circles nearer, so that these have the radius that is aimed at. Circles of
/// obtuse triangles are left alone: another one covers their middle.
fn coverage(torus: &Torus, i: usize, aims: Aims) -> Shifts {
    let cell = torus.cell(i).0;
    let scale = |k: usize| {
        let (side, before) = (cell[k % cell.len()], cell[(k + cell.len() - 1) % cell.len()]);
        if is_obtuse(before, side) { 1.0 } else { HEXAGONAL * aims.cover / side.from.length() }
    };
    let scales = (0..cell.len()).map(|k| scale(k).min(scale(k + 1)));
    let pulled = cell.iter().zip(scales).filter(|(_, scale)| *scale < 1.0 - ROUNDING);
    pulled.map(|(side, scale)| (side.neighbour, (scale - 1.0) * side.towards)).collect()
}

/// True if the triangle of a point and two neighbours has an angle above 90 degrees.
fn is_obtuse(a: Side, b: Side) -> bool {
    let (a, b) = (a.towards, b.towards);
    [a.dot(b), a.dot(a - b), b.dot(b - a)].into_iter().any(|product| product < 0.0)
}

/// Pushes neighbours away that are too near.
fn conflict(torus: &Torus, i: usize, aims: Aims) -> Shifts {
    let distance = HEXAGONAL * aims.distance;
    let near = torus.cell(i).0.into_iter().filter(|side| side.towards.length() < distance);
    near.map(|side| (side.neighbour, (EXCESS * distance / side.towards.length() - 1.0) * side.towards)).collect()
}

/// Moves all neighbours, by their share of the cell's boundary, so that its area becomes the mean.
fn capacity(torus: &Torus, i: usize, aims: Aims) -> Shifts {
    let cell = torus.cell(i);
    let excess = cell.area() - 1.0;
    if excess.abs() <= aims.area {
        return Shifts::new();
    }
    let squares: f64 = cell.lengths().map(|(_, length)| length * length).sum();
    let pressure = -2.0 * excess / squares;
    cell.lengths().map(|(side, length)| (side.neighbour, pressure * length * side.towards.normalize())).collect()
}
