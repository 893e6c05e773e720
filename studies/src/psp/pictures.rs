//! The plots and pictures of the page.

use azulejo::analysis::differential::{GRID_REACH, GRID_SIZE};
use azulejo::psp::{self, Options};
use azulejo::{Context, Result};

use super::bias::{Bias, FACING_BIN, TILTS, frequencies};
use super::growth::{Growth, Moment};
use super::rates::Stages;
use super::scenes::{Scene, radius};
use super::{Effort, Measured};
use crate::chart::{curve, dots, legend, range, single};
use crate::repeated::Repeated;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{Colour, INK, SERIES, SLATE, glaze_to_cobalt};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::stage::Stage;
use azulejo_cli::draw::surface;
use azulejo_cli::output::Output;

/// The density that gets all the ink, and how many inks there are: few, for the picture's size.
const FULL_INK: f64 = 2.5;
const INKS: f64 = 16.0;

/// The part of the differences that is shown: cells per side, and how far it reaches, in mean spacings.
const SHOWN: usize = GRID_SIZE / 2;
const SHOWN_REACH: f64 = GRID_REACH / 2.0;

/// Samples per second against their number (thesis fig. 3.14).
pub fn draw_rates(measured: &[Measured], output: &Output) -> Result<()> {
    let stages = || measured.iter().flat_map(|one| &one.rates.by_count);
    let highest = stages().flat_map(|stage| [stage.iterated_rate(), stage.rate()].map(|rate| rate.median()));
    let highest = highest.fold(0.0, f64::max) / 1e6;
    let x = Axis::logarithmic("samples of the maximal set", range(stages().map(|stage| stage.filled), 1.3));
    let y = Axis::linear("rate / million samples per s", [0.0, 1.1 * highest], 5);
    let (mut canvas, panel) = single(x, y);
    for ((one, colour), row) in measured.iter().zip(SERIES).zip(0..) {
        let stages = &one.rates.by_count;
        let places =
            |rate: fn(&Stages) -> Repeated| stages.iter().map(move |stage| [stage.filled, rate(stage).median() / 1e6]);
        curve(&mut canvas, &panel, places(|stage| stage.iterated_rate()), 1.6, colour);
        curve(&mut canvas, &panel, places(|stage| stage.rate()), 4.0, colour);
        dots(&mut canvas, &panel, places(|stage| stage.rate()), 5.0, colour);
        legend(&mut canvas, [136.0, 92.0 + 28.0 * row as f32], &one.scene.name, 4.0, colour);
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Rate against samples", "thick: maximal sets; thin: one iteration");
    canvas.write(output)
}

/// Relative radius and uncovered surface against time (thesis fig. 3.12 and 3.13).
pub fn draw_growth(measured: &[Measured], output: &Output) -> Result<()> {
    let mut canvas = Canvas::new(900.0, 900.0, 900);
    let all = || measured.iter().flat_map(|one| one.growth.iterated.iter().flatten().chain([&one.growth.filled]));
    let seconds = range(all().map(|moment| moment.seconds.median()), 1.5);
    let left = range(all().map(|moment| moment.uncovered).filter(|&uncovered| uncovered > 0.0), 2.0);
    let density = Panel {
        rect: Rect { x: 110.0, y: 60.0, width: 750.0, height: 330.0 },
        x: Axis::logarithmic("", seconds),
        y: Axis::linear("relative radius", [0.8, 1.01], 4),
    };
    let uncovered = Panel {
        rect: Rect { y: 480.0, ..density.rect },
        x: Axis::logarithmic("time / s", seconds),
        y: Axis::logarithmic("uncovered part of the surface", left),
    };
    density.ground(&mut canvas, true);
    uncovered.ground(&mut canvas, true);
    for (one, colour) in measured.iter().zip(SERIES) {
        draw_moments(&mut canvas, &density, &one.growth, colour, |moment| moment.rho);
        draw_moments(&mut canvas, &uncovered, &one.growth, colour, |moment| moment.uncovered);
    }
    density.axes(&mut canvas);
    uncovered.axes(&mut canvas);
    // The curves fall: below their beginnings there is nothing.
    let first = uncovered.rect.y + uncovered.rect.height - 26.0 * measured.len() as f32 + 10.0;
    for ((one, colour), row) in measured.iter().zip(SERIES).zip(0..) {
        legend(&mut canvas, [136.0, first + 26.0 * row as f32], &one.scene.name, 3.6, colour);
    }
    density.title(&mut canvas, "Density against time", "thick: by squareness; thin: by projector; disc: filled");
    uncovered.title(&mut canvas, "Uncovered surface against time", "what is filled is below the axis");
    canvas.write(output)
}

fn draw_moments(canvas: &mut Canvas, panel: &Panel, of: &Growth, colour: Colour, value: fn(&Moment) -> f64) {
    for (moments, width) in of.iterated.iter().zip([3.6, 1.4]) {
        let places = || moments.iter().filter(|moment| value(moment) > 0.0).map(|m| [m.seconds.median(), value(m)]);
        curve(canvas, panel, places(), width, colour);
        dots(canvas, panel, places(), width + 0.6, colour);
    }
    if value(&of.filled) > 0.0 {
        dots(canvas, panel, [[of.filled.seconds.median(), value(&of.filled)]].into_iter(), 9.0, colour);
    }
}

/// Density by facing angle (what thesis fig. 3.11 sketches).
pub fn draw_facing(bias: &[Bias], output: &Output) -> Result<()> {
    let x = Axis::linear("angle between normal and nearest projector / degrees", [0.0, 55.0], 11);
    let y = Axis::linear("density / jamming limit", [0.45, 1.05], 6);
    let (mut canvas, panel) = single(x, y);
    for ((one, colour), row) in bias.iter().zip(SERIES).zip(0..) {
        let width = if one.variant.maximal { 3.6 } else { 1.6 };
        let angles = (0..).map(|bin| (f64::from(bin) + 0.5) * FACING_BIN);
        curve(&mut canvas, &panel, angles.zip(&one.facing).map(|(x, density)| [x, density.mean]), width, colour);
        legend(&mut canvas, [136.0, 332.0 + 22.0 * row as f32], &one.variant.name(), width, colour);
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Density by facing angle", "sphere");
    canvas.write(output)
}

/// Spectra from the differences (thesis fig. 3.10).
pub fn draw_spectra(bias: &[Bias], output: &Output) -> Result<()> {
    let x = Axis::linear("frequency / √density", [0.0, 2.5], 5);
    let y = Axis::linear("power", [0.0, 2.2], 4);
    let (mut canvas, panel) = single(x, y);
    for ((one, colour), row) in bias.iter().zip(SERIES).zip(0..) {
        let width = if row == 0 { 5.0 } else { 2.0 };
        let points = frequencies().into_iter().zip(&one.power).map(|(x, &y)| [x, y]);
        curve(&mut canvas, &panel, points, width, colour);
        legend(&mut canvas, [560.0, 86.0 + 23.0 * row as f32], &one.variant.name(), width, colour);
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Radial mean of the power", "sphere");
    canvas.write(output)
}

/// Differences on planes: a row for each variant, a column for each tilt.
pub fn draw_differences(bias: &[Bias], output: &Output) -> Result<()> {
    const SIDE: f32 = 256.0;
    const STEP: [f32; 2] = [SIDE + 50.0, SIDE + 70.0];
    let maximal: Vec<_> = bias.iter().filter(|one| one.variant.maximal).collect();
    let size = [80.0 + TILTS.len() as f32 * STEP[0], 110.0 + maximal.len() as f32 * STEP[1]];
    let mut canvas = Canvas::new(size[0], size[1], size[0] as u32);
    let range = [-SHOWN_REACH, SHOWN_REACH];
    for (row, one) in maximal.iter().enumerate() {
        for (column, (tilted, tilt)) in one.planes.iter().zip(TILTS).enumerate() {
            let place = [100.0 + column as f32 * STEP[0], 100.0 + row as f32 * STEP[1]];
            let [is_first, is_last] = [column == 0, row + 1 == maximal.len()];
            let panel = Panel {
                rect: Rect { x: place[0], y: place[1], width: SIDE, height: SIDE },
                x: Axis::linear(if is_last { "along / mean spacing" } else { "" }, range, 4),
                y: Axis::linear(if is_first { "across / mean spacing" } else { "" }, range, 4),
            };
            canvas.image(&inked(&tilted.differences.density(), SIDE as usize), SIDE as usize, panel.rect);
            panel.axes(&mut canvas);
            if row == 0 {
                let style = Style { size: 20.0, colour: SLATE, align: Align::Centre, upwards: false };
                canvas.text(&format!("tilted by {tilt}°"), [panel.rect.centre()[0], 44.0], style);
            }
            if is_first {
                let style = Style { size: 20.0, colour: INK, align: Align::Left, upwards: false };
                canvas.text(&one.variant.name(), [place[0], place[1] - 12.0], style);
            }
        }
    }
    canvas.write(output)
}

/// The pixels of the middle of a density, from the top; each cell has as many as the picture, so that none is blurred.
fn inked(density: &[f64], side: usize) -> Vec<Colour> {
    let cell = |i: usize| (GRID_SIZE - SHOWN) / 2 + i * SHOWN / side;
    let ink = |density: f64| (density / FULL_INK * INKS).round() / INKS;
    let pixels = (0..side * side).map(|i| density[cell(side - 1 - i / side) * GRID_SIZE + cell(i % side)]);
    pixels.map(|density| glaze_to_cobalt(ink(density))).collect()
}

/// A scene with its samples (thesis fig. 3.7 to 3.9).
pub fn draw_scene(context: &Context, scene: &Scene, effort: &Effort, output: &Output) -> Result<()> {
    let options = Options::new(radius(&scene.mesh, effort.pictured));
    let (samples, _) = psp::sample(context, &scene.mesh, &options, None)?;
    let stage = Stage::new(context, &scene.mesh, &samples.positions, scene.is_room)?;
    surface::picture(context, &scene.name, &stage, effort.pixels, output)
}
