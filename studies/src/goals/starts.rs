//! Relaxation from starts that are heaped or in order.

use std::cell::RefCell;
use std::fmt::Write;

use azulejo::dcr::{self, Neighbourhood, Options};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Domain, Result};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::reference::stream;
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::{grouped, rounded};

const POINTS: f64 = 8000.0;
/// The time over that of a uniform start, the smallest distance and the covering radius in units of the hexagonal
/// distance.
const TIME: f64 = 1.5;
const RHO: f64 = 0.855;
const COVER: f64 = 0.67;
/// The time over that of a uniform start on a mesh, from a heap on one triangle.
const TIME_ON_MESH: f64 = 3.0;

/// The starts, of which the first is uniform.
const STARTS: [&str; 8] = ["uniform", "corner", "line", "ring", "heaps", "one place", "Gaussian", "lattice"];

/// The points of a start.
fn points(start: &str, count: usize) -> Vec<[f32; 2]> {
    let mut unit = stream(1);
    let side = (count as f64).sqrt().ceil() as usize;
    let mut point = |i: usize| {
        let [x, y] = [unit(), unit()].map(f64::from);
        // Box and Muller.
        let gaussian = |share: f64| (-2.0 * (1.0 - x).ln()).sqrt() * (std::f64::consts::TAU * y).cos() * share;
        let turn = std::f64::consts::TAU * x;
        let place = match start {
            "corner" => [0.05 * x, 0.05 * y],
            "line" => [x, 0.5],
            "ring" => [0.5 + 0.3 * turn.cos(), 0.5 + 0.3 * turn.sin()],
            "heaps" => [[0.2, 0.3], [0.7, 0.2], [0.6, 0.8]][i % 3],
            "one place" => [0.5; 2],
            "Gaussian" => {
                let radius = (-2.0 * (1.0 - x).ln()).sqrt();
                let turn = std::f64::consts::TAU * y;
                [0.5 + 0.1 * radius * turn.cos(), 0.5 + 0.1 * radius * turn.sin()]
            }
            "lattice" => [(i % side) as f64 / side as f64, (i / side) as f64 / side as f64],
            _ => [x, y],
        };
        let heap = if start == "heaps" { [gaussian(0.02), gaussian(0.02)] } else { [0.0; 2] };
        [0, 1].map(|axis| ((place[axis] + heap[axis]).rem_euclid(1.0) as f32).min(1.0f32.next_down()))
    };
    (0..count).map(&mut point).collect()
}

/// The end of a relaxation from a start.
struct Ended {
    start: &'static str,
    boundary: Boundary,
    time: Figure,
    rho: f64,
    cover: f64,
    steps: u32,
}

pub fn section(study: &Study) -> Result<String> {
    let mut ended = in_plane(study, Boundary::Periodic)?;
    ended.extend(in_plane(study, Boundary::Bounded)?);
    let mut rows: Vec<_> =
        [Boundary::Periodic, Boundary::Bounded].into_iter().flat_map(|one| worst(&ended, one)).collect();
    rows.push(on_mesh(study)?);
    let about = format!(
        "{} points of the unit square, relaxed at the default options, in turns with uniform random ones; the worst of all starts, \
         which the table below has.",
        grouped(study.effort.of(POINTS) as usize)
    );
    Ok(rows_in("Relaxation from any start", &about, &rows) + "\n" + &table(&ended))
}

fn in_plane(study: &Study, boundary: Boundary) -> Result<Vec<Ended>> {
    let options = Options::new(Domain::unit(boundary), Neighbourhood::Delaunay);
    let count = study.effort.of(POINTS) as usize;
    let reports = RefCell::new(vec![None; STARTS.len()]);
    let calls: Vec<_> = STARTS
        .into_iter()
        .enumerate()
        .map(|(i, start)| {
            let (points, reports) = (points(start, count), &reports);
            move || {
                let (relaxed, report) = dcr::relax(&study.one, &options, &points, None)?;
                reports.borrow_mut()[i] = Some(report);
                Ok(relaxed.len())
            }
        })
        .collect();
    let calls: Vec<_> = calls.iter().map(|call| call as &dyn Fn() -> Result<usize>).collect();
    let measured = in_turns(study.effort.rounds, &calls)?;
    let ended = |((start, rounds), report): ((&'static str, &Rounds), &Option<dcr::Report>)| {
        let report = report.as_ref()?;
        let time = Figure::ratio(rounds, &measured[0]);
        Some(Ended {
            start,
            boundary,
            time,
            rho: report.rho,
            cover: report.relative_covering_radius,
            steps: report.iterations,
        })
    };
    Ok(STARTS.into_iter().zip(&measured).zip(reports.borrow().iter()).filter_map(ended).collect())
}

fn name(boundary: Boundary) -> &'static str {
    if boundary == Boundary::Periodic { "periodic" } else { "bounded" }
}

