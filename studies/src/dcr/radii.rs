//! The effect of the radii on the thesis's sets (thesis fig. 4.13 to 4.15).

use std::fmt::Write;

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::dcr::{Neighbourhood, Thesis, relax};
use azulejo::{Boundary, Context, Domain, Result};

use super::sets::{FIRST_SEED, Start};
use super::study::{Study, thesis_options};
use crate::kdrt::pictures::{CURVE_ANNULUS, draw_curves, draw_power};
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::COBALT;
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::quality::Quality;
use azulejo_cli::text::grouped;

/// Delaunay neighbours: conflict and attraction radii of fig. 4.13 and of fig. 4.14.
const DELAUNAY: [[f64; 2]; 4] = [[0.8, 1.2], [0.9, 1.1], [0.95, 1.05], [0.99, 1.01]];

/// Nearest neighbours: conflict radii, as in fig. 4.15, and K. The last ones are not drawn.
const NEAREST: [(f64, u32); 7] = [(0.8, 6), (0.9, 6), (0.95, 6), (0.99, 6), (0.95, 1), (0.95, 3), (0.95, 12)];

/// The number of settings of each neighbourhood that are drawn.
const DRAWN: usize = 4;

/// One setting of the algorithm, and what to call it.
struct Setting {
    name: String,
    neighbourhood: Neighbourhood,
    thesis: Thesis,
}

/// The sets of a setting.
struct Outcome {
    points: Vec<[f32; 2]>,
    spectrum: Periodogram,
    quality: Quality,
    steps: f64,
}

/// The section.
pub fn section(study: &Study) -> Result<String> {
    let (count, sets) = if study.quick { (300, 1) } else { (4096, 4) };
    let settings = settings();
    let outcomes = study.each("radii", settings.len() * sets, |context, i| {
        Outcome::of(context, &settings[i / sets], count, FIRST_SEED + (i % sets) as u64)
    })?;
    let all: Vec<_> = settings.iter().zip(outcomes.chunks(sets)).collect();
    let mut text = format!(
        "## Radii (thesis fig. 4.13 to 4.15)\n\n\
         The thesis's algorithm from random sets of {} points on the torus, λ = 0.05, with α, until points move by no more than \
         0.02 d_max per unit of λ, or 0.005 with nearest neighbours, or 1,000 steps are made; means of {sets}. With Delaunay \
         neighbours radii are loose (fig. 4.13) or strict (fig. 4.14); *K* is the number of nearest neighbours, which the \
         thesis does not name.\n",
        grouped(count),
    );
    for (neighbourhood, name) in [(Neighbourhood::Delaunay, "delaunay"), (Neighbourhood::Nearest, "nearest")] {
        let rows: Vec<_> = all.iter().filter(|(setting, _)| setting.neighbourhood == neighbourhood).collect();
        let mut canvas = Canvas::new(1760.0, 1180.0, 1200);
        for (column, (setting, outcomes)) in rows.iter().take(DRAWN).enumerate() {
            let spectrum = Periodogram::mean(&outcomes.iter().map(|one| one.spectrum.clone()).collect::<Vec<_>>())?;
            let left = 90.0 + 425.0 * column as f32;
            draw_column(&mut canvas, left, &setting.name, &outcomes[0].points, &spectrum)?;
        }
        canvas.write(&study.picture(&format!("radii-{name}"))?)?;
        text += &format!(
            "\n![Samples, spectra and radial means for four settings](dcr/radii-{name}.png)\n\n\
             | radii | ρ | cover | ψ6 | P | obtuse | edge CV² | steps |\n{}|\n",
            "|---".repeat(8),
        );
        rows.iter().for_each(|(setting, outcomes)| text += &row(setting, outcomes));
    }
    Ok(text)
}

fn settings() -> Vec<Setting> {
    let delaunay = DELAUNAY.map(|[conflict_radius, attraction_radius]| Setting {
        name: format!("{conflict_radius} and {attraction_radius}"),
        neighbourhood: Neighbourhood::Delaunay,
        thesis: Thesis::default().conflict_radius(conflict_radius).attraction_radius(attraction_radius),
    });
    let nearest = NEAREST.map(|(conflict_radius, neighbours)| Setting {
        name: format!("{conflict_radius}, K = {neighbours}"),
        neighbourhood: Neighbourhood::Nearest,
        thesis: Thesis::default().conflict_radius(conflict_radius).neighbours(neighbours),
    });
    delaunay.into_iter().chain(nearest).collect()
}

impl Outcome {
    fn of(context: &Context, setting: &Setting, count: usize, seed: u64) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let start = Start::Random.points(context, domain, count, seed)?;
        let options = thesis_options(setting.thesis, setting.neighbourhood, domain, seed);
        let (points, report) = relax(context, &options, &start, None)?;
        let half = (FREQUENCY_LIMIT * (count as f64).sqrt()).ceil() as usize + 1;
        let spectrum = periodogram(context, &domain, &points, 2 * half + 1, None)?;
        let quality = Quality::of(context, &options.domain, &points)?;
        Ok(Self { points, spectrum, quality, steps: report.iterations.into() })
    }
}

fn row(setting: &Setting, outcomes: &[Outcome]) -> String {
    let mean = |of: fn(&Outcome) -> f64| outcomes.iter().map(of).sum::<f64>() / outcomes.len() as f64;
    let mut row = String::new();
    _ = writeln!(
        row,
        "| {} | {:.3} | {:.3} | {:.3} | {:.1e} | {:.1} % | {:.4} | {:.0} |",
        setting.name,
        mean(|one| one.quality.rho),
        mean(|one| one.quality.cover),
        mean(|one| one.quality.order),
        mean(|one| one.quality.low_power),
        100.0 * mean(|one| one.quality.obtuse),
        mean(|one| one.quality.edge_variation),
        mean(|one| one.steps),
    );
    row
}

/// A column: a part of a set, a mean spectrum and its radial mean.
pub fn draw_column(
    canvas: &mut Canvas,
    left: f32,
    name: &str,
    points: &[[f32; 2]],
    spectrum: &Periodogram,
) -> Result<()> {
    let square = |y| Rect { x: left, y, width: 330.0, height: 330.0 };
    let samples = Panel { rect: square(56.0), x: Axis::linear("", [0.0, 0.5], 0), y: Axis::linear("", [0.0, 0.5], 0) };
    samples.ground(canvas, false);
    let dots = points.iter().map(|point| samples.place(point.map(f64::from)));
    let radius = 0.26 / (points.len() as f32).sqrt() * 2.0 * samples.rect.width;
    canvas.discs(dots, radius, COBALT, samples.rect);
    samples.axes(canvas);
    samples.title(canvas, name, "");

    draw_power(canvas, square(430.0), spectrum, "", "");
    let radial = Panel {
        rect: Rect { height: 230.0, ..square(870.0) },
        x: Axis::linear("frequency / √density", [0.0, FREQUENCY_LIMIT], 5),
        y: Axis::linear("power", [0.0, 6.0], 3),
    };
    draw_curves(canvas, &radial, &[(spectrum.radial(CURVE_ANNULUS)?, 2.0, COBALT)], |annulus| annulus.power);
    Ok(())
}
