//! The section of `azulejo-studies psp` on adaptive sampling: thesis §3.4.4 (fig. 3.19 to 3.21), measured and drawn: a
//! fading radius on a surface, an image in dots, and dots against a ramp of density.

use std::fmt::Write as _;

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Options, Radius};
use azulejo::{Context, MAXIMAL_DENSITY, Points, Progress, Result};

use super::scenes::radius;
use crate::files::Files;
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::{COBALT, INK, SERIES};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::render::square;
use azulejo_cli::draw::stage::Stage;
use azulejo_cli::output::Output;
use azulejo_cli::procedural::knot::knot;
use azulejo_cli::progress::watched;
use azulejo_cli::sheet::sheet;
use azulejo_cli::text::grouped;

/// The size of the section.
struct Effort {
    /// Samples of the surface and dots of the stippled image, about.
    samples: f64,
    dots: f64,
    /// Vertices along the knot.
    detail: u32,
    /// Dots of the ramp, about, and sets whose bands are counted.
    ramp: f64,
    sets: u64,
}

const FULL: Effort = Effort { samples: 3e4, dots: 6e4, detail: 1280, ramp: 2e4, sets: 20 };
const QUICK: Effort = Effort { samples: 2e3, dots: 5e3, detail: 160, ramp: 5e3, sets: 2 };

/// Writes the pictures and gives the text of the section.
pub fn section(context: &Context, files: &Files, quick: bool) -> Result<String> {
    let effort = if quick { QUICK } else { FULL };
    let [fading, stipple, ramp] = [files.picture("fading")?, files.picture("stipple")?, files.picture("ramp")?];
    let samples = watched("fading", |progress| draw_fading(context, &effort, &fading, progress))?;
    let dots = watched("stipple", |progress| draw_stipple(context, &effort, &stipple, progress))?;
    let ramp = watched("ramp", |progress| Ramp::measure(context, &effort, progress)?.draw(&ramp))?;
    Ok(format!(
        "## Adaptive sampling\n\nEach sample has its own radius; two samples are no closer than the mean of theirs, and the set is maximal under \
         that rule. The radius that gives a density of N samples on an area of 1 is √({MAXIMAL_DENSITY:.5} / N).\n\n\
         ### A fading radius (thesis fig. 3.20)\n\n\
         {} samples on a knot, with a radius for each vertex that grows six-fold from below to above.\n\n\
         ![Samples on a knot that fade upwards](psp/fading.png)\n\n\
         ### An image in dots (thesis fig. 3.21)\n\n\
         {} dots, all of one size, as dense as a rendered image is dark. The image is a flat mesh with a vertex for each \
         pixel; where it is white there is no mesh.\n\n\
         ![A knot in dots](psp/stipple.png)\n\n{}\n\
         ![Dots in bands of a ramp against its density](psp/ramp.png)\n",
        grouped(samples),
        grouped(dots),
        ramp.text(),
    ))
}

/// The least and the largest radius of the fading, in that of a uniform set.
const FADING: [f64; 2] = [0.55, 3.3];

fn draw_fading(context: &Context, effort: &Effort, output: &Output, progress: &Progress) -> Result<usize> {
    let (positions, triangles) = knot(effort.detail);
    let mesh = Mesh::new(positions, triangles)?;
    let ([_, low, _], [_, high, _]) = mesh.bounds();
    let uniform = radius(&mesh, effort.samples);
    let fading = |[_, y, _]: &[f32; 3]| {
        let height = f64::from((y - low) / (high - low));
        (uniform * FADING[0] * (FADING[1] / FADING[0]).powf(height)) as f32
    };
    let radii: Vec<_> = mesh.positions().iter().map(fading).collect();
    let (set, _) = adaptive::sample(context, &mesh, &Options::new(Radius::PerVertex(&radii)), None)?;
    let stage = Stage::new(context, &mesh, &set.positions, false)?;
    let mut canvas = Canvas::new(900.0, 900.0, 900);
    canvas.image(
        &square(&stage, 900, context.num_threads(), progress)?,
        900,
        Rect { x: 0.0, y: 0.0, width: 900.0, height: 900.0 },
    );
    canvas.write(output)?;
    Ok(set.radii.len())
}

