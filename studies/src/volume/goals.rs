//! The goals of volumes: time and memory of a sample, density, and relaxation.

use std::cell::RefCell;
use std::path::PathBuf;
use std::process::Command;

use azulejo::analysis::space::figures_3d;
use azulejo::dcr::volume::{Options as RelaxOptions, relax};
use azulejo::volume::{InsideOptions, Options, sample, sample_inside};
use azulejo::{Boundary, Context, Domain, Error, MAXIMAL_DENSITY_IN_SPACE, Points, Result};
use azulejo_cli::text::grouped;

use super::clock::{in_turns, timed};
use super::{Effort, Scene};
use crate::goals::row::{Figure, Goal, Row};
use crate::reference::stream;
use crate::timing::Rounds;

/// Microseconds of a sample: of a torus, and inside of the mesh.
const TORUS: f64 = 1.7;
const INSIDE: f64 = 3.0;
/// Percent by which N·r³ may differ from that of unbiased sets.
const DENSITY: f64 = 0.3;
/// The time of a sample of the largest set over that of one of a smaller set: what is linear, up to caches.
const LINEAR: f64 = 1.1;
const BYTES: f64 = 40.0;
/// Steps of the relaxation, the nanoseconds of a point and step, and what the set reaches.
const STEPS: u32 = 100;
const STEP: f64 = 120.0;
const RHO: f64 = 0.935;
const COVER: f64 = 0.80;

/// Sets whose bytes are measured, and the least samples of one: for fewer the memory of the process is not fine enough.
const MEASURED: usize = 3;
const LEAST: f64 = 1e5;

/// The radius of about so many samples of a volume.
pub fn radius(volume: f64, count: f64) -> f64 {
    (MAXIMAL_DENSITY_IN_SPACE * volume / count).cbrt()
}

/// The rows of all goals.
pub fn rows(scene: &Scene) -> Result<Vec<Row>> {
    let mut rows = filled(scene)?;
    rows.push(memory(scene.effort)?);
    rows.extend(relaxed(scene)?);
    Ok(rows)
}

/// The time of a sample of a torus, of more of them, and inside of a mesh; one thread, a seed for each round.
fn filled(scene: &Scene) -> Result<Vec<Row>> {
    let Effort { rounds, count, largest, .. } = scene.effort;
    let (name, mesh) = &scene.mesh;
    let counts = RefCell::new(Vec::new());
    let torus = |count: f64, seed: u64| {
        let options = Options::new(radius(1.0, count)).seed(seed);
        sample(&scene.one, &options, None).map(|(points, report)| (points.len(), report.radius))
    };
    let plain = || {
        let (samples, radius) = torus(count, counts.borrow().len() as u64 + 1)?;
        counts.borrow_mut().push(samples as f64 * radius.powi(3));
        Ok(samples)
    };
    let large = || Ok(torus(largest, 1)?.0);
    let (low, high) = mesh.bounds();
    let within = volume(scene, low, high)?;
    let inside = InsideOptions::new(radius(within, count)).seed(1);
    let inside = || Ok(sample_inside(&scene.one, mesh, &inside, None)?.0.len());
    let mut calls: Vec<&dyn Fn() -> Result<usize>> = vec![&plain, &inside];
    if largest > 0.0 {
        calls.push(&large);
    }
    let times = in_turns(rounds, &calls)?;
    let per_sample = |times: &Rounds, of: &str, goal| {
        let figure = Figure::time(times, 1e6 / times.samples as f64);
        Row::new(format!("{of}: {} samples, time of one", grouped(times.samples)), figure, "µs", Goal::AtMost(goal))
    };
    let mut rows =
        vec![per_sample(&times[0], "torus", TORUS), per_sample(&times[1], &format!("inside {name}"), INSIDE)];
    if let [plain, _, large] = &times[..] {
        let ratio = |(large_one, one): (&f64, &f64)| (large_one / large.samples as f64) / (one / plain.samples as f64);
        let figure = Figure::of_rounds(large.seconds.iter().zip(&plain.seconds).map(ratio));
        let [large, plain] = [large, plain].map(|times| grouped(times.samples));
        let asked = format!("torus: time of one of {large} samples over that of one of {plain}");
        rows.push(Row::new(asked, figure, "×", Goal::AtMost(LINEAR)));
    }
    let off = |density: &f64| 100.0 * (density / MAXIMAL_DENSITY_IN_SPACE - 1.0).abs();
    let counts = counts.into_inner();
    let asked = format!("torus: N·r³ off {MAXIMAL_DENSITY_IN_SPACE:.4}, {} sets", counts.len());
    rows.push(Row::new(asked, Figure::largest(counts.iter().map(off)), "%", Goal::AtMost(DENSITY)));
    Ok(rows)
}

