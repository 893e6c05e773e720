//! `azulejo draw points`: samples, power spectrum, radial mean and anisotropy on one page.

use std::path::PathBuf;

use azulejo::analysis::spectrum::{Annulus, Periodogram};
use azulejo::{Boundary, Context, Domain, Result};
use clap::Args;

use super::canvas::{Align, Canvas, Rect, Style};
use super::palette::{COBALT, Colour, SLATE, glaze_to_cobalt};
use super::plot::{Axis, Panel};
use super::spectra::{FREQUENCY_LIMIT, Windows, inside, power_at};
use crate::domain::DomainArgs;
use crate::formats::{Coordinates, Input};
use crate::output::Output;
use crate::progress::watched;
use crate::text::grouped;

/// The page and its panels.
const PAGE: [f32; 2] = [1600.0, 1150.0];
const SAMPLES: Rect = Rect { x: 110.0, y: 76.0, width: 640.0, height: 640.0 };
const SPECTRUM: Rect = Rect { x: 870.0, y: 76.0, width: 640.0, height: 640.0 };
const SCALE: Rect = Rect { x: 1526.0, y: 76.0, width: 14.0, height: 640.0 };
const RADIAL: Rect = Rect { x: 110.0, y: 850.0, width: 640.0, height: 220.0 };
const ANISOTROPY: Rect = Rect { x: 870.0, y: 850.0, width: 640.0, height: 220.0 };

/// Power that gets all the ink.
const FULL_INK: f64 = 4.0;

/// Radius of the dots in units of the mean spacing, 1 / sqrt(density).
const DOT: f64 = 0.26;

#[derive(Args)]
pub struct Points {
    /// The samples: a .ply, .npy, .csv, .xyz or .raw file.
    #[arg(value_name = "SAMPLES")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    /// The picture.
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,
    /// Width of the picture in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(super::PICTURE_WIDTHS))]
    size: u32,
    #[command(flatten)]
    domain: DomainArgs,
}

impl Points {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = Output::at(&self.output)?;
        let set = self.format.read(&self.input, Coordinates::Plane)?;
        let domain = self.domain.of_or_around(&set);
        let points = set.plane_positions();
        draw(context, &domain, &points, self.size, &output)
    }
}

/// Draws the page of a set, so many pixels wide.
pub fn draw(context: &Context, domain: &Domain, points: &[[f32; 2]], pixels: u32, output: &Output) -> Result<()> {
    let windows = Windows::of(domain, points.len());
    let spectrum = watched("spectrum", |progress| windows.spectrum(context, points, progress))?;

    let mut canvas = Canvas::new(PAGE[0], PAGE[1], pixels);
    draw_samples(&mut canvas, &windows, points);
    draw_spectrum(&mut canvas, &spectrum, windows.domains.len());
    let [x, y] = spectrum.frequency_step();
    let annuli = spectrum.radial(x.max(y))?;
    let annuli: Vec<_> = annuli.into_iter().filter(|annulus| annulus.frequency <= FREQUENCY_LIMIT).collect();
    draw_radial_mean(&mut canvas, &annuli);
    draw_anisotropy(&mut canvas, &annuli, windows.domains.len());
    canvas.write(output)
}

