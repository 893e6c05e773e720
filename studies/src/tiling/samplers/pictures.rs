//! The rows of the figure, with a column for each sampler and one that is exact.

use azulejo::analysis::spectrum::Periodogram;
use azulejo::{Boundary, Domain, Result};

use super::Measured;
use crate::gallery::zone_plate;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{Colour, INK, SLATE};
use azulejo_cli::draw::panels;
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::output::Output;

/// A column, as many units as a full picture has pixels; the space between two of them, and above.
const COLUMN: f32 = 256.0;
const GAP: f32 = 20.0;
const TOP: f32 = 56.0;
const MARGIN: f32 = 20.0;

/// Points that are shown of a set, about.
const SHOWN: f64 = 1024.0;

pub fn draw(all: &[Measured], side: usize, hall: &[f64], output: &Output) -> Result<()> {
    let width = (all.len() + 1) as f32 * (COLUMN + GAP) - GAP + 2.0 * MARGIN;
    let mut canvas = Canvas::new(width, TOP + 4.0 * (COLUMN + GAP), width as u32);
    let rect = |column: usize, row: usize| {
        let [x, y] = [(column, MARGIN), (row, TOP)].map(|(i, first)| first + i as f32 * (COLUMN + GAP));
        Rect { x, y, width: COLUMN, height: COLUMN }
    };
    let style = Style { size: 24.0, colour: INK, align: Align::Left, upwards: false };
    for (i, one) in all.iter().enumerate() {
        canvas.text(one.column.name(), [rect(i, 0).x, TOP - 16.0], style);
        draw_samples(&mut canvas, rect(i, 0), &one.first);
        panels::power(&mut canvas, rect(i, 1), &Periodogram::mean(&one.spectra)?);
        canvas.frame(rect(i, 1), 1.0, SLATE);
        draw_grey(&mut canvas, rect(i, 2), &upright(&one.plate, side), side);
        draw_grey(&mut canvas, rect(i, 3), &one.hall, side);
    }
    canvas.text("exact", [rect(all.len(), 2).x, rect(all.len(), 2).y - 16.0], style);
    draw_grey(&mut canvas, rect(all.len(), 2), &upright(&zone_plate::reference(side), side), side);
    draw_grey(&mut canvas, rect(all.len(), 3), hall, side);
    canvas.write(output)
}

fn draw_samples(canvas: &mut Canvas, rect: Rect, points: &[[f32; 2]]) {
    let side = (SHOWN / points.len() as f64).sqrt().min(1.0);
    let shown = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Bounded };
    let panel = Panel { rect, x: Axis::linear("", [0.0, side], 0), y: Axis::linear("", [0.0, side], 0) };
    panel.ground(canvas, false);
    panels::dots(canvas, &panel, &shown, points, points.len() as f64);
    canvas.frame(rect, 1.0, SLATE);
}

/// The values of a plate, which begins at the bottom, from -1 to 1, as a picture from the top, from 0 to 1.
fn upright(plate: &[f64], side: usize) -> Vec<f64> {
    plate.chunks(side).rev().flatten().map(|value| 0.5 * (1.0 + value)).collect()
}

fn draw_grey(canvas: &mut Canvas, rect: Rect, picture: &[f64], side: usize) {
    // All greys there are: fewer would beat with the plate's rings, and show some that are not there.
    let grey = |value: &f64| -> Colour { [(255.0 * value.clamp(0.0, 1.0)).round() as u8; 3] };
    canvas.image(&picture.iter().map(grey).collect::<Vec<_>>(), side, rect);
    canvas.frame(rect, 1.0, SLATE);
}
