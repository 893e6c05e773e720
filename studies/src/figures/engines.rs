//! Projection by rays and by a rasteriser (thesis §3.4.3, "Rasterization vs. Ray Projection", fig. 3.18).

use std::fmt::Write;

use azulejo::psp::{Engine, Options, sample};
use azulejo::{Context, Result};

use crate::args::MeshArgs;
use crate::psp::scenes::{Scene, radius, scenes};
use crate::timing::least_seconds;
use crate::verdict::verdict;
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};

/// What "similar" allows, a limit set here: one takes at most so many times as long as the other.
const SIMILAR: f64 = 1.5;

/// The section.
pub fn section(context: &Context, meshes: &MeshArgs, quick: bool) -> Result<String> {
    let (counts, detail): (&[f64], _) = if quick { (&[3e3], 8) } else { (&[1e4, 1e5, 1e6], 48) };
    let (found, missing) = scenes(meshes.bunny.as_deref(), meshes.dragon.as_deref(), detail)?;
    let mut text = format!(
        "## Rasteriser (thesis fig. 3.18)\n\nOne iteration, not filled: patterns from three directions found on the mesh by \
         rays, or by triangles drawn over the patterns. The least seconds of three rounds in turns, without the building of \
         the ray tracer's scene, which stays with the mesh. The thesis calls its own \"similar on moderately complex \
         models\" and draws the ratio without numbers; here that is a factor of at most {SIMILAR}.\n\n\
         | scene | triangles | samples | rays, M samples/s | rasteriser, M samples/s | rasteriser / rays | similar |\n\
         |---|---|---|---|---|---|---|\n"
    );
    for scene in &found {
        for &count in counts {
            text += &watched(scene.name.clone(), |_| row(context, scene, count))?;
        }
    }
    for one in missing {
        _ = writeln!(text, "\n**The {} was not given (`{} MESH`) and is left out.**", one.name, one.option);
    }
    Ok(text)
}

fn row(context: &Context, scene: &Scene, count: f64) -> Result<String> {
    let made = |engine: Engine| -> Result<usize> {
        let options = Options::new(radius(&scene.mesh, count)).iterations(1).maximal(false).engine(engine);
        Ok(sample(context, &scene.mesh, &options, None)?.0.len())
    };
    made(Engine::Embree)?;
    let timed = least_seconds(3, &[&|| made(Engine::Embree), &|| made(Engine::Rasteriser)])?;
    let rates = [0, 1].map(|i: usize| timed[i].samples as f64 / timed[i].seconds);
    let ratio = rates[1] / rates[0];
    Ok(format!(
        "| {} | {} | {} | {} | {} | {ratio:.2} | {} |\n",
        scene.name,
        grouped(scene.mesh.triangles().len()),
        grouped(timed[0].samples),
        rounded(rates[0] / 1e6, 3),
        rounded(rates[1] / 1e6, 3),
        verdict((1.0 / SIMILAR..=SIMILAR).contains(&ratio)),
    ))
}
