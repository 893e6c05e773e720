//! The fall of the variance of distances for each division of tensions (thesis fig. 4.19 and 4.20).

use std::fmt::Write;

use azulejo::analysis::spacing::nearest_distances_2d;
use azulejo::dcr::{Distribution, Neighbourhood, Thesis, Visits, relax_observed};
use azulejo::{Boundary, Context, Domain, Result};

use super::sets::{FIRST_SEED, Start};
use super::study::{Study, thesis_options};
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{SERIES, SLATE};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::text::grouped;

/// The distributions by the names of the thesis.
const DISTRIBUTIONS: [(&str, Distribution); 5] = [
    ("activeness", Distribution::Activeness),
    ("average", Distribution::Average),
    ("dominant", Distribution::Dominant),
    ("zero", Distribution::Zero),
    ("0.8–0.2", Distribution::EightyTwenty),
];

/// Conflict and attraction radii: of fig. 4.19 (a) and (b), then of fig. 4.20.
const RADII: [[f64; 2]; 4] = [[0.95, 1.05], [0.9, 1.1], [0.85, 1.15], [0.8, 1.2]];

/// The distribution that is lowest in these figures of the thesis.
const LOWEST: [usize; 4] = [0, 0, 4, 4];

/// The steps after which the table gives the variance.
const MARKS: [usize; 3] = [50, 150, 400];

/// The variances after every step, of all distributions with the same radii.
type Curves = Vec<Vec<f64>>;

/// The section.
pub fn section(study: &Study) -> Result<String> {
    let (count, sets) = if study.quick { (300, 1) } else { (4096, 20) };
    let cases: Vec<_> = RADII.iter().flat_map(|radii| DISTRIBUTIONS.map(|(_, one)| (radii, one))).collect();
    let curves = study.each("distributions", cases.len() * sets, |context, i| {
        let (&[conflict_radius, attraction_radius], distribution) = cases[i / sets];
        let visits = Visits::OneEnd;
        let thesis = Thesis::default()
            .conflict_radius(conflict_radius)
            .attraction_radius(attraction_radius)
            .distribution(distribution)
            .visits(visits);
        variances(context, thesis, count, FIRST_SEED + (i % sets) as u64)
    })?;
    let mean = |curves: &[Vec<f64>]| -> Vec<f64> {
        (0..curves[0].len()).map(|k| curves.iter().map(|curve| curve[k]).sum::<f64>() / sets as f64).collect()
    };
    let means: Curves = curves.chunks(sets).map(mean).collect();
    let by_radii: Vec<_> = means.chunks(DISTRIBUTIONS.len()).collect();
    draw(&by_radii, study)?;
    Ok(text(&by_radii, count, sets))
}

/// The variance of the distances to the nearest point after each step, in squares of `d_max`, from a random start.
fn variances(context: &Context, thesis: Thesis, count: usize, seed: u64) -> Result<Vec<f64>> {
    let domain = Domain::unit(Boundary::Periodic);
    let start = Start::Random.points(context, domain, count, seed)?;
    let options = thesis_options(thesis, Neighbourhood::Delaunay, domain, seed);
    let options = options.tolerance(0.0).max_iterations(MARKS[MARKS.len() - 1] as u32);
    let mut states = Vec::new();
    let mut observe = |points: &[[f32; 2]]| states.push(points.to_vec());
    relax_observed(context, &options, &start, None, Some(&mut observe))?;
    let unit = domain.hexagonal_distance(count);
    let variance = |points: &Vec<[f32; 2]>| {
        let distances = nearest_distances_2d(context, &domain, points, None)?;
        let mean = distances.iter().sum::<f64>() / count as f64;
        Ok(distances.iter().map(|distance| ((distance - mean) / unit).powi(2)).sum::<f64>() / count as f64)
    };
    states.iter().map(variance).collect()
}

fn draw(by_radii: &[&[Vec<f64>]], study: &Study) -> Result<()> {
    let mut canvas = Canvas::new(1200.0, 970.0, 1200);
    let style = Style { size: 19.0, colour: SLATE, align: Align::Left, upwards: false };
    for (i, ((name, _), colour)) in DISTRIBUTIONS.iter().zip(SERIES).enumerate() {
        let x = 110.0 + 170.0 * i as f32;
        canvas.line([[x, 26.0], [x + 36.0, 26.0]], 3.0, colour);
        canvas.text(name, [x + 46.0, 32.0], style);
    }
    for (i, (curves, [conflict, attraction])) in by_radii.iter().zip(RADII).enumerate() {
        let rect =
            Rect { x: 110.0 + 570.0 * (i % 2) as f32, y: 100.0 + 470.0 * (i / 2) as f32, width: 480.0, height: 320.0 };
        let panel = Panel {
            rect,
            x: Axis::linear("steps", [0.0, curves[0].len() as f64], 5),
            y: Axis::logarithmic("variance / d_max²", [3e-3, 1e-1]),
        };
        panel.ground(&mut canvas, true);
        // The thesis's own last, above the others.
        for (curve, colour) in curves.iter().zip(SERIES).rev() {
            let places = (1..).zip(curve).map(|(step, &variance)| panel.place([f64::from(step), variance]));
            canvas.clipped_line(places, 2.2, colour, Some(rect));
        }
        panel.axes(&mut canvas);
        let figure = ["fig. 4.19 (a)", "fig. 4.19 (b)", "fig. 4.20 (a)", "fig. 4.20 (b)"][i];
        panel.title(&mut canvas, &format!("{conflict} and {attraction}"), figure);
    }
    canvas.write(&study.picture("distributions")?)
}

fn text(by_radii: &[&[Vec<f64>]], count: usize, sets: usize) -> String {
    let mut text = format!(
        "## Force distributions (thesis fig. 4.19 and 4.20)\n\n\
         The variance of the distances to the nearest point, in units of d_max², from random sets of {} points on the torus, \
         with Delaunay neighbours and λ = 0.05; means of {sets}. Every edge is visited from one end, which is the same in \
         every step: *average* gives half of a tension to each end, *dominant* all to the neighbour, *zero* all to the visiting \
         point, *0.8–0.2* most to the visiting point, where the thesis says both that and the reverse. Visited from both \
         ends, as in the thesis's pseudo-code, the four constant ones move every point by the same. The thesis has activeness \
         lowest in fig. 4.19 and 0.8–0.2 in fig. 4.20; the lowest here are bold, and *thesis* says whether they are \
         the same.\n\n\
         ![The variance of distances by steps for five distributions](dcr/distributions.png)\n\n\
         | radii | after steps | {} | thesis |\n{}|\n",
        grouped(count),
        DISTRIBUTIONS.map(|(name, _)| name).join(" | "),
        "|---".repeat(3 + DISTRIBUTIONS.len()),
    );
    for ((curves, [conflict, attraction]), claimed) in by_radii.iter().zip(RADII).zip(LOWEST) {
        for mark in MARKS {
            let lowest = curves.iter().map(|curve| curve[mark - 1]).fold(f64::INFINITY, f64::min);
            let cell = |curve: &Vec<f64>| match curve[mark - 1] {
                variance if variance == lowest => format!("**{variance:.4}**"),
                variance => format!("{variance:.4}"),
            };
            let cells: Vec<_> = curves.iter().map(cell).collect();
            let is_same = curves[claimed][mark - 1] == lowest;
            let claim = if is_same { "as here" } else { "**not reproduced**" };
            _ = writeln!(text, "| {conflict} and {attraction} | {mark} | {} | {claim} |", cells.join(" | "));
        }
    }
    text
}