/// The darkness up to which a pixel is white paper; it is subtracted from all.
const PAPER_DARKNESS: f64 = 0.04;

/// The darkness of each pixel of a rendered knot, from 0 to 1, in a square of so many pixels.
pub fn knot_in_grey(context: &Context, detail: u32, size: usize, progress: &Progress) -> Result<Vec<f64>> {
    let (positions, triangles) = knot(detail);
    let stage = Stage::new(context, &Mesh::new(positions, triangles)?, &[], false)?;
    let darkness = |[r, g, b]: [u8; 3]| {
        let grey = (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) / 255.0;
        ((1.0 - grey - PAPER_DARKNESS) / (1.0 - PAPER_DARKNESS)).max(0.0)
    };
    Ok(square(&stage, size, context.num_threads(), progress)?.into_iter().map(darkness).collect())
}

fn draw_stipple(context: &Context, effort: &Effort, output: &Output, progress: &Progress) -> Result<usize> {
    let size = 600;
    let darkness = knot_in_grey(context, effort.detail, size, progress)?;
    let (mesh, radii) = sheet(&darkness, size, 0.01, effort.dots)?;
    let (set, _) = adaptive::sample(context, &mesh, &Options::new(Radius::PerVertex(&radii)), None)?;
    let darkest = radii.iter().copied().fold(f32::INFINITY, f32::min);
    let mut canvas = Canvas::new(size as f32, size as f32, 2 * size as u32);
    let rect = Rect { x: 0.0, y: 0.0, width: size as f32, height: size as f32 };
    let centres = set.positions.iter().map(|&[x, y, _]| [x + 0.5, y + 0.5]);
    canvas.discs(centres, 0.62 * darkest, INK, rect);
    canvas.write(output)?;
    Ok(set.radii.len())
}

/// Bands along the ramp, and columns of the sheet in each. The sheet goes on beyond the ramp on all sides: samples
/// stand closer along a boundary.
const BANDS: usize = 16;
const COLUMNS: usize = 32;
const MARGIN: usize = 48;
/// The lightest that is drawn, in the darkest.
const LIGHTEST: f64 = 1.0 / 64.0;
/// The numbers of columns and of rows of the ramp.
const LENGTH: usize = BANDS * COLUMNS;
const HEIGHT: usize = LENGTH / 4;

/// Dots against a ramp from white to black.
struct Ramp {
    /// One of the sets.
    set: Points<3>,
    sets: u64,
    /// Dots in each band, and how many there should be, in the mean of all sets.
    found: [f64; BANDS],
    expected: [f64; BANDS],
}

impl Ramp {
    fn darkness(column: f64) -> f64 {
        (column / LENGTH as f64).clamp(LIGHTEST, 1.0)
    }

    fn measure(context: &Context, effort: &Effort, progress: &Progress) -> Result<Self> {
        let [columns, rows] = [LENGTH, HEIGHT].map(|length| length + 2 * MARGIN + 1);
        let row = (0..columns).map(|column| Self::darkness(column as f64 - MARGIN as f64));
        let darkness: Vec<_> = (0..rows).flat_map(|_| row.clone()).collect();
        // Dots on an area of 1 where it is black.
        let black = 2.0 * effort.ramp / (LENGTH * HEIGHT) as f64;
        let (mesh, radii) = sheet(&darkness, columns, LIGHTEST, black * darkness.iter().sum::<f64>())?;
        let (mut sets, mut found) = (Vec::new(), [0.0; BANDS]);
        for seed in 0..effort.sets {
            let options = Options::new(Radius::PerVertex(&radii)).seed(seed);
            let (mut set, _) = adaptive::sample(context, &mesh, &options, None)?;
            let on_ramp = |[x, y, _]: [f32; 3]| [x, y].map(|x| f64::from(x) - MARGIN as f64);
            for [x, y] in set.positions.iter().map(|&position| on_ramp(position)) {
                if (0.0..HEIGHT as f64).contains(&y) && (0.0..LENGTH as f64).contains(&x) {
                    found[x as usize / COLUMNS] += 1.0 / effort.sets as f64;
                }
            }
            set.positions.iter_mut().for_each(|place| {
                let [x, y] = on_ramp(*place);
                *place = [x as f32, y as f32, 0.0];
            });
            sets.push(set);
            _ = progress((seed + 1) as f64 / effort.sets as f64);
        }
        let area = HEIGHT as f64 / 100.0;
        let dots = |band: usize| {
            let hundredths = (0..100 * COLUMNS).map(|i| (band * COLUMNS) as f64 + (i as f64 + 0.5) / 100.0);
            hundredths.map(|column| black * area * Self::darkness(column)).sum()
        };
        Ok(Self { set: sets.swap_remove(0), sets: effort.sets, found, expected: std::array::from_fn(dots) })
    }

