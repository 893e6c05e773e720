//! The pictures of the page.

use azulejo::{Boundary, Domain, Result};

use super::Effort;
use super::prefixes::{Direct, Prefixes, part_counts};
use crate::chart::{curve, legend};
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::{INK, SERIES};
use azulejo_cli::draw::panels;
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::output::Output;
use azulejo_cli::text::grouped;

/// Samples of the largest prefix in the part of a plane that is drawn, about.
const SHOWN: f64 = 1200.0;

const LEFT: f32 = 80.0;
const TOP: f32 = 60.0;

/// The radial power of prefixes over that of sets of their number.
pub fn draw_spectra(effort: &Effort, prefixes: &[Prefixes], direct: &Direct, output: &Output) -> Result<()> {
    const HEIGHT: f32 = 220.0;
    const STEP: f32 = HEIGHT + 100.0;
    let counts = part_counts(effort);
    let mut canvas = Canvas::new(900.0, counts.len() as f32 * STEP + 40.0, 900);
    for (part, &count) in counts.iter().enumerate() {
        let panel = Panel {
            rect: Rect { x: LEFT, y: TOP + part as f32 * STEP, width: 780.0, height: HEIGHT },
            x: Axis::linear("frequency / √density", [0.0, FREQUENCY_LIMIT], 5),
            y: Axis::linear("power", [0.0, 2.4], 3),
        };
        panel.ground(&mut canvas, true);
        let ordered =
            prefixes.iter().zip(SERIES).map(|(one, colour)| (one.quotient.name, &one.blue[part], 2.0, colour));
        for (row, (name, blue, width, colour)) in
            [("direct", &direct.blue[part], 4.5, INK)].into_iter().chain(ordered).enumerate()
        {
            let power = blue.curve.iter().map(|annulus| [annulus.frequency, annulus.power]);
            curve(&mut canvas, &panel, power, width, colour);
            let place = [340.0 + 140.0 * row as f32, panel.rect.y - 16.0];
            legend(&mut canvas, place, name, width, colour);
        }
        panel.axes(&mut canvas);
        panel.title(&mut canvas, &format!("{} samples", grouped(count)), "");
    }
    canvas.write(output)
}

/// Some prefixes of a set, in a part of the plane.
pub fn draw_prefixes(effort: &Effort, of: &Prefixes, output: &Output) -> Result<()> {
    const SIDE: f32 = 400.0;
    let counts: Vec<usize> = part_counts(effort).into_iter().step_by(2).collect();
    let most = counts.iter().copied().max().unwrap_or(1);
    let width = LEFT + counts.len() as f32 * (SIDE + 60.0);
    let mut canvas = Canvas::new(width, TOP + SIDE + 40.0, width as u32);
    let side = (SHOWN / most as f64).sqrt().min(1.0);
    let boundary = if side < 1.0 { Boundary::Bounded } else { Boundary::Periodic };
    let shown = Domain { min: [0.0; 2], max: [side; 2], boundary };
    for (i, &count) in counts.iter().enumerate() {
        let rect = Rect { x: 0.5 * LEFT + i as f32 * (SIDE + 60.0), y: TOP, width: SIDE, height: SIDE };
        let panel = Panel { rect, x: Axis::linear("", [0.0, side], 0), y: Axis::linear("", [0.0, side], 0) };
        panel.ground(&mut canvas, false);
        panels::dots(&mut canvas, &panel, &shown, &of.first[..count.min(of.first.len())], most as f64);
        panel.axes(&mut canvas);
        panel.title(&mut canvas, &format!("first {}", grouped(count)), "");
    }
    canvas.write(output)
}
