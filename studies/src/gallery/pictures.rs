//! The pictures of the gallery.

use azulejo::analysis::spectrum::Annulus;
use azulejo::{Boundary, Domain, Result};

use super::measured::Measured;
use super::zone_plate;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{Colour, INK, SLATE};
use azulejo_cli::draw::panels;
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::output::Output;

/// A column and the space between two of them.
const COLUMN: f32 = 300.0;
const GAP: f32 = 64.0;
const LEFT: f32 = 100.0;
const RIGHT: f32 = 40.0;

/// The rows of a page: its top and height.
const SAMPLES: [f32; 2] = [64.0, COLUMN];
const SPECTRUM: [f32; 2] = [394.0, COLUMN];
const RADIAL: [f32; 2] = [784.0, 130.0];
const ANISOTROPY: [f32; 2] = [956.0, 130.0];
const HEIGHT: f32 = 1160.0;

/// Points that are shown of a set, about.
const SHOWN: f64 = 1024.0;

/// The annuli of the curves, in units of sqrt(density), at least.
const ANNULUS: f64 = 0.0125;

/// The highest power and the range of the anisotropy, over that of an isotropic set, that are shown.
const HIGHEST_POWER: f64 = 6.0;
const DECIBELS: [f64; 2] = [-10.0, 40.0];

/// A zone plate, as many units as it has pixels, and how plates are set.
const PLATE: f32 = 256.0;
const PLATES_PER_ROW: usize = 5;
const PLATE_GAP: f32 = 28.0;
const PLATE_PITCH: [f32; 2] = [PLATE + PLATE_GAP, PLATE + 84.0];
const PLATE_TOP: f32 = 52.0;
const MARGIN: f32 = 30.0;

/// Points, spectrum, radial mean and anisotropy of some samplers, each a column (thesis fig. 4.16 and 4.17).
pub fn draw_sets(sets: &[Measured], output: &Output) -> Result<()> {
    let width = LEFT + sets.len() as f32 * (COLUMN + GAP) - GAP + RIGHT;
    let mut canvas = Canvas::new(width, HEIGHT, width as u32);
    for (i, set) in sets.iter().enumerate() {
        let rect = |[y, height]: [f32; 2]| Rect { x: LEFT + i as f32 * (COLUMN + GAP), y, width: COLUMN, height };
        draw_samples(&mut canvas, rect(SAMPLES), set);
        draw_spectrum(&mut canvas, rect(SPECTRUM), set, i == 0);
        let annuli = set.spectrum.radial(set.spectrum.frequency_step()[0].max(ANNULUS))?;
        draw_curves(&mut canvas, [rect(RADIAL), rect(ANISOTROPY)], &annuli, set.sets as f64, i == 0);
    }
    canvas.write(output)
}

fn draw_samples(canvas: &mut Canvas, rect: Rect, set: &Measured) {
    let count = set.first.len() as f64;
    let side = (SHOWN / count).sqrt().min(1.0);
    // The boundary is that of a torus only where all of it is seen.
    let boundary = if side < 1.0 { Boundary::Bounded } else { Boundary::Periodic };
    let shown = Domain { min: [0.0; 2], max: [side; 2], boundary };
    let panel = Panel { rect, x: Axis::linear("", [0.0, side], 0), y: Axis::linear("", [0.0, side], 0) };
    panel.ground(canvas, false);
    panels::dots(canvas, &panel, &shown, &set.first, count);
    panel.axes(canvas);
    let style = Style { size: 24.0, colour: INK, align: Align::Left, upwards: false };
    canvas.text(&set.sampler.name(), [rect.x, rect.y - 16.0], style);
}

/// Beside other columns an axis is labelled once.
fn once(label: &str, is_first: bool) -> &str {
    if is_first { label } else { "" }
}

