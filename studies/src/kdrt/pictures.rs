//! The plots of the page.

use azulejo::Result;
use azulejo::analysis::spectrum::{Annulus, Periodogram};
use azulejo::kdrt::stages::Stages;

use super::statistics::Statistics;
use super::times::Times;
use crate::chart::{curve, dots, legend, range, single};
use crate::timing::Rounds;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{COBALT, Colour, INK, SERIES, SLATE, glaze_to_cobalt};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::spectra::{FREQUENCY_LIMIT, power_at};
use azulejo_cli::output::Output;

/// Power that gets all the ink, and how many inks there are: few, for the picture's size.
const FULL_INK: f64 = 2.5;
const INKS: f64 = 16.0;

/// The annuli of the radial curves, in units of sqrt(density).
pub const CURVE_ANNULUS: f64 = 0.0125;

/// The stages of a sample, as bars are divided.
pub const STAGES: [&str; 6] = ["pattern", "divide", "clip", "eliminate", "fill", "output"];

/// Nanoseconds per sample of the [`STAGES`].
pub fn stage_times(stages: &Stages) -> [f64; 6] {
    let Stages { pattern, divide, clip, eliminate, fill, output, samples, .. } = *stages;
    [pattern, divide, clip, eliminate, fill, output].map(|time| time.as_nanos() as f64 / samples.max(1) as f64)
}

fn label(size: f32, align: Align) -> Style {
    Style { size, colour: SLATE, align, upwards: false }
}

