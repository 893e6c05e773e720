//! Curves of measured values in a panel, with a legend.

use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{Colour, SLATE};
use azulejo_cli::draw::plot::{Axis, Panel};

/// A page with a single panel, whose ground is drawn.
pub fn single<'a>(x: Axis<'a>, y: Axis<'a>) -> (Canvas, Panel<'a>) {
    let mut canvas = Canvas::new(900.0, 560.0, 900);
    let panel = Panel { rect: Rect { x: 110.0, y: 60.0, width: 750.0, height: 410.0 }, x, y };
    panel.ground(&mut canvas, true);
    (canvas, panel)
}

/// A line of the legend: a stroke of the curve's width and colour, and the curve's name.
pub fn legend(canvas: &mut Canvas, [x, y]: [f32; 2], name: &str, width: f32, colour: Colour) {
    canvas.line([[x, y - 6.0], [x + 34.0, y - 6.0]], width, colour);
    canvas.text(name, [x + 44.0, y], Style { size: 18.0, colour: SLATE, align: Align::Left, upwards: false });
}

/// A line through values.
pub fn curve(canvas: &mut Canvas, panel: &Panel, values: impl Iterator<Item = [f64; 2]>, width: f32, colour: Colour) {
    canvas.clipped_line(values.map(|value| panel.place(value)), width, colour, Some(panel.rect));
}

/// A disc at each of some values.
pub fn dots(canvas: &mut Canvas, panel: &Panel, values: impl Iterator<Item = [f64; 2]>, radius: f32, colour: Colour) {
    canvas.discs(values.map(|value| panel.place(value)), radius, colour, panel.rect);
}

/// The range of some positive values, widened by a factor on both sides.
pub fn range(values: impl Iterator<Item = f64>, factor: f64) -> [f64; 2] {
    let (low, high) = values.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
    [low / factor, high * factor]
}