fn draw_spectrum(canvas: &mut Canvas, rect: Rect, set: &Measured, is_first: bool) {
    let range = [-FREQUENCY_LIMIT, FREQUENCY_LIMIT];
    let panel = Panel {
        rect,
        x: Axis::linear("frequency in x / √density", range, 5),
        y: Axis::linear(once("frequency in y / √density", is_first), range, 5),
    };
    panels::power(canvas, rect, &set.spectrum);
    panel.axes(canvas);
}

fn draw_curves(canvas: &mut Canvas, rects: [Rect; 2], annuli: &[Annulus], sets: f64, is_first: bool) {
    let frequency = |label| Axis::linear(label, [0.0, FREQUENCY_LIMIT], 5);
    let power = Axis::linear(once("power", is_first), [0.0, HIGHEST_POWER], 3);
    let decibels = Axis::linear(once("anisotropy / dB", is_first), DECIBELS, 3);
    let [upper, lower] = rects;
    let line = annuli.iter().map(|annulus| [annulus.frequency, annulus.power]);
    panels::curve(canvas, &Panel { rect: upper, x: frequency(""), y: power }, line, 1.0);
    // The mean of n spectra of an isotropic set has an anisotropy of 1 / n.
    let level = |annulus: &Annulus| 10.0 * (sets * annulus.anisotropy).max(1e-9).log10();
    let line = annuli.iter().map(|annulus| [annulus.frequency, level(annulus)]);
    panels::curve(canvas, &Panel { rect: lower, x: frequency("frequency / √density"), y: decibels }, line, 0.0);
}

/// The plate as it should be, and as each sampler's points show it (thesis fig. 2.12, third row).
pub fn draw_plates(sets: &[Measured], side: usize, output: &Output) -> Result<()> {
    let rows = (sets.len() + 1).div_ceil(PLATES_PER_ROW);
    let [width, height] =
        [PLATES_PER_ROW as f32 * PLATE_PITCH[0] + 2.0 * MARGIN - PLATE_GAP, rows as f32 * PLATE_PITCH[1] + MARGIN];
    let mut canvas = Canvas::new(width, height, width as u32);
    let errors = |set: &Measured| {
        let [low, high] = [set.error(|errors| errors.low), set.error(|errors| errors.high)];
        format!("error {:.3} low, {:.3} high", low.mean, high.mean)
    };
    let exact = ("exact".to_owned(), "low and high frequencies".to_owned(), zone_plate::reference(side));
    let plates = sets.iter().map(|set| (set.sampler.name(), errors(set), set.plate.clone()));
    for (i, (name, remark, plate)) in std::iter::once(exact).chain(plates).enumerate() {
        let [column, row] = [i % PLATES_PER_ROW, i / PLATES_PER_ROW].map(|k| k as f32);
        let rect = Rect {
            x: MARGIN + column * PLATE_PITCH[0],
            y: PLATE_TOP + row * PLATE_PITCH[1],
            width: PLATE,
            height: PLATE,
        };
        draw_plate(&mut canvas, rect, &plate, side);
        let style = Style { size: 22.0, colour: INK, align: Align::Left, upwards: false };
        canvas.text(&name, [rect.x, rect.y - 12.0], style);
        canvas.text(&remark, [rect.x, rect.bottom() + 24.0], Style { size: 17.0, colour: SLATE, ..style });
    }
    canvas.write(output)
}

/// A picture of values from -1 to 1, the lowest row at the bottom.
fn draw_plate(canvas: &mut Canvas, rect: Rect, plate: &[f64], side: usize) {
    let grey = |i: usize| {
        let value = plate[(side - 1 - i / side) * side + i % side];
        // All greys there are: fewer would beat with the plate's rings, and show some that are not there.
        [(127.5 * (1.0 + value.clamp(-1.0, 1.0))).round() as u8; 3]
    };
    let image: Vec<Colour> = (0..side * side).map(grey).collect();
    canvas.image(&image, side, rect);
    canvas.frame(rect, 1.0, SLATE);
}
