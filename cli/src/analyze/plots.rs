//! The pictures of `analyze`, one to a file.

use std::fs;
use std::path::PathBuf;

use azulejo::analysis::differential::{Differences, GRID_REACH, GRID_SIZE};
use azulejo::analysis::distribution::RadialDistribution;
use azulejo::analysis::spectrum::Periodogram;
use azulejo::mesh::Mesh;
use azulejo::{Context, Domain, Error, Progress, Result};
use clap::Args;

use super::plane::{NEAREST_REACH, PAIR_REACH};
use super::{Set, plane, surface};
use crate::draw::canvas::{Canvas, Rect};
use crate::draw::palette::{COBALT, glaze_to_cobalt};
use crate::draw::panels;
use crate::draw::plot::{Axis, Panel};
use crate::draw::spectra::{FREQUENCY_LIMIT, Windows};
use crate::draw::stage::Stage;
use crate::draw::surface as view;
use crate::formats::set::{PlaneSet, SampleSet};
use crate::output::{Output, Replacing};
use crate::progress::watched;
use crate::text::rounded;

/// The pictures of sets of the plane, and those of samples of a mesh.
pub const OF_PLANE: [&str; 5] = ["points.png", "spectrum.png", "radial.png", "distances.png", "nearest.png"];
pub const OF_SURFACE: [&str; 4] = ["samples.png", "differences.png", "distances.png", "radial.png"];

/// Pixels per unit of a page.
const SCALE: f32 = 1.5;

/// Width of the picture of a mesh.
const VIEW_PIXELS: u32 = 1000;

/// The largest number of sets whose spectra are drawn as one.
const DRAWN_SPECTRA: usize = 16;

/// The density of differences that gets all the ink.
const FULL_INK: f64 = 2.5;

/// A square panel and a wide one, each on a page of its own; two wide ones above each other.
const SQUARE: Rect = Rect { x: 110.0, y: 70.0, width: 640.0, height: 640.0 };
const SQUARE_PAGE: [f32; 2] = [860.0, 790.0];
const BAR: Rect = Rect { x: 766.0, width: 14.0, ..SQUARE };
const WIDE: Rect = Rect { x: 110.0, y: 70.0, width: 760.0, height: 320.0 };
const WIDE_PAGE: [f32; 2] = [900.0, 470.0];
const LOWER: Rect = Rect { y: 540.0, ..WIDE };
const DOUBLE_PAGE: [f32; 2] = [900.0, 940.0];

/// The destination of the pictures.
#[derive(Args)]
pub struct PlotArgs {
    /// Draw the samples, their spectrum and their distances as PNG pictures into a directory.
    #[arg(long, value_name = "DIRECTORY")]
    plots: Option<PathBuf>,
    #[command(flatten)]
    replacing: Replacing,
}

impl PlotArgs {
    /// Makes the directory, and checks before the work whether pictures of these names can be written to it.
    pub fn open(&self, names: &[&str]) -> Result<Option<Directory>> {
        let Some(path) = &self.plots else { return Ok(None) };
        fs::create_dir_all(path).map_err(|source| Error::Io { path: path.clone(), source })?;
        let directory = Directory { path: path.clone(), replacing: self.replacing };
        names.iter().try_for_each(|name| directory.picture(name).map(drop))?;
        Ok(Some(directory))
    }
}

/// The directory of the pictures.
pub struct Directory {
    path: PathBuf,
    replacing: Replacing,
}

impl Directory {
    fn picture(&self, name: &str) -> Result<Output> {
        self.replacing.at(&self.path.join(name))
    }
}

fn page([width, height]: [f32; 2]) -> Canvas {
    Canvas::new(width, height, (width * SCALE) as u32)
}

pub fn plane(
    context: &Context,
    domain: &Domain,
    sets: &[Set<PlaneSet>],
    measured: &plane::Measured,
    directory: &Directory,
) -> Result<()> {
    let points: Vec<&[[f32; 2]]> = sets.iter().map(|set| &set.loaded.points[..]).collect();
    let windows = Windows::of(domain, points[0].len());
    let mut canvas = page(SQUARE_PAGE);
    panels::samples(&mut canvas, SQUARE, &windows, points[0]);
    canvas.write(&directory.picture("points.png")?)?;

    let drawn = &points[..points.len().min(DRAWN_SPECTRA)];
    let spectrum = watched("spectrum", |progress: &Progress| {
        let share = |i: usize, done: f64| progress((i as f64 + done) / drawn.len() as f64);
        let spectrum = |(i, points): (usize, &&[[f32; 2]])| windows.spectrum(context, points, &|done| share(i, done));
        Periodogram::mean(&drawn.iter().enumerate().map(spectrum).collect::<Result<Vec<_>>>()?)
    })?;
    let mut canvas = page(SQUARE_PAGE);
    let count = windows.domains.len() * drawn.len();
    let what = if windows.domains.len() > 1 { "windows" } else { "sets" };
    let remark = if count > 1 { format!("mean of {count} {what}") } else { String::new() };
    panels::spectrum(&mut canvas, SQUARE, &spectrum, &remark);
    panels::power_scale(&mut canvas, BAR);
    canvas.write(&directory.picture("spectrum.png")?)?;

    let annuli: Vec<_> = measured.annuli.iter().copied().filter(|a| a.frequency <= FREQUENCY_LIMIT).collect();
    let mut canvas = page(DOUBLE_PAGE);
    panels::radial_mean(&mut canvas, WIDE, &annuli);
    panels::anisotropy(&mut canvas, LOWER, &annuli, sets.len());
    canvas.write(&directory.picture("radial.png")?)?;

    if let Some(distribution) = &measured.distribution {
        draw_distribution(distribution).write(&directory.picture("distances.png")?)?;
    }
    draw_nearest(&measured.nearest).write(&directory.picture("nearest.png")?)
}