/// Seconds against samples on one thread (thesis fig. 2.11).
pub fn draw_times(times: &Times, output: &Output) -> Result<()> {
    let place = |timed: &Rounds| [timed.samples as f64, timed.scaled(1.0).median()];
    let points = || times.leaves.iter().flat_map(|leaf| leaf.one_thread.iter().map(place));
    let x = Axis::logarithmic("samples", range(points().map(|[samples, _]| samples), 1.4));
    let y = Axis::logarithmic("time / s", range(points().map(|[_, seconds]| seconds), 1.4));
    let (mut canvas, panel) = single(x, y);
    for ((leaf, colour), row) in times.leaves.iter().zip(SERIES).zip(0..) {
        let points = || leaf.one_thread.iter().map(place);
        curve(&mut canvas, &panel, points(), 2.6, colour);
        dots(&mut canvas, &panel, points(), 4.5, colour);
        let name = format!("leaves of {}r", leaf.leaf_size);
        legend(&mut canvas, [136.0, 92.0 + 28.0 * row as f32], &name, 2.6, colour);
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Time against samples", "one thread");
    canvas.write(output)
}

/// Bars of the time per sample, divided by stage (thesis fig. 2.13).
pub fn draw_stages(times: &Times, output: &Output) -> Result<()> {
    let mut canvas = Canvas::new(900.0, 480.0, 900);
    let all: Vec<_> = times.leaves.iter().map(|leaf| stage_times(&leaf.stages)).collect();
    let longest = all.iter().map(|times| times.iter().sum::<f64>()).fold(1.0, f64::max);
    let panel = Panel {
        rect: Rect { x: 110.0, y: 100.0, width: 750.0, height: 290.0 },
        x: Axis::linear("time per sample / ns", [0.0, longest * 1.05], 8),
        y: Axis::linear("smallest leaf", [0.0, all.len() as f64], 0),
    };
    panel.ground(&mut canvas, false);
    for (row, (leaf, times)) in times.leaves.iter().zip(&all).enumerate() {
        let mut from = 0.0;
        for (time, colour) in times.iter().zip(SERIES) {
            let [left, top] = panel.place([from, all.len() as f64 - row as f64 - 0.2]);
            let [right, bottom] = panel.place([from + time, all.len() as f64 - row as f64 - 0.8]);
            if right > left {
                canvas.fill(Rect { x: left, y: top, width: right - left, height: bottom - top }, colour);
            }
            from += time;
        }
        let [x, y] = panel.place([0.0, all.len() as f64 - row as f64 - 0.5]);
        canvas.text(&format!("{}r", leaf.leaf_size), [x - 12.0, y + 6.0], label(17.0, Align::Right));
    }
    panel.axes(&mut canvas);
    for (i, (stage, colour)) in STAGES.into_iter().zip(SERIES).enumerate() {
        let x = 110.0 + 125.0 * i as f32;
        canvas.fill(Rect { x, y: 70.0, width: 16.0, height: 16.0 }, colour);
        canvas.text(stage, [x + 24.0, 84.0], label(19.0, Align::Left));
    }
    let style = Style { size: 27.0, colour: INK, align: Align::Left, upwards: false };
    canvas.text("Time by stage", [110.0, 44.0], style);
    canvas.text("one thread", [860.0, 44.0], label(19.0, Align::Right));
    canvas.write(output)
}

/// Spectrum, radial mean and anisotropy (thesis fig. 2.15 to 2.19), over those of the reference.
pub fn draw_spectrum(of: &Statistics, reference: &Statistics, output: &Output) -> Result<()> {
    let mut canvas = Canvas::new(1000.0, 440.0, 1000);
    let square = Rect { x: 90.0, y: 56.0, width: 300.0, height: 300.0 };
    draw_power(&mut canvas, square, &of.spectrum, &of.sampler.name(), &format!("mean of {} sets", of.sets));
    let isotropic = -10.0 * (of.sets as f64).log10();
    let mean = Panel {
        rect: Rect { x: 500.0, y: 56.0, width: 460.0, height: 104.0 },
        x: Axis::linear("", [0.0, FREQUENCY_LIMIT], 5),
        y: Axis::linear("power", [0.0, 2.4], 3),
    };
    let anisotropy = Panel {
        rect: Rect { y: 240.0, height: 116.0, ..mean.rect },
        x: Axis::linear("frequency / √density", [0.0, FREQUENCY_LIMIT], 5),
        y: Axis::linear("anisotropy / dB", [isotropic - 6.0, isotropic + 6.0], 4),
    };
    let [own, others] = [of, reference].map(|one| one.spectrum.radial(CURVE_ANNULUS));
    let curves = [(others?, 4.5, SERIES[1]), (own?, 2.0, COBALT)];
    draw_curves(&mut canvas, &mean, &curves, |annulus| annulus.power);
    draw_curves(&mut canvas, &anisotropy, &curves, |annulus| 10.0 * annulus.anisotropy.max(1e-9).log10());
    mean.title(&mut canvas, "Radial mean", "reference in ochre");
    anisotropy.title(&mut canvas, "Anisotropy", &format!("isotropic: {isotropic:.0} dB").replace('-', "\u{2212}"));
    canvas.write(output)
}

/// A power spectrum in a square.
pub fn draw_power(canvas: &mut Canvas, square: Rect, spectrum: &Periodogram, title: &str, remark: &str) {
    let range = [-FREQUENCY_LIMIT, FREQUENCY_LIMIT];
    let panel = Panel {
        rect: square,
        x: Axis::linear("frequency in x / √density", range, 5),
        y: Axis::linear("frequency in y / √density", range, 5),
    };
    let pixels = square.width as usize;
    let frequency = |i: usize| ((i as f64 + 0.5) / pixels as f64 * 2.0 - 1.0) * FREQUENCY_LIMIT;
    let ink = |power: f64| ((power / FULL_INK).sqrt() * INKS).round() / INKS;
    let image: Vec<Colour> = (0..pixels * pixels)
        .map(|i| glaze_to_cobalt(ink(power_at(spectrum, [frequency(i % pixels), -frequency(i / pixels)]))))
        .collect();
    canvas.image(&image, pixels, square);
    panel.axes(canvas);
    panel.title(canvas, title, remark);
}

/// Curves over the annuli of spectra, each with its width and colour.
pub fn draw_curves(
    canvas: &mut Canvas,
    panel: &Panel,
    curves: &[(Vec<Annulus>, f32, Colour)],
    value: impl Fn(&Annulus) -> f64,
) {
    panel.ground(canvas, true);
    for (curve, width, colour) in curves {
        let places = curve.iter().map(|annulus| panel.place([annulus.frequency, value(annulus)]));
        canvas.clipped_line(places, *width, *colour, Some(panel.rect));
    }
    panel.axes(canvas);
}