fn draw_samples(canvas: &mut Canvas, windows: &Windows, points: &[[f32; 2]]) {
    let shown = windows.domains[0];
    let [width, height] = shown.extent();
    let longer = width.max(height);
    let [across, down] = [width, height].map(|length| (length / longer) as f32);
    let panel = Panel {
        rect: Rect {
            x: SAMPLES.x + 0.5 * SAMPLES.width * (1.0 - across),
            y: SAMPLES.y + 0.5 * SAMPLES.height * (1.0 - down),
            width: SAMPLES.width * across,
            height: SAMPLES.height * down,
        },
        x: Axis::linear("x", [shown.min[0], shown.max[0]], 5),
        y: Axis::linear("y", [shown.min[1], shown.max[1]], 5),
    };
    let count = grouped(inside(&shown, points).len());
    let remark = match points.len() {
        all if windows.domains.len() > 1 => format!("{count} of {}", grouped(all)),
        _ => count,
    };
    panel.ground(canvas, false);
    let radius = DOT / windows.density.sqrt();
    let dots = images(&shown, points, radius).map(|point| panel.place(point));
    canvas.discs(dots, (radius / longer) as f32 * SAMPLES.width, COBALT, panel.rect);
    panel.axes(canvas);
    panel.title(canvas, "Samples", &remark);
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

fn draw_spectrum(canvas: &mut Canvas, spectrum: &Periodogram, windows: usize) {
    let range = [-FREQUENCY_LIMIT, FREQUENCY_LIMIT];
    let panel = Panel {
        rect: SPECTRUM,
        x: frequency_axis("frequency in x / √density", range),
        y: frequency_axis("frequency in y / √density", range),
    };
    let pixels = (SPECTRUM.width * canvas.scale()).round() as usize;
    let frequency = |i: usize| ((i as f64 + 0.5) / pixels as f64 * 2.0 - 1.0) * FREQUENCY_LIMIT;
    let image: Vec<Colour> = (0..pixels * pixels)
        .map(|i| ink(power_at(spectrum, [frequency(i % pixels), -frequency(i / pixels)])))
        .collect();
    canvas.image(&image, pixels, SPECTRUM);
    panel.axes(canvas);
    let remark = if windows > 1 { format!("mean of {windows} windows") } else { String::new() };
    panel.title(canvas, "Power spectrum", &remark);
    draw_scale(canvas);
}

/// What the ink of the spectrum means, from no power at the bottom.
fn draw_scale(canvas: &mut Canvas) {
    const ROWS: usize = 256;
    let share = |power: f64| (power / FULL_INK).sqrt() as f32;
    let gradient: Vec<_> = (0..ROWS).rev().map(|i| glaze_to_cobalt(i as f64 / (ROWS - 1) as f64)).collect();
    canvas.image(&gradient, 1, SCALE);
    canvas.frame(SCALE, 1.5, SLATE);
    let style = Style { size: 17.0, colour: SLATE, align: Align::Left, upwards: false };
    for power in [0.0, 0.25, 1.0, 2.0, FULL_INK] {
        let y = SCALE.bottom() - SCALE.height * share(power);
        canvas.line([[SCALE.right(), y], [SCALE.right() + 6.0, y]], 1.5, SLATE);
        canvas.text(&power.to_string(), [SCALE.right() + 10.0, y + 6.0], style);
    }
}

fn draw_radial_mean(canvas: &mut Canvas, annuli: &[Annulus]) {
    let peak = annuli.iter().map(|annulus| annulus.power).fold(1.5, f64::max);
    let panel = Panel {
        rect: RADIAL,
        x: frequency_axis("frequency / √density", [0.0, FREQUENCY_LIMIT]),
        y: Axis::linear("power", [0.0, (peak * 1.1).min(100.0)], 4),
    };
    let curve = annuli.iter().map(|annulus| [annulus.frequency, annulus.power]);
    draw_curve(canvas, &panel, curve, 1.0);
    panel.title(canvas, "Radial mean", "white noise: 1");
}

fn draw_anisotropy(canvas: &mut Canvas, annuli: &[Annulus], windows: usize) {
    let isotropic = -10.0 * (windows as f64).log10();
    let panel = Panel {
        rect: ANISOTROPY,
        x: frequency_axis("frequency / √density", [0.0, FREQUENCY_LIMIT]),
        y: Axis::linear("anisotropy / dB", [isotropic - 10.0, isotropic + 10.0], 4),
    };
    let curve = annuli.iter().map(|annulus| [annulus.frequency, 10.0 * annulus.anisotropy.max(1e-9).log10()]);
    draw_curve(canvas, &panel, curve, isotropic);
    let label = if windows > 1 { format!("isotropic: {isotropic:.0} dB") } else { "isotropic: 0 dB".to_owned() };
    panel.title(canvas, "Anisotropy", &label.replace('-', "\u{2212}"));
}

/// A curve over the line that it would follow without structure.
fn draw_curve(canvas: &mut Canvas, panel: &Panel, curve: impl Iterator<Item = [f64; 2]>, reference: f64) {
    panel.ground(canvas, true);
    let ends = panel.x.range.map(|x| panel.place([x, reference]));
    canvas.line(ends, 1.5, SLATE);
    canvas.clipped_line(curve.map(|place| panel.place(place)), 2.6, COBALT, Some(panel.rect));
    panel.axes(canvas);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torus_shows_dots_on_both_sides_of_its_border() {
        let points = [[0.01, 0.5], [0.99, 0.99], [0.5, 0.5]];
        let count = |boundary| images(&Domain::unit(boundary), &points, 0.02).count();
        assert_eq!((count(Boundary::Periodic), count(Boundary::Bounded)), (2 + 4 + 1, 3));
        let window = Domain { min: [0.4; 2], max: [0.6; 2], boundary: Boundary::Bounded };
        assert_eq!(images(&window, &points, 0.02).collect::<Vec<_>>(), [[0.5, 0.5]]);
    }
}
