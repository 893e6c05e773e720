//! Triangles for remeshing, before and after relaxation (thesis §4.4.4, fig. 4.21).

use std::collections::BTreeMap;
use std::fmt::Write;

use azulejo::analysis::triangles::{Triangle, TriangleStatistics, delaunay_triangles, triangle_statistics};
use azulejo::dcr::{Neighbourhood, Options, relax};
use azulejo::{Boundary, Context, Domain, Result};

use super::others;
use super::sets::{FIRST_SEED, Start};
use super::study::Study;
use crate::verdict::{LEVEL, Mean, chance, holm};
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{COBALT, Colour, INK, MIST, SERIES, SLATE, glaze_to_cobalt};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::summary::Summary;
use azulejo_cli::text::grouped;

/// The treatments of KDRT's sets.
#[derive(Clone, Copy, PartialEq)]
enum Treatment {
    None,
    Momentum,
    Thesis,
    Capacity,
}

const TREATMENTS: [(&str, Treatment); 4] = [
    ("KDRT", Treatment::None),
    ("relaxed, momentum", Treatment::Momentum),
    ("relaxed, thesis", Treatment::Thesis),
    ("CCVT", Treatment::Capacity),
];

impl Treatment {
    fn apply(self, context: &Context, points: Vec<[f32; 2]>, seed: u64) -> Result<Vec<[f32; 2]>> {
        let domain = Domain::unit(Boundary::Periodic);
        let options = match self {
            Self::None => return Ok(points),
            Self::Capacity => return Ok(others::Method::Capacity.relax(&points, seed).points),
            Self::Momentum => Options::new(domain, Neighbourhood::Delaunay),
            Self::Thesis => Options::thesis(domain, Neighbourhood::Delaunay),
        };
        Ok(relax(context, &options.seed(seed), &points, None)?.0)
    }

    fn set(self, context: &Context, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        let points = Start::Kdrt.points(context, Domain::unit(Boundary::Periodic), count, seed)?;
        self.apply(context, points, seed)
    }
}

/// The section.
pub fn section(study: &Study) -> Result<String> {
    let (count, sets, drawn) = if study.quick { (100, 2, 100) } else { (1000, 16, 900) };
    let domain = Domain::unit(Boundary::Periodic);
    let statistics = study.each("triangles", TREATMENTS.len() * sets, |context, i| {
        let points = TREATMENTS[i / sets].1.set(context, count, FIRST_SEED + (i % sets) as u64)?;
        triangle_statistics(context, &domain, &points, None)
    })?;
    let pictured = |(_, treatment): (&str, Treatment)| {
        let points = treatment.set(study.context, drawn, FIRST_SEED)?;
        let triangles = delaunay_triangles(study.context, &domain, &points, None)?;
        Ok((triangles, triangle_statistics(study.context, &domain, &points, None)?))
    };
    draw(&TREATMENTS.into_iter().map(pictured).collect::<Result<Vec<_>>>()?, study)?;
    let by_treatment: Vec<_> = statistics.chunks(sets).collect();
    Ok(text(&by_treatment, count, drawn))
}

