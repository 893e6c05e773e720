//! Sets on meshes that are filled: few samples on many triangles, many on few, threads and memory.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options};
use azulejo::{Context, Result};

use super::memory;
use super::row::{Figure, Goal, Row, section as rows_in};
use super::{Dragon, Study};
use crate::psp::scenes::{divided, radius};
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::grouped;

/// Samples on the dragon and the milliseconds that they may take, and the memory in MB.
const ON_DRAGON: [(f64, f64); 3] = [(1e3, 15.0), (1e4, 30.0), (1e5, 150.0)];
const MEMORY: f64 = 10.0;
/// Triangles of a huge mesh, the samples on it and their milliseconds.
const HUGE: f64 = 1e7;
const ON_HUGE: (f64, f64) = (1e3, 110.0);
/// Samples on the bunny, and their seconds.
const ON_SMALL: (f64, f64) = (1e6, 1.0);
/// The samples of which two threads have to be so many times as fast as one.
const BY_THREADS: [f64; 2] = [1e5, 1e6];
const TWO_THREADS: f64 = 1.7;

pub fn section(study: &Study) -> Result<String> {
    let mut rows = Vec::new();
    if let Some(dragon) = &study.dragon {
        rows.extend(on_many_triangles(study, "dragon", &dragon.mesh, &ON_DRAGON)?);
        rows.extend(of_memory(study, dragon)?);
        let huge = divided(&dragon.mesh, study.effort.of(HUGE) as usize)?;
        rows.extend(on_many_triangles(study, "dragon, its triangles in parts", &huge, &[ON_HUGE])?);
    }
    let (name, mesh) = &study.small;
    let (count, goal) = (study.effort.of(ON_SMALL.0), ON_SMALL.1);
    let measured = in_turns(study.effort.rounds, &[&|| set(&study.one, mesh, count)])?;
    let asked = format!("{name}: {} samples", grouped(measured[0].samples));
    rows.push(Row::new(asked, Figure::time(&measured[0], 1.0), "s", Goal::AtMost(goal)));
    for count in BY_THREADS.map(|count| study.effort.of(count)) {
        rows.push(by_threads(study, name, mesh, count)?);
        if let Some(dragon) = &study.dragon {
            rows.push(by_threads(study, "dragon", &dragon.mesh, count)?);
        }
    }
    let about = "Maximal sets, only filled, of meshes in memory. The first call on a mesh also makes what is kept with it. Memory is what \
        the resident set of a process of its own grew by at most in its first call, without the samples that it returns; what is \
        kept with the mesh counts.";
    Ok(rows_in("Maximal sets on meshes", about, &rows))
}

fn set(context: &Context, mesh: &Arc<Mesh>, count: f64) -> Result<usize> {
    Ok(psp::sample(context, mesh, &Options::new(radius(mesh, count)).seed(1).projected(false), None)?.0.len())
}

/// First and later calls: each round has a mesh of its own for each number of samples.
fn on_many_triangles(study: &Study, name: &str, mesh: &Arc<Mesh>, goals: &[(f64, f64)]) -> Result<Vec<Row>> {
    let mut measured = vec![[Rounds::default(), Rounds::default()]; goals.len()];
    for _ in 0..study.effort.rounds {
        for (&(count, _), calls) in goals.iter().zip(&mut measured) {
            let fresh = Arc::new(Mesh::new(mesh.positions().to_vec(), mesh.triangles().to_vec())?);
            for call in calls {
                call.add(|| set(&study.one, &fresh, study.effort.of(count)))?;
            }
        }
    }
    let triangles = grouped(mesh.triangles().len());
    let rows = goals.iter().zip(&measured).flat_map(|(&(_, goal), calls)| {
        ["first", "later"].into_iter().zip(calls).map({
            let triangles = &triangles;
            move |(which, rounds)| {
                let asked = format!("{name} ({triangles}): {} samples, {which} call", grouped(rounds.samples));
                Row::new(asked, Figure::time(rounds, 1e3), "ms", Goal::AtMost(goal))
            }
        })
    });
    Ok(rows.collect())
}

fn of_memory(study: &Study, dragon: &Dragon) -> Result<Vec<Row>> {
    let row = |(count, _): (f64, f64)| {
        let count = study.effort.of(count);
        let runs = (0..study.effort.rounds).map(|_| memory::in_a_process_of_its_own(dragon, count));
        let megabytes = runs.collect::<Result<Vec<_>>>()?;
        let asked = format!("dragon: memory for about {} samples", grouped(count as usize));
        Ok(Row::new(asked, Figure::largest(megabytes), "MB", Goal::AtMost(MEMORY)))
    };
    ON_DRAGON.into_iter().map(row).collect()
}

fn by_threads(study: &Study, name: &str, mesh: &Arc<Mesh>, count: f64) -> Result<Row> {
    let [one, two] = [&study.one, &study.two].map(|context| move || set(context, mesh, count));
    let measured = in_turns(study.effort.rounds, &[&one, &two])?;
    let asked = format!("{name}: {} samples, one thread over two", grouped(measured[0].samples));
    Ok(Row::new(asked, Figure::ratio(&measured[0], &measured[1]), "×", Goal::AtLeast(TWO_THREADS)))
}
