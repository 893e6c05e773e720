//! Sets around obstacles, and of exactly so many samples.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Given, MAXIMAL_DENSITY, Result, kdrt, psp};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::psp::scenes::radius;
use crate::reference::stream;
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::grouped;

/// Obstacles, the samples of the set around them, and the microseconds that each may cost.
const OBSTACLES: f64 = 1e5;
const SAMPLES: f64 = 1e6;
const COST: f64 = 2.0;
/// From which to which clearance they are, in radii, evenly in their logarithms.
const CLEARANCES: [[f64; 2]; 2] = [[0.001, 30.0], [0.001, 0.1]];
/// Numbers of samples that are asked for exactly, and their time over that of a set of a known radius.
const EXACTLY: [f64; 3] = [1e4, 1e5, 1e6];
const EXACTLY_ON_DRAGON: [f64; 3] = [1e3, 1e4, 1e5];
const EXACTLY_GOAL: f64 = 2.5;

pub fn section(study: &Study) -> Result<String> {
    let mut rows = in_plane(study)?;
    rows.extend(on_mesh(study)?);
    let (name, mesh) = &study.small;
    for count in EXACTLY {
        rows.push(exactly(study, name, mesh, study.effort.of(count))?);
    }
    if let Some(dragon) = &study.dragon {
        for count in EXACTLY_ON_DRAGON {
            rows.push(exactly(study, "dragon", &dragon.mesh, study.effort.of(count))?);
        }
    }
    let about = "An obstacle costs the time of the set around all of them, less that of the set without, over their number: nothing or \
        less where they cover what would have to be filled. Clearances are even in their logarithms. What sets of exactly N \
        samples lose of maximality is in [order.md](order.md).";
    Ok(rows_in("Given samples and exact numbers", about, &rows))
}

/// Clearances between two bounds, in radii.
fn clearances([low, high]: [f64; 2], radius: f64, count: usize) -> Vec<f64> {
    let mut unit = stream(7);
    (0..count).map(|_| radius * low * (high / low).powf(f64::from(unit()))).collect()
}

/// The row of a call without obstacles and of one with them.
fn cost(study: &Study, what: &str, obstacles: usize, calls: [&dyn Fn() -> Result<usize>; 2]) -> Result<Row> {
    let measured = in_turns(study.effort.rounds, &calls)?;
    let each = |with: f64, without: f64| 1e6 * (with - without) / obstacles as f64;
    let [without, with] = [&measured[0], &measured[1]];
    let rounds = with.seconds.iter().zip(&without.seconds).map(|(&with, &without)| each(with, without));
    let asked = format!("{what}: each of {} obstacles", grouped(obstacles));
    Ok(Row::new(asked, Figure::of_rounds(rounds), "µs", Goal::AtMost(COST)))
}

fn in_plane(study: &Study) -> Result<Vec<Row>> {
    let (samples, count) = (study.effort.of(SAMPLES), study.effort.of(OBSTACLES) as usize);
    let radius = (MAXIMAL_DENSITY / samples).sqrt();
    let options = kdrt::Options::new(radius).seed(1);
    let mut unit = stream(3);
    let positions: Vec<_> = (0..count).map(|_| [unit(), unit()]).collect();
    let row = |bounds: [f64; 2]| {
        let clearances = clearances(bounds, radius, count);
        let around = options.given(Given::with_clearances(&positions, &clearances));
        let what = format!("plane, {} samples, {} to {} r", grouped(samples as usize), bounds[0], bounds[1]);
        let set = |options: &kdrt::Options| Ok(kdrt::sample(&study.one, options, None)?.len());
        cost(study, &what, count, [&|| set(&options), &|| set(&around)])
    };
    CLEARANCES.into_iter().map(row).collect()
}

fn on_mesh(study: &Study) -> Result<Vec<Row>> {
    let (name, mesh) = &study.small;
    let (samples, count) = (study.effort.of(SAMPLES), study.effort.of(OBSTACLES) as usize);
    let radius_of_set = radius(mesh, samples);
    let options = psp::Options::new(radius_of_set).seed(1);
    // Samples of another set scatter over the surface.
    let other = psp::sample(&study.two, mesh, &psp::Options::new(radius(mesh, 1.2 * count as f64)).seed(2), None)?.0;
    let on_surface: Vec<_> = other.positions.into_iter().take(count).collect();
    let (low, high) = mesh.bounds();
    let mut unit = stream(4);
    let mut place = || [0, 1, 2].map(|axis| low[axis] + unit() * (high[axis] - low[axis]));
    let in_box: Vec<_> = (0..count).map(|_| place()).collect();
    let kinds = [("on it", &on_surface), ("anywhere in its box", &in_box)];
    let rows = kinds.into_iter().flat_map(|kind| CLEARANCES.map(|bounds| (kind, bounds)));
    let row = |((where_, positions), bounds): ((&str, &Vec<[f32; 3]>), [f64; 2])| {
        let clearances = clearances(bounds, radius_of_set, positions.len());
        let around = options.given(Given::with_clearances(positions, &clearances));
        let what = format!("{name}, {} samples, {} to {} r, {where_}", grouped(samples as usize), bounds[0], bounds[1]);
        let set = |options: &psp::Options| Ok(psp::sample(&study.one, mesh, options, None)?.0.len());
        cost(study, &what, positions.len(), [&|| set(&options), &|| set(&around)])
    };
    rows.map(row).collect()
}

fn exactly(study: &Study, name: &str, mesh: &Arc<Mesh>, count: f64) -> Result<Row> {
    let set = |options: psp::Options| Ok(psp::sample(&study.one, mesh, &options, None)?.0.len());
    let known = || set(psp::Options::new(radius(mesh, count)).seed(1));
    let exact = || set(psp::Options::by_count(count as usize).seed(1));
    let measured = in_turns(study.effort.rounds, &[&exact, &known])?;
    let asked = format!("{name}: exactly {} samples, over a set of a known radius", grouped(measured[0].samples));
    // Per sample: the numbers are not quite the same.
    let [exact, known] = [&measured[0], &measured[1]].map(|rounds| Rounds {
        samples: 1,
        seconds: rounds.seconds.iter().map(|seconds| seconds / rounds.samples.max(1) as f64).collect(),
    });
    Ok(Row::new(asked, Figure::ratio(&exact, &known), "×", Goal::AtMost(EXACTLY_GOAL)))
}
