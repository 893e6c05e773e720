//! The pictures of the page.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Classes, Context, Result, psp};

use super::Effort;
use super::mixes::{MIXES, PICTURED};
use super::sets::{Maker, Measured, Tie};
use crate::chart::{curve, dots, legend, single};
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::{Colour, INK, SERIES};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::draw::stage::{Paint, Stage};
use azulejo_cli::draw::surface;
use azulejo_cli::output::Output;

/// Samples of the smallest class alone in the part of a plane that is drawn, about.
const SHOWN: f64 = 900.0;

/// The radius of a disc in parts of the radius of its class: with Wei's cross radii no two discs of the pictured mix meet.
const DISC: f64 = 0.17;

/// Panels beside each other.
const SIDE: f32 = 400.0;
const GAP: f32 = 60.0;
const TOP: f32 = 60.0;
const LEFT: f32 = 80.0;

/// The colour of a class.
fn colour(class: usize) -> Colour {
    // Of more classes than colours the last are drawn alike.
    SERIES[class.min(SERIES.len() - 1)]
}

/// A part of the first sets of the pictured mix, by all makers.
pub fn draw_plane(sets: &[Measured], output: &Output) -> Result<()> {
    let pictured: Vec<_> = sets.iter().filter(|one| one.mix == PICTURED).collect();
    let width = LEFT + pictured.len() as f32 * (SIDE + GAP);
    let mut canvas = Canvas::new(width, TOP + SIDE + 40.0, width as u32);
    for (i, one) in pictured.into_iter().enumerate() {
        let smallest = (0..one.classes.count()).map(|class| one.classes.own(class)).fold(1.0, f64::min);
        let side = (SHOWN.sqrt() * smallest).min(1.0);
        let rect = Rect { x: 0.5 * LEFT + i as f32 * (SIDE + GAP), y: TOP, width: SIDE, height: SIDE };
        let panel = Panel { rect, x: Axis::linear("", [0.0, side], 0), y: Axis::linear("", [0.0, side], 0) };
        panel.ground(&mut canvas, false);
        for (class, samples) in one.first.iter().enumerate() {
            let radius = DISC * one.classes.own(class) / side;
            let places = samples.iter().map(|sample| sample.map(f64::from));
            dots(&mut canvas, &panel, places, radius as f32 * SIDE, colour(class));
        }
        panel.axes(&mut canvas);
        let title = match one.maker {
            Maker::Azulejo(factor) => format!("factor {factor}"),
            Maker::Wei => "Wei's darts".to_owned(),
        };
        panel.title(&mut canvas, &title, "");
    }
    canvas.write(output)
}

/// The radial power of each class and of the union, for all mixes with Wei's cross radii.
pub fn draw_spectra(sets: &[Measured], output: &Output) -> Result<()> {
    const COLUMNS: usize = 2;
    const HEIGHT: f32 = 220.0;
    const STEP: [f32; 2] = [600.0, HEIGHT + 110.0];
    let rows = MIXES.len().div_ceil(COLUMNS) as f32;
    let mut canvas = Canvas::new(COLUMNS as f32 * STEP[0] + LEFT, rows * STEP[1] + 30.0, 1280);
    for (i, one) in sets.iter().filter(|one| one.maker == Maker::Azulejo(1.0)).enumerate() {
        let [x, y] = [LEFT + (i % COLUMNS) as f32 * STEP[0], TOP + (i / COLUMNS) as f32 * STEP[1]];
        let panel = Panel {
            rect: Rect { x, y, width: STEP[0] - 80.0, height: HEIGHT },
            x: Axis::linear("frequency / √density", [0.0, FREQUENCY_LIMIT], 5),
            y: Axis::linear("power", [0.0, 2.4], 3),
        };
        panel.ground(&mut canvas, true);
        let all = one.members.iter().enumerate().map(|(class, member)| (member, 1.6, colour(class)));
        for (blue, width, colour) in all.chain([(&one.union, 3.6, INK)]) {
            let power = blue.curve.iter().map(|annulus| [annulus.frequency, annulus.power]);
            curve(&mut canvas, &panel, power, width, colour);
        }
        panel.axes(&mut canvas);
        panel.title(&mut canvas, one.mix.name, "thin: each class; thick: all samples");
    }
    canvas.write(output)
}

/// Shares against the radius of the second of two classes.
pub fn draw_ties(ties: &[Tie], output: &Output) -> Result<()> {
    let x = Axis::linear("own radius of the second class, that of the first is 1", [0.38, 1.02], 6);
    let (mut canvas, panel) = single(x, Axis::linear("share of what it has alone", [0.5, 1.05], 5));
    for class in 0..2 {
        let places = || ties.iter().map(move |tie| [tie.second, tie.shares[class]]);
        // Equal radii are a case of their own: no line leads there.
        curve(&mut canvas, &panel, places().filter(|place| place[0] < 1.0), 2.6, colour(class));
        dots(&mut canvas, &panel, places(), 5.0, colour(class));
        legend(
            &mut canvas,
            [136.0, 400.0 + 28.0 * class as f32],
            ["first class", "second class"][class],
            2.6,
            colour(class),
        );
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Shares of two classes", "Wei's cross radii");
    canvas.write(output)
}

/// A mesh with the pictured mix.
pub fn draw_mesh(context: &Context, name: &str, mesh: &Arc<Mesh>, effort: &Effort, output: &Output) -> Result<()> {
    let classes = Classes::of_radii(&PICTURED.radii(effort.pictured, mesh.area()), 1.0)?;
    let (samples, _) = psp::sample_classes(context, mesh, &psp::ClassOptions::default(), &classes, None, None)?;
    let of = |class: usize| -> Vec<[f32; 3]> {
        let pairs = samples.positions.iter().zip(&samples.classes);
        pairs.filter(|&(_, &of)| of as usize == class).map(|(position, _)| *position).collect()
    };
    let by_class: Vec<_> = (0..classes.count()).map(of).collect();
    let paint = |(class, samples)| Paint { samples, radius: DISC * classes.own(class), colour: colour(class) };
    let paints: Vec<_> = by_class.iter().map(Vec::as_slice).enumerate().map(paint).collect();
    let stage = Stage::painted(context, mesh, &paints, false)?;
    surface::picture(context, name, &stage, effort.pixels, output)
}