    /// By how much of its dots each band is off.
    fn errors(&self) -> [f64; BANDS] {
        std::array::from_fn(|band| self.found[band] / self.expected[band] - 1.0)
    }

    fn text(&self) -> String {
        let errors = self.errors();
        let mean = errors.iter().sum::<f64>() / BANDS as f64;
        let absolute = errors.iter().map(|error| error.abs()).sum::<f64>() / BANDS as f64;
        let largest = errors.iter().map(|error| error.abs()).fold(0.0, f64::max);
        let mut text = format!(
            "### Dots against a ramp of density (thesis fig. 3.19)\n\n\
             A ramp from white to black in {BANDS} bands; the mean of {} sets of about {} dots. Error of a band: {:+.2} % in \
             the mean, {:.2} % in the mean of the absolute values, {:.2} % at most.\n\n\
             | band | dots that the ramp asks for | found | error |\n|---|---|---|---|\n",
            self.sets,
            grouped(self.expected.iter().sum::<f64>() as usize),
            100.0 * mean,
            100.0 * absolute,
            100.0 * largest,
        );
        for (band, error) in errors.iter().enumerate() {
            let (expected, found) = (self.expected[band], self.found[band]);
            _ = writeln!(text, "| {} | {expected:.1} | {found:.1} | {:+.2} % |", band + 1, 100.0 * error);
        }
        text
    }

    fn draw(self, output: &Output) -> Result<Self> {
        let mut canvas = Canvas::new(960.0, 720.0, 1920);
        let strip = Rect { x: 110.0, y: 60.0, width: 800.0, height: 200.0 };
        let panel = Panel { rect: strip, x: Axis::linear("", [0.0, 1.0], 0), y: Axis::linear("", [0.0, 1.0], 0) };
        panel.ground(&mut canvas, false);
        let scale = strip.width / LENGTH as f32;
        let darkest = self.set.radii.iter().copied().fold(f64::INFINITY, f64::min) as f32;
        let places = self.set.positions.iter().map(|&[x, y, _]| [strip.x + scale * x, strip.y + scale * y]);
        canvas.discs(places, 0.55 * scale * darkest, COBALT, strip);
        panel.axes(&mut canvas);
        panel.title(&mut canvas, "A ramp in dots", &format!("one of {} sets", self.sets));

        let most = self.expected[BANDS - 1];
        let share = |dots: f64, band: usize| [(band as f64 + 0.5) / BANDS as f64, dots / most];
        let panel = Panel {
            rect: Rect { y: 320.0, height: 310.0, ..strip },
            x: Axis::linear("place along the ramp", [0.0, 1.0], 5),
            y: Axis::linear("dots in a band", [0.0, 1.1], 5),
        };
        panel.ground(&mut canvas, true);
        let [ramp, dots] = [&self.expected, &self.found]
            .map(|counts| counts.iter().enumerate().map(|(band, &dots)| panel.place(share(dots, band))));
        canvas.line(ramp, 5.0, SERIES[1]);
        canvas.discs(dots, 5.0, COBALT, panel.rect);
        panel.axes(&mut canvas);
        panel.title(&mut canvas, "Dots and density", "the ramp in ochre");
        canvas.write(output)?;
        Ok(self)
    }
}
