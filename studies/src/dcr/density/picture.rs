//! An image in dots, made by several methods, side by side, and a detail of each below.

use azulejo::Result;

use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::INK;
use azulejo_cli::output::Output;
use azulejo_cli::stipple::darkness::Darkness;

/// The side of a panel, and what is left between panels and for titles, in units of the page.
const PANEL: f32 = 480.0;
const GAP: f32 = 12.0;
const TITLE: f32 = 40.0;

/// The part of the image that is shown in detail: where it begins, and its side, in shares of the image.
const DETAIL: ([f32; 2], f32) = ([0.52, 0.3], 0.22);

/// Draws the dots of each of the methods.
pub fn draw(image: &Darkness, sets: &[&[[f32; 2]]], output: &Output) -> Result<()> {
    let size = image.size()[0] as f32;
    let width = sets.len() as f32 * (PANEL + GAP) + GAP;
    let mut canvas = Canvas::new(width, TITLE + 2.0 * (PANEL + GAP), width as u32);
    for (column, (dots, name)) in sets.iter().zip(super::METHODS).enumerate() {
        let x = GAP + column as f32 * (PANEL + GAP);
        let style = Style { size: 22.0, colour: INK, align: Align::Left, upwards: false };
        canvas.text(name, [x, TITLE - 14.0], style);
        for (row, (from, share)) in [([0.0; 2], 1.0), DETAIL].into_iter().enumerate() {
            let panel = Rect { x, y: TITLE + row as f32 * (PANEL + GAP), width: PANEL, height: PANEL };
            let scale = PANEL / (size * share);
            let place = |dot: &[f32; 2]| {
                [panel.x + (dot[0] - from[0] * size) * scale, panel.y + (dot[1] - from[1] * size) * scale]
            };
            let radius = image.dot_radius(dots.len()) as f32 * scale;
            let is_seen = |[x, y]: &[f32; 2]| {
                (panel.x - radius..panel.right() + radius).contains(x)
                    && (panel.y - radius..panel.bottom() + radius).contains(y)
            };
            canvas.fill(panel, [255; 3]);
            canvas.discs(dots.iter().map(place).filter(is_seen), radius, INK, panel);
        }
    }
    canvas.write(output)
}
