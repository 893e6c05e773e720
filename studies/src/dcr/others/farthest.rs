//! Farthest point optimisation (Schlömer, Heck and Deussen 2011): one point after another is moved to the place that is
//! farthest from all others.

use glam::DVec2;

use super::torus::Torus;
use super::{HEXAGONAL, Outcome};

/// Rounds until the mean distance to the nearest point grows by no more than `tolerance` d_max.
pub fn relax(points: &[[f32; 2]], tolerance: f64, rounds: u32) -> Outcome {
    let mut torus = Torus::new(points);
    // The farthest corner of each cell. The largest empty circle is about one of them.
    let mut corners: Vec<_> = (0..torus.len()).map(|i| torus.cell(i).farthest()).collect();
    let (mut is_met, mut spacing) = (false, spacing_of(&torus));
    let mut round = 0;
    while round < rounds && !is_met {
        for i in 0..torus.len() {
            let neighbours = torus.cell(i).0;
            torus.remove(i);
            corners[i] = DVec2::ZERO;
            neighbours.iter().for_each(|side| update(&torus, &mut corners, side.neighbour as usize, i));
            let by_reach = |&a: &usize, &b: &usize| corners[a].length_squared().total_cmp(&corners[b].length_squared());
            let widest = (0..torus.len()).max_by(by_reach).unwrap_or(i);
            torus.insert(i, torus.point(widest) + corners[widest]);
            let cell = torus.cell(i);
            cell.0.iter().for_each(|side| update(&torus, &mut corners, side.neighbour as usize, i));
            corners[i] = cell.farthest();
        }
        let before = std::mem::replace(&mut spacing, spacing_of(&torus));
        is_met = spacing - before <= tolerance;
        round += 1;
    }
    Outcome { points: torus.to_unit(), steps: round, is_met }
}

/// Finds the farthest corner of a neighbour's cell again.
fn update(torus: &Torus, corners: &mut [DVec2], neighbour: usize, moved: usize) {
    if neighbour != moved {
        corners[neighbour] = torus.cell(neighbour).farthest();
    }
}

/// The mean distance to the nearest point, in units of d_max.
fn spacing_of(torus: &Torus) -> f64 {
    (0..torus.len()).map(|i| torus.cell(i).nearest()).sum::<f64>() / torus.len() as f64 / HEXAGONAL
}