/// A row of the table, which is a column of figures: its name, and its value in percent or as it is.
type Figure = (&'static str, fn(&TriangleStatistics) -> f64, bool);

const FIGURES: [Figure; 6] = [
    ("obtuse triangles", |set| set.obtuse, true),
    ("triangles with an angle below 30°", |set| set.below_30_degrees, true),
    ("angles below 30°", |set| set.angles_below_30_degrees, true),
    ("variance of edge lengths / mean²", |set| set.edge_variation, false),
    ("variance of areas / mean²", |set| set.area_variation, false),
    ("triangles beyond 4σ of the mean area", |set| set.beyond_4_sigma, true),
];

fn text(by_treatment: &[&[TriangleStatistics]], count: usize, drawn: usize) -> String {
    let mut text = format!(
        "## Remeshing (thesis fig. 4.21)\n\n\
         The Delaunay triangles of KDRT's sets of {} points on the torus, before and after relaxation with Delaunay neighbours; \
         means of {} sets and their standard errors. σ is that of each set's own areas. The picture shows sets of {drawn} \
         points. In its second row triangles are the darker the farther their area is from the mean, up to {:.0} % of it, and ochre \
         beyond 4σ; in its third, edges are ochre that are more than {:.0} % longer than the mean, and cobalt that are as much \
         shorter.\n\n\
         ![Triangles of a set before and after relaxation](dcr/remeshing.png)\n\n\
         | | {} |\n{}|\n",
        grouped(count),
        by_treatment[0].len(),
        100.0 * FULL_INK,
        100.0 * UNEVEN,
        TREATMENTS.map(|(name, _)| name).join(" | "),
        "|---".repeat(1 + TREATMENTS.len()),
    );
    for (name, of, is_share) in FIGURES {
        let cell = |sets: &&[TriangleStatistics]| {
            let Summary { mean, error, .. } = Summary::of(&sets.iter().map(of).collect::<Vec<_>>());
            match is_share {
                true => format!("{:.2} ± {:.2} %", 100.0 * mean, 100.0 * error),
                false => format!("{mean:.4} ± {error:.4}"),
            }
        };
        let cells: Vec<_> = by_treatment.iter().map(cell).collect();
        _ = writeln!(text, "| {name} | {} |", cells.join(" | "));
    }
    text + &claims(by_treatment)
}

/// The thesis's claims about CCVT and its own algorithm: by [`FIGURES`], which of the two has less.
const CLAIMS: [(usize, Treatment); 3] = [(0, Treatment::Thesis), (3, Treatment::Thesis), (4, Treatment::Capacity)];

/// The claims and whether they hold, for the thesis's algorithm and for the momentum method.
fn claims(by_treatment: &[&[TriangleStatistics]]) -> String {
    let sets = |treatment: Treatment| by_treatment[TREATMENTS.iter().position(|one| one.1 == treatment).unwrap_or(0)];
    let cases = [Treatment::Thesis, Treatment::Momentum].into_iter().flat_map(|own| CLAIMS.map(|claim| (own, claim)));
    let cases: Vec<_> = cases
        .map(|(own, (figure, less))| {
            let mean = |treatment| Mean::of(&sets(treatment).iter().map(FIGURES[figure].1).collect::<Vec<_>>());
            let [own_mean, capacity] = [mean(own), mean(Treatment::Capacity)];
            let (more, less) = if less == Treatment::Capacity { (own_mean, capacity) } else { (capacity, own_mean) };
            (own, figure, [more, less])
        })
        .collect();
    let chance_of = |[more, less]: &[Mean; 2]| more.above(less).map_or(1.0, |difference| difference.chance_of_larger());
    let corrected = holm(&cases.iter().map(|(.., means)| chance_of(means)).collect::<Vec<_>>());
    let mut text = format!(
        "\nThe thesis says that CCVT has the more even areas, DCR the more even edges and fewer obtuse triangles. With the sets \
         above, p that of no difference in that direction, corrected for all {} comparisons (Welch, Holm; reproduced where p \
         is at most {LEVEL}):\n\n| DCR | figure | p | |\n|---|---|---|---|\n",
        cases.len(),
    );
    for ((own, figure, _), p) in cases.iter().zip(corrected) {
        let name = if *own == Treatment::Thesis { "thesis" } else { "momentum" };
        let verdict = if p <= LEVEL { "reproduced" } else { "**not reproduced**" };
        _ = writeln!(text, "| {name} | {} | {} | {verdict} |", FIGURES[*figure].0, chance(p));
    }
    text
}

/// A column for each set: obtuse triangles, triangles the darker the farther their area is from the mean and in ochre
/// beyond 4σ, and edges that are much longer or shorter than the mean.
fn draw(sets: &[(Vec<Triangle>, TriangleStatistics)], study: &Study) -> Result<()> {
    let mut canvas = Canvas::new(1705.0, 1320.0, 1322);
    let style = Style { size: 21.0, colour: SLATE, align: Align::Centre, upwards: true };
    for (row, label) in ["obtuse", "area", "edges"].into_iter().enumerate() {
        canvas.text(label, [32.0, 247.0 + 420.0 * row as f32], style);
    }
    for ((column, (triangles, statistics)), (name, _)) in sets.iter().enumerate().zip(TREATMENTS) {
        let left = 50.0 + 415.0 * column as f32;
        let sheet =
            |row: f32| Sheet::new(Rect { x: left, y: 50.0 + 420.0 * row, width: 395.0, height: 395.0 }, triangles);
        canvas.text(name, [left, 36.0], Style { size: 27.0, colour: INK, align: Align::Left, upwards: false });
        let mean = triangles.iter().map(Triangle::area).sum::<f64>() / triangles.len() as f64;
        let limit = 4.0 * statistics.area_variation.sqrt() * mean;
        sheet(0.0).draw_triangles(&mut canvas, |triangle| triangle.is_obtuse().then_some(COBALT));
        sheet(1.0).draw_triangles(&mut canvas, |triangle| {
            let excess = (triangle.area() - mean).abs();
            Some(if excess > limit { SERIES[1] } else { shade(excess / mean) })
        });
        sheet(2.0).draw_edges(&mut canvas, statistics.edge_mean);
    }
    canvas.write(&study.picture("remeshing")?)
}

/// An area that differs from the mean by this share of it has all the ink; and how many inks there are.
const FULL_INK: f64 = 0.75;
const INKS: f64 = 12.0;

fn shade(excess: f64) -> Colour {
    glaze_to_cobalt((excess / FULL_INK * INKS).round() / INKS)
}

/// An edge that differs from the mean by this share of it is drawn in colour.
const UNEVEN: f64 = 0.25;

/// The unit torus in a square of the page.
struct Sheet {
    panel: Panel<'static>,
    /// The triangles and their images that reach into the square.
    triangles: Vec<Triangle>,
}

impl Sheet {
    fn new(rect: Rect, triangles: &[Triangle]) -> Self {
        let axis = || Axis::linear("", [0.0, 1.0], 0);
        let shifts = || (-1..=1).flat_map(|i| (-1..=1).map(move |j| [f64::from(i), f64::from(j)]));
        let image = |triangle: &Triangle, [dx, dy]: [f64; 2]| Triangle {
            corners: triangle.corners.map(|[x, y]| [x + dx, y + dy]),
        };
        let images = triangles.iter().flat_map(|triangle| shifts().map(|shift| image(triangle, shift)));
        let is_seen = |one: &Triangle| {
            let beyond = |axis: usize| {
                one.corners.iter().all(|corner| corner[axis] < 0.0)
                    || one.corners.iter().all(|corner| corner[axis] > 1.0)
            };
            !beyond(0) && !beyond(1)
        };
        Self { panel: Panel { rect, x: axis(), y: axis() }, triangles: images.filter(is_seen).collect() }
    }

    /// The edges of all triangles of which the length is as it shall be.
    fn segments(&self, is_drawn: impl Fn(f64) -> bool) -> Vec<[[f32; 2]; 2]> {
        let edges = self.triangles.iter().flat_map(|triangle| (0..3).map(move |i| (triangle, i)));
        let drawn = edges.filter(|&(triangle, i)| is_drawn(triangle.edges()[i]));
        let ends = |(triangle, i): (&Triangle, usize)| [triangle.corners[i], triangle.corners[(i + 1) % 3]];
        drawn.map(|edge| ends(edge).map(|end| self.panel.place(end))).collect()
    }

    /// All triangles, in the colours that they have.
    fn draw_triangles(&self, canvas: &mut Canvas, colour: impl Fn(&Triangle) -> Option<Colour>) {
        self.panel.ground(canvas, false);
        let mut by_colour = BTreeMap::<Colour, Vec<_>>::new();
        for triangle in &self.triangles {
            if let Some(colour) = colour(triangle) {
                let places = triangle.corners.map(|corner| self.panel.place(corner));
                by_colour.entry(colour).or_default().push(places);
            }
        }
        for (colour, triangles) in by_colour {
            canvas.triangles(triangles.into_iter(), colour, self.panel.rect);
        }
        canvas.segments(self.segments(|_| true).into_iter(), 1.0, MIST, self.panel.rect);
        self.panel.axes(canvas);
    }

    /// All edges, long ones in ochre and short ones in cobalt.
    fn draw_edges(&self, canvas: &mut Canvas, mean: f64) {
        self.panel.ground(canvas, false);
        let mut draw = |segments: Vec<[[f32; 2]; 2]>, width, colour| {
            canvas.segments(segments.into_iter(), width, colour, self.panel.rect);
        };
        draw(self.segments(|_| true), 1.0, MIST);
        draw(self.segments(|length| length > (1.0 + UNEVEN) * mean), 2.0, SERIES[1]);
        draw(self.segments(|length| length < (1.0 - UNEVEN) * mean), 2.0, COBALT);
        self.panel.axes(canvas);
    }
}
