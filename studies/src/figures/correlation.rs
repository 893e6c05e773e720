//! Pair correlation functions (thesis fig. 4.2): those of a capacity-constrained set and of a maximal Poisson-disk set, beside
//! random and relaxed points. Fig. 4.2 (a), a fluid of Lennard-Jones, is no point set of this library.

use std::fmt::Write;

use azulejo::analysis::distribution::radial_distribution;
use azulejo::dcr::{Neighbourhood, Options, relax};
use azulejo::{Boundary, Context, Domain, Result};

use crate::dcr::others::Method;
use crate::dcr::sets::{FIRST_SEED, Start};
use crate::files::Files;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{SERIES, SLATE};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::progress::watched;

/// In units of d_max.
const REACH: f64 = 4.0;
const BINS: usize = 100;

#[derive(Clone, Copy)]
enum Kind {
    Capacity,
    Maximal,
    Relaxed,
    Random,
}

/// The kinds, and how many sets of each: the first takes seconds for each.
const KINDS: [(&str, Kind, usize); 4] = [
    ("CCVT, fig. 4.2 (b)", Kind::Capacity, 8),
    ("maximal Poisson-disk, fig. 4.2 (c)", Kind::Maximal, 64),
    ("relaxed (DCR)", Kind::Relaxed, 64),
    ("random", Kind::Random, 64),
];

impl Kind {
    fn set(self, context: &Context, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        let domain = Domain::unit(Boundary::Periodic);
        let start = if matches!(self, Self::Random) { Start::Random } else { Start::Kdrt };
        let points = start.points(context, domain, count, seed)?;
        Ok(match self {
            Self::Capacity => Method::Capacity.relax(&points, seed).points,
            Self::Relaxed => {
                relax(context, &Options::new(domain, Neighbourhood::Delaunay).seed(seed), &points, None)?.0
            }
            Self::Maximal | Self::Random => points,
        })
    }
}

/// The section.
pub fn section(context: &Context, files: &Files, quick: bool) -> Result<String> {
    let (count, divisor) = if quick { (200, 8) } else { (1000, 1) };
    let tasks: Vec<_> =
        (0..KINDS.len()).flat_map(|kind| (0..KINDS[kind].2 / divisor).map(move |set| (kind, set))).collect();
    let (single, domain) = (Context::new(1)?, Domain::unit(Boundary::Periodic));
    let work = |i: usize| {
        let (kind, set) = tasks[i];
        let points = KINDS[kind].1.set(&single, count, FIRST_SEED + set as u64)?;
        Ok(radial_distribution(&single, &domain, &points, REACH, BINS, None)?.density())
    };
    let threads = context.num_threads();
    let found: Vec<Vec<f64>> = watched("correlation", |progress| in_parallel(threads, tasks.len(), progress, work))?
        .into_iter()
        .collect::<Result<_>>()?;
    let mean = |kind: usize| -> Vec<f64> {
        let sets: Vec<_> = tasks.iter().zip(&found).filter(|(task, _)| task.0 == kind).map(|(_, one)| one).collect();
        (0..BINS).map(|bin| sets.iter().map(|one| one[bin]).sum::<f64>() / sets.len() as f64).collect()
    };
    let means: Vec<_> = (0..KINDS.len()).map(mean).collect();
    draw(&means, files)?;
    Ok(text(&means, count, divisor))
}

/// The middle of a bin, in units of d_max.
fn middle(bin: usize) -> f64 {
    (bin as f64 + 0.5) * REACH / BINS as f64
}

fn draw(means: &[Vec<f64>], files: &Files) -> Result<()> {
    let mut canvas = Canvas::new(1000.0, 620.0, 1000);
    let style = Style { size: 18.0, colour: SLATE, align: Align::Left, upwards: false };
    for (i, ((name, ..), colour)) in KINDS.iter().zip(SERIES).enumerate() {
        let (x, y) = (110.0 + 420.0 * (i % 2) as f32, 24.0 + 28.0 * (i / 2) as f32);
        canvas.line([[x, y], [x + 36.0, y]], 3.0, colour);
        canvas.text(name, [x + 46.0, y + 6.0], style);
    }
    let rect = Rect { x: 110.0, y: 90.0, width: 840.0, height: 430.0 };
    let highest = means.iter().flatten().copied().fold(1.0, f64::max).ceil();
    let panel = Panel {
        rect,
        x: Axis::linear("distance / d_max", [0.0, REACH], 4),
        y: Axis::linear("g", [0.0, highest], highest as usize),
    };
    panel.ground(&mut canvas, true);
    for (curve, colour) in means.iter().zip(SERIES).rev() {
        let places = curve.iter().enumerate().map(|(bin, &g)| panel.place([middle(bin), g]));
        canvas.clipped_line(places, 2.4, colour, Some(rect));
    }
    panel.axes(&mut canvas);
    canvas.write(&files.picture("correlation")?)
}

fn text(means: &[Vec<f64>], count: usize, divisor: usize) -> String {
    let mut text = format!(
        "## Pair correlation (thesis fig. 4.2)\n\nThe density of other points at a distance over the mean density, of sets of \
         {count} points on the torus, in bins of {:.2} d_max. *Hole*: up to where there is less than half of the mean density.\n\n\
         ![Pair correlation functions](figures/correlation.png)\n\n\
         | points | sets | hole / d_max | first peak / d_max | its height | dip after it |\n|---|---|---|---|---|---|\n",
        REACH / BINS as f64,
    );
    for ((name, _, sets), curve) in KINDS.iter().zip(means) {
        let hole = curve.iter().position(|&g| g >= 0.5).map_or(0.0, |bin| bin as f64 * REACH / BINS as f64);
        // Within a distance and a half of neighbours there is one peak.
        let near = (1.5 / REACH * BINS as f64) as usize;
        let peak = (0..near).max_by(|&a, &b| curve[a].total_cmp(&curve[b])).unwrap_or(0);
        let after = (2.0 / REACH * BINS as f64) as usize;
        let dip = curve[peak..after.max(peak + 1)].iter().copied().fold(f64::INFINITY, f64::min);
        let (place, height) = (middle(peak), curve[peak]);
        _ = writeln!(text, "| {name} | {} | {hole:.2} | {place:.2} | {height:.2} | {dip:.2} |", sets / divisor);
    }
    text
}
