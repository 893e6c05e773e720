//! The panels of pictures of sets of the plane: the points, their power spectrum, its radial mean and anisotropy.

use azulejo::analysis::spectrum::{Annulus, Periodogram};
use azulejo::{Boundary, Domain};

use super::canvas::{Align, Canvas, Rect, Style};
use super::palette::{COBALT, Colour, SLATE, glaze_to_cobalt};
use super::plot::{Axis, Panel};
use super::spectra::{FREQUENCY_LIMIT, Windows, inside, mean_power};
use crate::text::grouped;

/// The power that gets all the ink.
const FULL_INK: f64 = 4.0;

/// The radius of the dots in units of the mean spacing, 1 / sqrt(density).
const DOT: f64 = 0.26;

/// The points of the first of the windows.
pub fn samples(canvas: &mut Canvas, square: Rect, windows: &Windows, points: &[[f32; 2]]) {
    let shown = windows.domains[0];
    let [width, height] = shown.extent();
    let longer = width.max(height);
    let [across, down] = [width, height].map(|length| (length / longer) as f32);
    let rect = Rect {
        x: square.x + 0.5 * square.width * (1.0 - across),
        y: square.y + 0.5 * square.height * (1.0 - down),
        width: square.width * across,
        height: square.height * down,
    };
    let panel = Panel {
        rect,
        x: Axis::linear("x", [shown.min[0], shown.max[0]], ticks(rect.width)),
        y: Axis::linear("y", [shown.min[1], shown.max[1]], ticks(rect.height)),
    };
    let count = grouped(inside(&shown, points).len());
    let remark = match points.len() {
        all if windows.domains.len() > 1 => format!("{count} of {}", grouped(all)),
        _ => count,
    };
    panel.ground(canvas, false);
    dots(canvas, &panel, &shown, points, windows.density);
    panel.axes(canvas);
    panel.title(canvas, "Samples", &remark);
}

/// The number of ticks, with labels that do not touch, that fit along a side of a panel of samples.
fn ticks(length: f32) -> usize {
    const APART: f32 = 100.0;
    // The labels at both ends need the height of a line.
    const LEAST: f32 = 20.0;
    if length < LEAST { 0 } else { ((length / APART) as usize).clamp(1, 5) }
}

/// The points of a domain with this many of them per area, as dots in a panel that shows the domain.
pub fn dots(canvas: &mut Canvas, panel: &Panel, shown: &Domain, points: &[[f32; 2]], density: f64) {
    let radius = DOT / density.sqrt();
    let places = images(shown, points, radius).map(|point| panel.place(point));
    canvas.discs(places, (radius / shown.extent()[0]) as f32 * panel.rect.width, COBALT, panel.rect);
}

/// The points of which a dot of `radius` reaches into the domain; on a torus all images of them that do.
fn images(domain: &Domain, points: &[[f32; 2]], radius: f64) -> impl Iterator<Item = [f64; 2]> {
    let [width, height] = domain.extent();
    let reach = match domain.boundary {
        Boundary::Periodic => -1..=1,
        Boundary::Bounded => 0..=0,
    };
    let shifts = reach.clone().flat_map(move |i| reach.clone().map(move |j| [i as f64 * width, j as f64 * height]));
    let shifted = points
        .iter()
        .flat_map(move |&[x, y]| shifts.clone().map(move |shift| [x as f64 + shift[0], y as f64 + shift[1]]));
    shifted.filter(move |point| (0..2).all(|i| (domain.min[i] - radius..domain.max[i] + radius).contains(&point[i])))
}

fn frequency_axis(label: &str, range: [f64; 2]) -> Axis<'_> {
    Axis::linear(label, range, 5)
}

fn ink(power: f64) -> Colour {
    glaze_to_cobalt((power / FULL_INK).sqrt())
}

/// A power spectrum, with a remark beside its title.
pub fn spectrum(canvas: &mut Canvas, square: Rect, spectrum: &Periodogram, remark: &str) {
    let range = [-FREQUENCY_LIMIT, FREQUENCY_LIMIT];
    let panel = Panel {
        rect: square,
        x: frequency_axis("frequency in x / √density", range),
        y: frequency_axis("frequency in y / √density", range),
    };
    power(canvas, square, spectrum);
    panel.axes(canvas);
    panel.title(canvas, "Power spectrum", remark);
}