/// The volume inside of a mesh, by random places of the box around it.
fn volume(scene: &Scene, low: [f32; 3], high: [f32; 3]) -> Result<f64> {
    let places = super::tables::places_inside(scene, 0)?;
    let whole: f64 = low.iter().zip(&high).map(|(low, high)| f64::from(high - low)).product();
    Ok(whole * places.len() as f64 / scene.effort.probes as f64)
}

/// The bytes of a sample, in processes of their own.
fn memory(effort: Effort) -> Result<Row> {
    let count = effort.count.max(LEAST);
    let all: Vec<f64> = (0..MEASURED).map(|_| in_a_process_of_its_own(count)).collect::<Result<_>>()?;
    let asked = format!(
        "torus: memory of one of about {} samples, its position in the result included",
        grouped(count as usize)
    );
    Ok(Row::new(asked, Figure::largest(all), "bytes", Goal::AtMost(BYTES)))
}

fn in_a_process_of_its_own(count: f64) -> Result<f64> {
    let program = std::env::current_exe().map_err(|source| Error::Io { path: PathBuf::new(), source })?;
    let mut command = Command::new(&program);
    command.args(["volume", "--memory", &count.to_string()]).envs(crate::goals::memory::ALLOCATOR);
    let output = command.output().map_err(|source| Error::Io { path: program.clone(), source })?;
    let said = String::from_utf8_lossy(&output.stdout);
    let complaint = || String::from_utf8_lossy(&output.stderr).trim().to_owned();
    said.trim().parse().map_err(|_| Error::Io { path: program, source: std::io::Error::other(complaint()) })
}

/// The bytes that a fill of the unit torus on one thread takes, over its samples.
pub fn bytes_per_sample(count: f64) -> Result<f64> {
    let context = Context::new(1)?;
    let options = Options::new(radius(1.0, count));
    let (points, bytes): (Points<3>, f64) = crate::goals::memory::grown(|| Ok(sample(&context, &options, None)?.0))?;
    Ok(bytes / points.len() as f64)
}

/// Random points of a torus, relaxed on one thread.
fn relaxed(scene: &Scene) -> Result<[Row; 3]> {
    let Effort { rounds, relaxed, .. } = scene.effort;
    let domain = Domain { min: [0.0; 3], max: [1.0; 3], boundary: Boundary::Periodic };
    let (mut rhos, mut covers, mut times) = (Vec::new(), Vec::new(), Rounds::default());
    for seed in 0..rounds as u64 {
        let mut unit = stream(seed);
        let start: Vec<[f32; 3]> = (0..relaxed as usize).map(|_| std::array::from_fn(|_| unit())).collect();
        let options = RelaxOptions::new(domain).max_iterations(STEPS).tolerance(0.0);
        let ((points, report), seconds) = timed(|| relax(&scene.one, &options, &start, None))?;
        times.samples = start.len() * report.iterations as usize;
        times.seconds.push(seconds);
        let figures = figures_3d(scene.all, &domain, &points, 0.0, None)?;
        rhos.push(figures.rho());
        covers.push(figures.relative_covering_radius());
    }
    let of = format!("torus: {} random points, {STEPS} steps", grouped(relaxed as usize));
    let time = Figure::time(&times, 1e9 / times.samples as f64);
    Ok([
        Row::new(
            format!("{of}: smallest distance over that of the densest packing"),
            Figure::least(rhos),
            "",
            Goal::AtLeast(RHO),
        ),
        Row::new(format!("{of}: covering radius over the same"), Figure::largest(covers), "", Goal::AtMost(COVER)),
        Row::new(format!("{of}: time of a point and step"), time, "ns", Goal::AtMost(STEP)),
    ])
}