/// A curve of densities around 1, from 0 to somewhat above its peak.
fn draw_density(curve: &[[f64; 2]], x: Axis, title: &str) -> Canvas {
    let peak = curve.iter().map(|point| point[1]).fold(1.5, f64::max);
    let panel = Panel { rect: WIDE, x, y: Axis::linear("pairs / pairs at random", [0.0, 1.1 * peak], 4) };
    let mut canvas = page(WIDE_PAGE);
    panels::curve(&mut canvas, &panel, curve.iter().copied(), 1.0);
    panel.title(&mut canvas, title, "Poisson process: 1");
    canvas
}

fn draw_distribution(distribution: &RadialDistribution) -> Canvas {
    let curve: Vec<_> = std::iter::zip(distribution.distances(), distribution.density()).map(|(x, y)| [x, y]).collect();
    draw_density(&curve, Axis::linear("distance / d_max", [0.0, PAIR_REACH], 5), "Radial distribution function")
}

fn draw_nearest(shares: &[f64]) -> Canvas {
    let highest = shares.iter().copied().fold(0.01, f64::max);
    let panel = Panel {
        rect: WIDE,
        x: Axis::linear("distance / d_max", [0.0, NEAREST_REACH], 6),
        y: Axis::linear("points / %", [0.0, 110.0 * highest], 4),
    };
    let mut canvas = page(WIDE_PAGE);
    panel.ground(&mut canvas, true);
    let width = NEAREST_REACH / shares.len() as f64;
    for (bin, share) in shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
        let [left, top] = panel.place([bin as f64 * width, 100.0 * share]);
        let [right, bottom] = panel.place([(bin + 1) as f64 * width, 0.0]);
        canvas.fill(Rect { x: left, y: top, width: right - left - 1.0, height: bottom - top }, COBALT);
    }
    panel.axes(&mut canvas);
    let beyond = 1.0 - shares.iter().sum::<f64>();
    let remark = if beyond > 1e-6 { format!("{} % beyond", rounded(100.0 * beyond, 2)) } else { String::new() };
    panel.title(&mut canvas, "Distance to the nearest neighbour", &remark);
    canvas
}

pub fn surface(
    context: &Context,
    name: &str,
    mesh: &Mesh,
    sets: &[Set<SampleSet>],
    measured: &surface::Measured,
    directory: &Directory,
) -> Result<()> {
    let stage = Stage::new(context, mesh, &sets[0].loaded.positions, false)?;
    view::picture(context, name, &stage, VIEW_PIXELS, &directory.picture("samples.png")?)?;
    let Some(differences) = &measured.differences else { return Ok(()) };
    draw_differences(differences).write(&directory.picture("differences.png")?)?;
    let curve: Vec<_> = differences.radial().iter().map(|shell| [shell.distance, shell.density]).collect();
    let axis = Axis::linear("distance / mean spacing", [0.0, PAIR_REACH], 5);
    draw_density(&curve, axis, "Radial distribution function").write(&directory.picture("distances.png")?)?;
    draw_power(&surface::Measured::power(differences)).write(&directory.picture("radial.png")?)
}

fn draw_differences(differences: &Differences) -> Canvas {
    let mut canvas = page(SQUARE_PAGE);
    let range = [-GRID_REACH, GRID_REACH];
    let panel = Panel {
        rect: SQUARE,
        x: Axis::linear("difference along x / mean spacing", range, 8),
        y: Axis::linear("difference across / mean spacing", range, 8),
    };
    let density = differences.density();
    // Rows of pictures go down, rows of densities up.
    let ink = |i: usize| density[(GRID_SIZE - 1 - i / GRID_SIZE) * GRID_SIZE + i % GRID_SIZE] / FULL_INK;
    let image: Vec<_> = (0..GRID_SIZE * GRID_SIZE).map(|i| glaze_to_cobalt(ink(i))).collect();
    canvas.image(&image, GRID_SIZE, SQUARE);
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "Differences", "pairs / pairs at random");
    panels::scale(&mut canvas, BAR, &[0.0, 0.5, 1.0, 1.5, 2.0, FULL_INK], |density| density / FULL_INK);
    canvas
}

fn draw_power(curve: &[[f64; 2]]) -> Canvas {
    let peak = curve.iter().map(|point| point[1]).fold(1.5, f64::max);
    let panel = Panel {
        rect: WIDE,
        x: Axis::linear("frequency / √density", [0.0, FREQUENCY_LIMIT], 5),
        y: Axis::linear("power", [0.0, 1.1 * peak], 4),
    };
    let mut canvas = page(WIDE_PAGE);
    panels::curve(&mut canvas, &panel, curve.iter().copied(), 1.0);
    panel.title(&mut canvas, "Radial mean of the differential spectrum", "white noise: 1");
    canvas
}