/// The power at all frequencies up to the limit, as ink: the mean of those in each pixel.
pub fn power(canvas: &mut Canvas, square: Rect, spectrum: &Periodogram) {
    let pixels = (square.width * canvas.scale()).round() as usize;
    let frequency = |i: usize| (i as f64 / pixels as f64 * 2.0 - 1.0) * FREQUENCY_LIMIT;
    let span = |i: usize| frequency(i)..frequency(i + 1);
    let pixel = |i: usize| ink(mean_power(spectrum, span(i % pixels), span(pixels - 1 - i / pixels)));
    let image: Vec<Colour> = (0..pixels * pixels).map(pixel).collect();
    canvas.image(&image, pixels, square);
}

/// The meaning of the spectrum's ink, from no power at the bottom.
pub fn power_scale(canvas: &mut Canvas, bar: Rect) {
    scale(canvas, bar, &[0.0, 0.25, 1.0, 2.0, FULL_INK], |power| (power / FULL_INK).sqrt());
}

/// The meaning of shares of ink, from none at the bottom, with labels at some values.
pub fn scale(canvas: &mut Canvas, bar: Rect, values: &[f64], share: impl Fn(f64) -> f64) {
    const ROWS: usize = 256;
    let gradient: Vec<_> = (0..ROWS).rev().map(|i| glaze_to_cobalt(i as f64 / (ROWS - 1) as f64)).collect();
    canvas.image(&gradient, 1, bar);
    canvas.frame(bar, 1.5, SLATE);
    let style = Style { size: 17.0, colour: SLATE, align: Align::Left, upwards: false };
    for value in values {
        let y = bar.bottom() - bar.height * share(*value) as f32;
        canvas.line([[bar.right(), y], [bar.right() + 6.0, y]], 1.5, SLATE);
        canvas.text(&value.to_string(), [bar.right() + 10.0, y + 6.0], style);
    }
}

/// The mean power by the length of the frequency.
pub fn radial_mean(canvas: &mut Canvas, rect: Rect, annuli: &[Annulus]) {
    let peak = annuli.iter().map(|annulus| annulus.power).fold(1.5, f64::max);
    let panel = Panel {
        rect,
        x: frequency_axis("frequency / √density", [0.0, FREQUENCY_LIMIT]),
        y: Axis::linear("power", [0.0, (peak * 1.1).min(100.0)], 4),
    };
    let line = annuli.iter().map(|annulus| [annulus.frequency, annulus.power]);
    curve(canvas, &panel, line, 1.0);
    panel.title(canvas, "Radial mean", "white noise: 1");
}

/// The variation of the power around its mean, in the mean of this many spectra.
pub fn anisotropy(canvas: &mut Canvas, rect: Rect, annuli: &[Annulus], spectra: usize) {
    let isotropic = -10.0 * (spectra as f64).log10();
    let panel = Panel {
        rect,
        x: frequency_axis("frequency / √density", [0.0, FREQUENCY_LIMIT]),
        y: Axis::linear("anisotropy / dB", [isotropic - 10.0, isotropic + 10.0], 4),
    };
    let line = annuli.iter().map(|annulus| [annulus.frequency, 10.0 * annulus.anisotropy.max(1e-9).log10()]);
    curve(canvas, &panel, line, isotropic);
    let label = if spectra > 1 { format!("isotropic: {isotropic:.0} dB") } else { "isotropic: 0 dB".to_owned() };
    panel.title(canvas, "Anisotropy", &label.replace('-', "\u{2212}"));
}

/// A curve over the line that it would follow without structure.
pub fn curve(canvas: &mut Canvas, panel: &Panel, line: impl Iterator<Item = [f64; 2]>, reference: f64) {
    panel.ground(canvas, true);
    let ends = panel.x.range.map(|x| panel.place([x, reference]));
    canvas.line(ends, 1.5, SLATE);
    canvas.clipped_line(line.map(|place| panel.place(place)), 2.6, COBALT, Some(panel.rect));
    panel.axes(canvas);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torus_shows_dots_on_both_sides_of_its_boundary() {
        let points = [[0.01, 0.5], [0.99, 0.99], [0.5, 0.5]];
        let count = |boundary| images(&Domain::unit(boundary), &points, 0.02).count();
        assert_eq!((count(Boundary::Periodic), count(Boundary::Bounded)), (2 + 4 + 1, 3));
        let window = Domain { min: [0.4; 2], max: [0.6; 2], boundary: Boundary::Bounded };
        assert_eq!(images(&window, &points, 0.02).collect::<Vec<_>>(), [[0.5, 0.5]]);
    }
}
