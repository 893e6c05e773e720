//! Relaxation on meshes (the future work of thesis chapter 4): distances and triangles, before and after.

use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;

use azulejo::analysis::triangles::{Triangle, TriangleStatistics};
use azulejo::dcr::surface::{Options, RemeshReport, relax, remesh};
use azulejo::mesh::Mesh;
use azulejo::{Context, Points, Progress, Result, psp};
use glam::{DVec2, DVec3};

use super::sets::FIRST_SEED;
use super::spacing::{self, SETS, Spacing};
use super::study::Study;
use crate::psp::scenes;
use azulejo_cli::draw::canvas::{Align, Canvas, Rect, Style};
use azulejo_cli::draw::palette::{COBALT, INK, MIST};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};

/// About how many samples a mesh gets.
const COUNTS: [f64; 2] = [20_000.0, 100_000.0];

/// Samples of one mesh, with their triangles.
struct Remeshed {
    samples: Points<3>,
    triangles: Vec<[u32; 3]>,
    report: RemeshReport,
    statistics: TriangleStatistics,
    /// In units of d_max the smallest distance of two samples through space, and of two that are joined by a triangle;
    /// the mean distance to the nearest sample.
    rho: f64,
    joined: f64,
    nearest: f64,
}

/// A set before and after relaxation.
struct Case {
    mesh: &'static str,
    triangles: usize,
    sets: [Remeshed; 2],
    steps: u32,
    /// Steps times samples per second.
    rate: f64,
}

/// The section.
pub fn section(study: &Study) -> Result<String> {
    let mut meshes = vec![("sphere", scenes::sphere()?)];
    let files = [("bunny", study.bunny), ("dragon", study.dragon)];
    for (name, path) in files.into_iter().filter_map(|(name, path)| Some((name, path?))) {
        meshes.push((name, Arc::new(Mesh::load(path)?)));
    }
    let counts = if study.quick { &[600.0] } else { &COUNTS[..] };
    let kinds: Vec<_> = meshes.iter().flat_map(|mesh| counts.iter().map(move |&count| (mesh, count))).collect();
    let measure = |progress: &Progress| {
        let measured = kinds.iter().enumerate().map(|(done, ((name, mesh), count))| {
            _ = progress(done as f64 / kinds.len() as f64);
            Case::measure(study.context, name, mesh, *count)
        });
        measured.collect::<Result<Vec<_>>>()
    };
    let cases = watched("surfaces", measure)?;
    let sets = if study.quick { 2 } else { SETS };
    let spacings = watched("spacing", |_| {
        let measured =
            kinds.iter().map(|((name, mesh), count)| Spacing::measure(study.context, name, mesh, *count, sets));
        measured.collect::<Result<Vec<_>>>()
    })?;
    // The first set of the bunny, or of the sphere where there is none.
    let pictured = cases.iter().find(|case| case.mesh == "bunny").unwrap_or(&cases[0]);
    draw(pictured, study)?;
    Ok(text(study, &cases, &spacings, pictured))
}

impl Case {
    fn measure(context: &Context, name: &'static str, mesh: &Arc<Mesh>, count: f64) -> Result<Self> {
        let options = psp::Options::new(scenes::radius(mesh, count)).seed(FIRST_SEED);
        let (start, _) = psp::sample(context, mesh, &options, None)?;
        let options = Options::default().seed(FIRST_SEED);
        let clock = Instant::now();
        let (relaxed, report) = relax(context, mesh, &start.triangles, &start.barycentrics, &options, None)?;
        let seconds = clock.elapsed().as_secs_f64();
        let rate = f64::from(report.iterations) * start.len() as f64 / seconds;
        // Zero steps only measure.
        let none = options.max_iterations(0);
        let (_, before) = relax(context, mesh, &start.triangles, &start.barycentrics, &none, None)?;
        let sets =
            [Remeshed::new(context, mesh, start, before.rho)?, Remeshed::new(context, mesh, relaxed, report.rho)?];
        Ok(Self { mesh: name, triangles: mesh.triangles().len(), sets, steps: report.iterations, rate })
    }
}

impl Remeshed {
    fn new(context: &Context, mesh: &Mesh, samples: Points<3>, rho: f64) -> Result<Self> {
        let (made, report) = remesh(context, mesh, &samples.triangles, &samples.barycentrics, None)?;
        let faces = made.triangles();
        let corners = |corners: &[u32; 3]| corners.map(|corner| samples.positions[corner as usize]);
        let triangles: Vec<Triangle> = faces.iter().map(|face| Triangle::in_space(corners(face))).collect();
        // The nearest sample is a neighbour in the triangulation.
        let mut nearest = vec![f64::INFINITY; samples.len()];
        for (corners, triangle) in faces.iter().zip(&triangles) {
            for (i, length) in triangle.edges().into_iter().enumerate() {
                for end in [corners[i], corners[(i + 1) % 3]] {
                    nearest[end as usize] = nearest[end as usize].min(length);
                }
            }
        }
        let known: Vec<f64> = nearest.into_iter().filter(|length| length.is_finite()).collect();
        let d_max = (2.0 * mesh.area() / (3f64.sqrt() * samples.len() as f64)).sqrt();
        let joined = known.iter().copied().fold(f64::INFINITY, f64::min) / d_max;
        let nearest = known.iter().sum::<f64>() / (known.len() as f64 * d_max);
        let statistics = TriangleStatistics::of(&triangles);
        Ok(Self { statistics, triangles: faces.to_vec(), report, samples, rho, joined, nearest })
    }
}

