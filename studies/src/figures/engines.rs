//! Projection by rays and by a rasteriser (thesis §3.4.3, "Rasterization vs. Ray Projection", fig. 3.18).

use std::fmt::Write;

use azulejo::psp::{Engine, ProjectionOptions, Projectors, project};
use azulejo::{Context, Result};

use crate::args::MeshArgs;
use crate::psp::scenes::{Scene, radius, scenes};
use crate::repeated::{ROUNDS, cell};
use crate::timing::in_turns;
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

/// The largest ratio of two times that counts as "similar", a limit set here.
const SIMILAR: f64 = 1.5;

/// The section.
pub fn section(context: &Context, meshes: &MeshArgs, quick: bool) -> Result<String> {
    let (counts, detail): (&[f64], _) = if quick { (&[3e3], 8) } else { (&[1e4, 1e5, 1e6], 48) };
    let rounds = if quick { 2 } else { ROUNDS };
    let (found, missing) = scenes(meshes.bunny.as_deref(), meshes.dragon.as_deref(), detail)?;
    let mut text = format!(
        "## Rasteriser (thesis fig. 3.18)\n\nOne iteration, not filled: patterns from three directions found on the mesh by \
         rays, or by triangles drawn over the patterns: milliseconds of the whole call, medians of {rounds} rounds in turns with \
         their range, without the building of \
         the ray tracer's scene, which stays with the mesh; rates of iterations with it are in [docs/psp.md](psp.md). The thesis \
         calls its own \"similar on moderately complex \
         models\" and draws the ratio without numbers; here that is a factor of at most {SIMILAR}, in every round for *met*, in \
         none for *not met*.\n\n\
         | scene | triangles | samples | rays, ms | rasteriser, ms | rasteriser over rays, in time; goal: at most {SIMILAR} either way |\n\
         |---|---|---|---|---|---|\n"
    );
    for scene in &found {
        for &count in counts {
            text += &watched(scene.name.clone(), |_| row(context, scene, count, rounds))?;
        }
    }
    for one in missing {
        _ = writeln!(text, "\n**The {} was not given (`{} MESH`) and is left out.**", one.name, one.option);
    }
    Ok(text)
}

fn row(context: &Context, scene: &Scene, count: f64, rounds: usize) -> Result<String> {
    let made = |engine: Engine| -> Result<usize> {
        let options = ProjectionOptions::new(radius(&scene.mesh, count)).projectors(Projectors::Global).engine(engine);
        Ok(project(context, &scene.mesh, &options, 1, false, None)?.0.len())
    };
    made(Engine::Embree)?;
    let [rays, rasteriser] = &in_turns(rounds, &[&|| made(Engine::Embree), &|| made(Engine::Rasteriser)])?[..] else {
        unreachable!("two calls have two times");
    };
    let ratio = rasteriser.scaled(1.0).over(&rays.scaled(1.0));
    let [rays_ms, rasteriser_ms] = [rays, rasteriser].map(|it| cell(&it.scaled(1e3), 3));
    Ok(format!(
        "| {} | {} | {} | {rays_ms} | {rasteriser_ms} | {}, {} |\n",
        scene.name,
        grouped(scene.mesh.triangles().len()),
        grouped(rays.samples),
        cell(&ratio, 3),
        ratio.verdict(|ratio| (1.0 / SIMILAR..=SIMILAR).contains(&ratio)),
    ))
}
