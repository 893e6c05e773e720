//! Centroidal Voronoi tessellation (Lloyd 1982; Du, Faber and Gunzburger 1999): every point moves to the centroid of its cell.

use glam::DVec2;

use super::torus::Torus;
use super::{HEXAGONAL, Outcome};

/// Steps until no point moves by more than `tolerance` d_max.
pub fn relax(points: &[[f32; 2]], tolerance: f64, steps: u32) -> Outcome {
    let mut torus = Torus::new(points);
    let mut is_met = false;
    let mut step = 0;
    while step < steps && !is_met {
        let moves: Vec<_> = (0..torus.len()).map(|i| torus.cell(i).centroid()).collect();
        moves.iter().enumerate().for_each(|(i, &by)| torus.shift(i, by));
        is_met = moves.iter().copied().map(DVec2::length).fold(0.0, f64::max) <= HEXAGONAL * tolerance;
        step += 1;
    }
    Outcome { points: torus.to_unit(), steps: step, is_met }
}