fn text(study: &Study, cases: &[Case], spacings: &[Spacing], pictured: &Case) -> String {
    let mut text = format!(
        "## Surfaces\n\n\
         PSP's maximal sets on meshes, before and after they are relaxed on the surface; seed {FIRST_SEED}. d_max is that of a \
         plane of the mesh's area. *ρ* is the smallest straight distance through space of any two samples, on whatever \
         sheets they are, *joined* that of two samples that are joined by a triangle, *nearest* the mean distance to the nearest \
         of these. The triangles are those of `remesh` (thesis fig. 1.12); *disputed* is the share of those that are not in the \
         local Delaunay stars of all three corners, *boundary* the number of edges with one triangle, *bad vertices* that of \
         samples at which the triangles are not one fan, *unused* that of samples without a triangle. Steps times samples per second \
         are those of one call on {} threads, mesh adjacency included.\n\n\
         | mesh | triangles | samples | | ρ | joined | nearest | obtuse | below 30° | edge CV² | area CV² | beyond 4σ | smallest angle | mean smallest | disputed | boundary | bad vertices | unused | Euler | steps | \
         M steps·samples/s |\n{}|\n",
        study.context.num_threads(),
        "|---".repeat(21),
    );
    for case in cases {
        for (name, set) in ["PSP", "relaxed"].into_iter().zip(&case.sets) {
            let Remeshed { samples, report, statistics, rho, joined, nearest, .. } = set;
            let (steps, rate) = match name {
                "PSP" => (String::new(), String::new()),
                _ => (case.steps.to_string(), rounded(case.rate / 1e6, 2)),
            };
            _ = writeln!(
                text,
                "| {} | {} | {} | {name} | {rho:.3} | {joined:.3} | {nearest:.3} | {:.1} % | {:.3} % | {:.4} | {:.4} | {:.3} % | {:.1}° | {:.1}° | {:.2} % | \
                 {} | {} | {} | {} | {steps} | {rate} |",
                case.mesh,
                grouped(case.triangles),
                grouped(samples.len()),
                100.0 * statistics.obtuse,
                100.0 * statistics.below_30_degrees,
                statistics.edge_variation,
                statistics.area_variation,
                100.0 * statistics.beyond_4_sigma,
                report.quality.smallest_angle,
                report.quality.mean_smallest_angle,
                100.0 * report.disputed as f64 / report.triangles as f64,
                grouped(report.quality.boundary_edges as usize),
                grouped(report.quality.non_manifold_vertices as usize),
                grouped(report.quality.unused_vertices as usize),
                report.quality.euler,
            );
        }
    }
    text += &spacing::table(spacings);
    for (name, path) in [("bunny", study.bunny), ("dragon", study.dragon)] {
        if path.is_none() {
            _ = writeln!(text, "\nThe {name} is left out: it was not given (`--{name}`).");
        }
    }
    _ = writeln!(
        text,
        "\n![A part of the {}, triangulated by its samples before and after; obtuse triangles in \
         cobalt](dcr/surfaces.png)",
        pictured.mesh
    );
    text
}

/// The extent of the surface that is drawn, in nearest distances from the middle.
const REACH: f64 = 13.0;

/// The triangles around the foremost place, seen along its normal, before and after.
fn draw(case: &Case, study: &Study) -> Result<()> {
    let mut canvas = Canvas::new(1240.0, 670.0, 1240);
    let [start, _] = &case.sets;
    let position = |set: &Remeshed, sample: u32| DVec3::from(set.samples.positions[sample as usize].map(f64::from));
    let foremost =
        (0..start.samples.len() as u32).max_by(|&a, &b| position(start, a).z.total_cmp(&position(start, b).z));
    let centre = foremost.unwrap_or(0);
    let (from, normal) = (position(start, centre), DVec3::from(start.samples.normals[centre as usize].map(f64::from)));
    let (x, y) = normal.any_orthonormal_pair();
    let length = REACH * start.statistics.edge_mean;
    for (column, (name, set)) in ["PSP", "relaxed"].into_iter().zip(&case.sets).enumerate() {
        let rect = Rect { x: 20.0 + 610.0 * column as f32, y: 50.0, width: 590.0, height: 590.0 };
        let title = format!("{}, {name}", case.mesh);
        let style = Style { size: 27.0, colour: INK, align: Align::Left, upwards: false };
        canvas.text(&title, [rect.x, 36.0], style);
        let axis = || Axis::linear("", [-length, length], 0);
        let panel = Panel { rect, x: axis(), y: axis() };
        panel.ground(&mut canvas, false);
        let offset = |sample: u32| position(set, sample) - from;
        let near =
            set.triangles.iter().filter(|corners| corners.iter().all(|&corner| offset(corner).length() < 1.6 * length));
        let seen: Vec<_> = near
            .map(|corners| {
                let places = corners.map(|corner| {
                    let place = DVec2::new(offset(corner).dot(x), offset(corner).dot(y));
                    panel.place(place.to_array())
                });
                (places, Triangle::in_space(corners.map(|corner| set.samples.positions[corner as usize])))
            })
            .collect();
        let obtuse = seen.iter().filter(|(_, triangle)| triangle.is_obtuse());
        canvas.triangles(obtuse.map(|(places, _)| *places), COBALT, rect);
        let edges = seen.iter().flat_map(|(places, _)| (0..3).map(|i| [places[i], places[(i + 1) % 3]]));
        canvas.segments(edges.collect::<Vec<_>>().into_iter(), 1.0, MIST, rect);
        panel.axes(&mut canvas);
    }
    canvas.write(&study.picture("surfaces")?)
}
