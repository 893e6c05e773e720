//! The spacing of relaxed sets on meshes over several seeds, against the goal.

use std::fmt::Write;
use std::sync::Arc;

use azulejo::dcr::surface::{Options, relax};
use azulejo::mesh::Mesh;
use azulejo::{Context, Result, psp};

use super::sets::FIRST_SEED;
use crate::psp::scenes::radius;
use crate::verdict::{Mean, verdict};
use azulejo_cli::text::grouped;

/// The goal: the smallest distance in units of the hexagonal one, of every set.
const GOAL: f64 = 0.845;
/// Sets of a mesh and a number of samples.
pub const SETS: u64 = 8;

/// The relaxed sets of a mesh and a number of samples.
pub struct Spacing {
    mesh: &'static str,
    /// Samples of the first set.
    count: usize,
    rho: Vec<f64>,
}

impl Spacing {
    pub fn measure(context: &Context, name: &'static str, mesh: &Arc<Mesh>, count: f64, sets: u64) -> Result<Self> {
        let (mut rho, mut first) = (Vec::new(), 0);
        for seed in FIRST_SEED..FIRST_SEED + sets {
            let (start, _) = psp::sample(context, mesh, &psp::Options::new(radius(mesh, count)).seed(seed), None)?;
            let options = Options::default().seed(seed);
            rho.push(relax(context, mesh, &start.triangles, &start.barycentrics, &options, None)?.1.rho);
            first = if rho.len() == 1 { start.len() } else { first };
        }
        Ok(Self { mesh: name, count: first, rho })
    }
}

/// The table of all.
pub fn table(all: &[Spacing]) -> String {
    let sets = all.first().map_or(0, |one| one.rho.len());
    let mut text = format!(
        "\nThe spacing of relaxed sets over {sets} seeds, the one above among them; the goal is that ρ is at least {GOAL} in each.\n\n\
         | mesh | samples | ρ, least | ρ, mean | sets below | every set | in the mean |\n|---|---|---|---|---|---|---|\n"
    );
    for Spacing { mesh, count, rho } in all {
        let (least, mean) = (rho.iter().copied().fold(f64::INFINITY, f64::min), Mean::of(rho));
        let below = rho.iter().filter(|&&rho| rho < GOAL).count();
        _ = writeln!(
            text,
            "| {mesh} | {} | {least:.4} | {:.4} ± {:.4} | {below} | {} | {} |",
            grouped(*count),
            mean.mean,
            mean.error,
            verdict(below == 0),
            verdict(mean.mean >= GOAL),
        );
    }
    text
}
