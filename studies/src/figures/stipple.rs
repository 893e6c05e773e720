//! An image in two million dots (thesis fig. 1.14).

use std::time::Instant;

use azulejo::psp::adaptive::{Options, Radius, sample};
use azulejo::{Context, Progress, Result};

use crate::files::Files;
use crate::psp::adaptive::knot_in_grey;
use crate::repeated::{ROUNDS, Repeated, cell};
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::INK;
use azulejo_cli::output::Output;
use azulejo_cli::progress::watched;
use azulejo_cli::sheet::sheet;
use azulejo_cli::text::grouped;

/// Seconds that the thesis took, and dots that it had at least.
const SECONDS_GOAL: f64 = 10.0;
const DOTS_GOAL: usize = 2_000_000;

/// The lightest grey that is drawn, in the darkest.
const LIGHTEST: f64 = 0.01;

/// Of so many parts along each edge of the picture one is drawn.
const PARTS: usize = 10;

/// A stippled image.
struct Stippled {
    dots: usize,
    seconds: Repeated,
}

/// The section.
pub fn section(context: &Context, files: &Files, quick: bool) -> Result<String> {
    let (dots, size, detail, rounds) = if quick { (5e3, 200, 160, 1) } else { (2.1e6, 1024, 1280, ROUNDS) };
    let output = files.picture("stipple")?;
    let made = watched("stipple", |progress| draw(context, dots, size, detail, rounds, &output, progress))?;
    let goal = if quick {
        String::new()
    } else {
        let verdict = made.seconds.verdict(|seconds| made.dots >= DOTS_GOAL && seconds <= SECONDS_GOAL);
        format!(" Two million in ten seconds, in each of {rounds} rounds: {verdict}.")
    };
    Ok(format!(
        "## Stippling (thesis fig. 1.14)\n\n{} dots in {} s, as dense as a rendered image of {size} × {size} pixels is dark: a \
         flat mesh with a vertex for each pixel and a radius for each vertex. The thesis has \"over 2 million samples within 10 \
         seconds\", of another image, by its GPU.{goal} The darkest tenth of its width and height:\n\n\
         ![Dots of an image](figures/stipple.png)\n",
        grouped(made.dots),
        cell(&made.seconds, 3),
    ))
}

fn draw(
    context: &Context,
    dots: f64,
    size: usize,
    detail: u32,
    rounds: usize,
    output: &Output,
    progress: &Progress,
) -> Result<Stippled> {
    let darkness = knot_in_grey(context, detail, size, &|done| progress(0.2 * done))?;
    let (mesh, radii) = sheet(&darkness, size, LIGHTEST, dots)?;
    let options = Options::new(Radius::PerVertex(&radii));
    let (mut seconds, mut made) = (Vec::new(), None);
    for round in 0..rounds {
        let start = Instant::now();
        let part = |done: f64| progress(0.2 + 0.8 * (round as f64 + done) / rounds as f64);
        made = Some(sample(context, &mesh, &options, Some(&part))?.0);
        seconds.push(start.elapsed().as_secs_f64());
    }
    let set = made.expect("there is a round");
    let pixels = 600.0;
    let (scale, first) = (pixels * PARTS as f32 / size as f32, darkest_part(&darkness, size));
    let darkest = radii.iter().copied().fold(f32::INFINITY, f32::min);
    let rect = Rect { x: 0.0, y: 0.0, width: pixels, height: pixels };
    let mut canvas = Canvas::new(pixels, pixels, pixels as u32);
    let centres = set.positions.iter().map(|&[x, y, _]| [scale * (x - first[0]), scale * (y - first[1])]);
    canvas.discs(centres, 0.5 * scale * darkest, INK, rect);
    canvas.write(output)?;
    Ok(Stippled { dots: set.radii.len(), seconds: Repeated::new(seconds) })
}

/// The corner of the part of a picture that has most ink, in pixels.
fn darkest_part(darkness: &[f64], size: usize) -> [f32; 2] {
    let side = size / PARTS;
    let ink = |part: &usize| -> f64 {
        let (x, y) = (part % PARTS * side, part / PARTS * side);
        (y..y + side).map(|row| darkness[row * size + x..][..side].iter().sum::<f64>()).sum()
    };
    let part = (0..PARTS * PARTS).max_by(|a, b| ink(a).total_cmp(&ink(b))).unwrap_or(0);
    [part % PARTS * side, part / PARTS * side].map(|x| x as f32)
}
