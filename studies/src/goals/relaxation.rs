//! Relaxation on meshes.

use std::sync::Arc;

use azulejo::dcr::surface::{Options, relax};
use azulejo::mesh::Mesh;
use azulejo::{Context, Points, Result, psp};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::psp::scenes::radius;
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::grouped;

/// Samples of which a step is timed, and the nanoseconds of a sample and step: about one triangle per sample, and ten.
const SAMPLES: f64 = 1e5;
const SMALL: f64 = 150.0;
const DRAGON: f64 = 250.0;
/// Samples on the dragon that are relaxed in a whole call, and its seconds.
const FEW: (f64, f64) = (2000.0, 0.3);
const TWO_THREADS: f64 = 1.8;

/// Steps of the short and of the long run: their difference has no time before the first step in it.
const STEPS: [u32; 2] = [10, 40];

pub fn section(study: &Study) -> Result<String> {
    let mut rows = Vec::new();
    let (name, mesh) = &study.small;
    rows.extend(of_steps(study, name, mesh, SMALL)?);
    if let Some(dragon) = &study.dragon {
        rows.extend(of_steps(study, "dragon", &dragon.mesh, DRAGON)?);
        let few = start(study, &dragon.mesh, study.effort.of(FEW.0))?;
        let call = || relaxed(&study.one, &dragon.mesh, &few, &Options::default());
        let measured = in_turns(study.effort.rounds, &[&call])?;
        let asked = format!("dragon: a whole call for {} samples", grouped(few.len()));
        rows.push(Row::new(asked, Figure::time(&measured[0], 1.0), "s", Goal::AtMost(FEW.1)));
    }
    let about = format!(
        "From maximal sets, at the default options. The time of a step is that of {} steps less that of {}.",
        STEPS[1], STEPS[0]
    );
    Ok(rows_in("Relaxation on meshes", &about, &rows))
}

fn start(study: &Study, mesh: &Arc<Mesh>, count: f64) -> Result<Points<3>> {
    Ok(psp::sample(&study.two, mesh, &psp::Options::new(radius(mesh, count)).seed(1), None)?.0)
}

fn relaxed(context: &Context, mesh: &Mesh, start: &Points<3>, options: &Options) -> Result<usize> {
    Ok(relax(context, mesh, &start.triangles, &start.barycentrics, options, None)?.0.len())
}

/// The time of a sample and step on one thread, and that of two threads beside it.
fn of_steps(study: &Study, name: &str, mesh: &Arc<Mesh>, goal: f64) -> Result<[Row; 2]> {
    let start = start(study, mesh, study.effort.of(SAMPLES))?;
    let call = |context, steps| {
        let (mesh, start, options) = (mesh, &start, Options::default().max_iterations(steps).tolerance(0.0));
        move || relaxed(context, mesh, start, &options)
    };
    let [[a, b], [c, d]] = [&study.one, &study.two].map(|context| STEPS.map(|steps| call(context, steps)));
    let measured = in_turns(study.effort.rounds, &[&a, &b, &c, &d])?;
    let steps = |short: &Rounds, long: &Rounds| Rounds {
        samples: long.samples,
        seconds: long.seconds.iter().zip(&short.seconds).map(|(long, short)| long - short).collect(),
    };
    let [one, two] = [0, 2].map(|first| steps(&measured[first], &measured[first + 1]));
    let each = 1e9 / (f64::from(STEPS[1] - STEPS[0]) * start.len() as f64);
    let what = format!("{name} ({}): {} samples", grouped(mesh.triangles().len()), grouped(start.len()));
    Ok([
        Row::new(format!("{what}, a sample and step"), Figure::time(&one, each), "ns", Goal::AtMost(goal)),
        Row::new(
            format!("{what}, a step on one thread over two"),
            Figure::ratio(&one, &two),
            "×",
            Goal::AtLeast(TWO_THREADS),
        ),
    ])
}