/// The worst of the starts that are not uniform.
fn worst(ended: &[Ended], boundary: Boundary) -> [Row; 3] {
    let starts = || ended.iter().filter(move |one| one.boundary == boundary && one.start != STARTS[0]);
    let worst = |key: fn(&Ended) -> f64| {
        let most = starts().max_by(|a, b| key(a).total_cmp(&key(b)));
        most.map_or("", |one| one.start)
    };
    let (time, rho, cover) = (worst(|one| one.time.value), worst(|one| -one.rho), worst(|one| one.cover));
    let name = name(boundary);
    [
        Row::new(
            format!("{name}, time over a uniform start ({time})"),
            Figure::largest(starts().map(|one| one.time.value)),
            "×",
            Goal::AtMost(TIME),
        ),
        Row::new(format!("{name}, ρ ({rho})"), Figure::least(starts().map(|one| one.rho)), "", Goal::AtLeast(RHO)),
        Row::new(
            format!("{name}, covering radius ({cover})"),
            Figure::largest(starts().map(|one| one.cover)),
            "",
            Goal::AtMost(COVER),
        ),
    ]
}

fn table(ended: &[Ended]) -> String {
    let mut text = "| start | boundary | time over uniform | range | ρ | covering radius | steps |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for Ended { start, boundary, time, rho, cover, steps } in ended {
        let [low, high] = time.range.map(|ratio| rounded(ratio, 3));
        let time = rounded(time.value, 4);
        _ = writeln!(
            text,
            "| {start} | {} | {time} | {low} to {high} | {rho:.4} | {cover:.4} | {steps} |",
            name(*boundary)
        );
    }
    text
}

/// All samples on one triangle, against uniform random ones.
fn on_mesh(study: &Study) -> Result<Row> {
    let (name, mesh) = &study.small;
    let count = study.effort.of(POINTS) as usize;
    let mut unit = stream(2);
    let inside = |[u, v]: [f32; 2]| if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
    let barycentrics: Vec<_> = (0..count).map(|_| inside([unit(), unit()])).collect();
    let uniform = on_triangles(mesh, count, &mut unit);
    let heap = vec![mesh.triangles().len() as u32 / 2; count];
    let relax = |triangles: &[u32]| {
        let options = dcr::surface::Options::default();
        Ok(dcr::surface::relax(&study.one, mesh, triangles, &barycentrics, &options, None)?.0.len())
    };
    let measured = in_turns(study.effort.rounds, &[&|| relax(&heap), &|| relax(&uniform)])?;
    let asked = format!("{name}: {} samples on one triangle, time over a uniform start", grouped(count));
    Ok(Row::new(asked, Figure::ratio(&measured[0], &measured[1]), "×", Goal::AtMost(TIME_ON_MESH)))
}

/// The triangles of uniform random samples.
fn on_triangles(mesh: &Mesh, count: usize, unit: &mut impl FnMut() -> f32) -> Vec<u32> {
    let mut sum = 0.0;
    let areas = (0..mesh.triangles().len() as u32).map(|triangle| mesh.triangle_area(triangle));
    let sums: Vec<f64> = areas
        .map(|area| {
            sum += area;
            sum
        })
        .collect();
    let triangle = |share: f64| sums.partition_point(|&end| end <= share * sum).min(sums.len() - 1) as u32;
    (0..count).map(|_| triangle(f64::from(unit()))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_are_what_they_are_called() {
        for start in STARTS {
            let points = points(start, 400);
            assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{start}");
            let mean = [0, 1].map(|axis| points.iter().map(|point| f64::from(point[axis])).sum::<f64>() / 400.0);
            let spread =
                points.iter().flatten().map(|x| f64::from(*x)).fold([1.0f64, 0.0f64], |[a, b], x| [a.min(x), b.max(x)]);
            match start {
                "corner" => assert!(spread[1] < 0.05),
                "one place" => assert_eq!(spread, [0.5; 2]),
                "ring" => {
                    let away = |[x, y]: &[f32; 2]| f64::from((x - 0.5).hypot(y - 0.5));
                    assert!(points.iter().all(|point| (away(point) - 0.3).abs() < 1e-6));
                }
                "lattice" => assert_eq!(points[21], [0.05, 0.05]),
                _ => assert!(spread[1] - spread[0] > 0.5 && mean.iter().all(|x| (0.3..0.7).contains(x)), "{start}"),
            }
        }
    }
}
