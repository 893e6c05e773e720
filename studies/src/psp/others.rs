//! Methods of others at equal quality (thesis §3.4.2, fig. 3.15): the seconds until a set is as dense as asked for,
//! each method's parameter tuned for that. Written from the papers, for the same surface and radius as ours.

use std::collections::HashMap;
use std::fmt::Write;
use std::hash::BuildHasherDefault;
use std::ops::ControlFlow;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, ProjectionOptions, Psp};
use azulejo::{Context, Result};
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::text::{grouped, rounded};
use glam::{IVec3, Vec3};
use rustc_hash::FxHasher;

use super::Effort;
use super::scenes::{Scene, radius};
use crate::near::Near;
use crate::reference::stream;
use crate::repeated::{Repeated, cell};
use crate::timing::in_turns;

/// The relative radii asked for, the thesis's marks (§3.4.1) and one between them.
const RHO: [f64; 3] = [0.9, 0.95, 0.98];
/// The thesis's claim: others' parallel methods take this many times as long, and serial ones "orders of magnitude".
const PARALLEL_CLAIM: f64 = 1.5;
const SERIAL_CLAIM: f64 = 10.0;
/// At most so many darts for each sample of the reference, and iterations.
const MAX_DARTS: f64 = 500.0;
const MAX_ITERATIONS: u32 = 50;
/// A pool that was too small grows by this factor.
const GROWTH: f64 = 1.1;
const SEED: u64 = 1;
/// Cells of a parallel task.
const TASK: usize = 2048;

/// A surface from which uniform random points are drawn.
struct Surface<'a> {
    mesh: &'a Mesh,
    /// The area of all triangles up to each, and for each of as many equal parts of the whole the triangle it begins
    /// in.
    sums: Vec<f64>,
    first: Vec<usize>,
}

impl<'a> Surface<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        let mut sum = 0.0;
        let count = mesh.triangles().len();
        let areas = (0..count as u32).map(|triangle| mesh.triangle_area(triangle));
        let sums: Vec<_> = areas
            .map(|area| {
                sum += area;
                sum
            })
            .collect();
        let begins = |part: usize| sums.partition_point(|&end| end <= sum * part as f64 / count as f64);
        let first = (0..count).map(begins).collect();
        Self { mesh, sums, first }
    }

    /// Random points without end.
    fn points(&self) -> impl Iterator<Item = Vec3> {
        let mut unit = stream(SEED);
        let (count, whole) = (self.sums.len(), self.sums[self.sums.len() - 1]);
        std::iter::repeat_with(move || {
            // Two numbers of 24 bits: one alone is coarser than small triangles.
            let share = f64::from(unit()) + f64::from(unit()) / f64::from(1 << 24);
            let begin = self.first[(share * count as f64) as usize];
            let triangle = (begin..count - 1).find(|&i| self.sums[i] > share * whole).unwrap_or(count - 1);
            let [a, b, c] = self.mesh.corners(triangle as u32).map(Vec3::from);
            let (root, v) = (unit().sqrt(), unit());
            a + root * ((1.0 - v) * (b - a) + v * (c - a))
        })
    }

    fn pool(&self, size: usize) -> Vec<Vec3> {
        self.points().take(size).collect()
    }
}

/// Dart throwing (Cook 1986): one dart after the other, until there are so many samples; and the number of the darts.
fn thrown(surface: &Surface, radius: f32, target: usize, max_darts: usize) -> (Vec<Vec3>, usize) {
    let (mut samples, mut near, mut darts) = (Vec::new(), Near::new(radius), 0);
    for dart in surface.points().take(max_darts) {
        darts += 1;
        if near.around(dart).next().is_none() {
            near.add(dart, ());
            samples.push(dart);
            if samples.len() == target {
                break;
            }
        }
    }
    (samples, darts)
}

/// Constrained sampling by elimination (Corsini et al. 2012): each sample is a random point of a pool that is left, and
/// takes all those near it out.
fn eliminated(surface: &Surface, radius: f32, size: usize) -> Vec<Vec3> {
    let pool = surface.pool(size);
    let mut near = Near::new(radius);
    pool.iter().zip(0..).for_each(|(&point, i)| near.add(point, i));
    let mut is_left = vec![true; size];
    let mut samples = Vec::new();
    // The pool's order is random.
    for (i, &point) in pool.iter().enumerate() {
        if is_left[i] {
            samples.push(point);
            near.around(point).for_each(|(_, other): (_, usize)| is_left[other] = false);
        }
    }
    samples
}

/// Parallel sampling of surfaces by phase groups (Bowers et al. 2010): a pool in cells as wide as the radius, those of
/// a group too far apart for conflicts; in each trial, group after group, each cell tries its next point.
fn by_phase_groups(context: &Context, surface: &Surface, radius: f32, size: usize) -> Result<Vec<Vec3>> {
    const WIDTH: i32 = 3;
    let mut cells: HashMap<IVec3, Vec<Vec3>, BuildHasherDefault<FxHasher>> = HashMap::default();
    for point in surface.points().take(size) {
        cells.entry((point / radius).floor().as_ivec3()).or_default().push(point);
    }
    let mut groups = vec![Vec::new(); WIDTH.pow(3) as usize];
    for (cell, points) in cells {
        let IVec3 { x, y, z } = cell.rem_euclid(IVec3::splat(WIDTH));
        groups[(x + WIDTH * (y + WIDTH * z)) as usize].push(points);
    }
    let (mut samples, mut near, mut unit) = (Vec::new(), Near::new(radius), stream(SEED + 1));
    for trial in 0.. {
        groups.retain(|group| !group.is_empty());
        if groups.is_empty() {
            break;
        }
        groups.sort_by_cached_key(|_| (unit() * (1 << 24) as f32) as u32);
        for group in &mut groups {
            group.retain(|points| points.len() > trial);
            let tasks: Vec<_> = group.chunks(TASK).collect();
            let quiet = |_| ControlFlow::Continue(());
            let free = in_parallel(context.num_threads(), tasks.len(), &quiet, |i| {
                let tried = tasks[i].iter().map(|points| points[trial]);
                tried.filter(|&point| near.around(point).next().is_none()).collect::<Vec<_>>()
            })?;
            free.iter().flatten().for_each(|&point| near.add(point, ()));
            samples.extend(free.into_iter().flatten());
        }
    }
    Ok(samples)
}

/// A method with its parameter for each of the relative radii, if it gets there, and then its seconds.
struct Method {
    name: &'static str,
    threads: usize,
    parameters: [Option<usize>; 3],
    /// In rounds that are those of all methods.
    seconds: [Option<Repeated>; 3],
}

/// The section.
pub fn section(context: &Context, scene: &Scene, effort: &Effort) -> Result<String> {
    let radius = radius(&scene.mesh, effort.others);
    let methods = measure(context, &scene.mesh, radius, effort.judged_rounds)?;
    let mut text = format!(
        "## Methods of others at equal quality (thesis fig. 3.15)\n\nSeconds on the {} at one radius, that of {} samples of a \
         maximal set, until the set has the relative radius of the column; {} rounds in turns. **Methods \
         of others are implementations of this command, written from their papers, not the authors' programs**; their parameter (in \
         square brackets: darts or points of the pool for each \
         sample of the reference) is the smallest tried that is enough. Ours are iterations of projection (in square brackets: how \
         many), the thesis's method, and the set that is only filled, which the thesis does not have: its claims are held against \
         projection alone. The thesis compares with methods on the GPU, without naming them, at a radius \
         of 0.00025: its own is \"1.5x to 2.5x faster in most cases\", and faster than serial ones on the CPU \"by orders of \
         magnitude\".\n\n| method | threads | {} |\n|---|---|---|---|---|\n",
        scene.name,
        grouped(effort.others as usize),
        effort.judged_rounds,
        RHO.map(|rho| rho.to_string()).join(" | "),
    );
    let reference = methods.reference as f64;
    for method in &methods.all {
        let parameter = |value: usize| match method.name {
            "filled" => String::new(),
            "projected" => format!(" [{value}]"),
            _ => format!(" [{}]", rounded(value as f64 / reference, 2)),
        };
        let cells = method.seconds.iter().zip(&method.parameters).map(|each| match each {
            (Some(seconds), &Some(value)) => cell(seconds, 3) + &parameter(value),
            _ => "not reached".to_owned(),
        });
        _ = writeln!(text, "| {} | {} | {} |", method.name, method.threads, cells.collect::<Vec<_>>().join(" | "));
    }
    text += "\nRound by round, of the methods whose medians are the least; a serial method runs on one of all threads as well:\n\n\
             | claim of the thesis | 0.9 | 0.95 | 0.98 |\n|---|---|---|---|\n";
    let claims = [
        ("the fastest of others over projection, on all threads", false, PARALLEL_CLAIM),
        ("the fastest serial one of others over projection, on one thread", true, SERIAL_CLAIM),
    ];
    for (claim, is_serial, least) in claims {
        let [others, own] = [Maker::Other, Maker::Thesis]
            .map(|by| methods.fastest(|it| it.by() == by && (it.threads == 1 || !is_serial)));
        let cells = others.iter().zip(own).map(|(others, own)| match (others, own) {
            (Some(others), Some(own)) => {
                let factor = others.over(own);
                format!("{}, {}", cell(&factor, 3), factor.verdict(|factor| factor >= least))
            }
            _ => "not reached".to_owned(),
        });
        _ = writeln!(text, "| {claim}; goal: at least {least} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    Ok(text)
}

struct Methods {
    /// The samples of the set that is only filled.
    reference: usize,
    all: Vec<Method>,
}

/// Whose method it is. The thesis has no fill, and what that takes does not speak for its claims.
#[derive(PartialEq)]
enum Maker {
    Other,
    Thesis,
    Ours,
}

impl Method {
    fn by(&self) -> Maker {
        match self.name {
            "projected" => Maker::Thesis,
            "filled" => Maker::Ours,
            _ => Maker::Other,
        }
    }
}

impl Methods {
    /// The seconds of the one of some methods whose median is the least, to each relative radius.
    fn fastest(&self, is_meant: impl Fn(&Method) -> bool) -> [Option<&Repeated>; 3] {
        let meant = || self.all.iter().filter(|method| is_meant(method));
        let least = |a: &&Repeated, b: &&Repeated| a.median().total_cmp(&b.median());
        [0, 1, 2].map(|i| meant().filter_map(|method| method.seconds[i].as_ref()).min_by(least))
    }
}

/// The parameters, then the seconds with them.
fn measure(context: &Context, mesh: &std::sync::Arc<Mesh>, radius: f64, rounds: usize) -> Result<Methods> {
    let (single, surface, narrow) = (Context::new(1)?, Surface::new(mesh), radius as f32);
    let options = ProjectionOptions::new(radius);
    let filled = |context: &Context| Ok(psp::project(context, mesh, &options, 0, true, None)?.0.positions.len());
    let reference = filled(context)?;
    let targets = RHO.map(|rho| (rho * rho * reference as f64).ceil() as usize);
    let max_darts = (MAX_DARTS * reference as f64) as usize;
    let projected = |context: &Context, iterations: usize| -> Result<usize> {
        let mut psp = Psp::new(mesh, &options)?;
        psp.advance(context, iterations as u32, None)?;
        Ok(psp.len())
    };

    let darts = targets.map(|target| {
        let (samples, darts) = thrown(&surface, narrow, target, max_darts);
        (samples.len() == target).then_some(darts)
    });
    let tuned = |samples: &dyn Fn(usize) -> Result<usize>| -> Result<Vec<Option<usize>>> {
        let least = |(target, darts): (usize, Option<usize>)| {
            let Some(mut size) = darts else { return Ok(None) };
            while size <= max_darts {
                if samples(size)? >= target {
                    return Ok(Some(size));
                }
                size = (GROWTH * size as f64) as usize;
            }
            Ok(None)
        };
        targets.into_iter().zip(darts).map(least).collect()
    };
    let iterations = {
        let mut psp = Psp::new(mesh, &options)?;
        let mut found = [None; 3];
        for iteration in 1..=MAX_ITERATIONS {
            psp.advance(context, 1, None)?;
            for (found, target) in found.iter_mut().zip(targets) {
                *found = found.or((psp.len() >= target).then_some(iteration as usize));
            }
        }
        found
    };
    let elimination = |size: usize| Ok(eliminated(&surface, narrow, size).len());
    let phases = |size: usize| Ok(by_phase_groups(context, &surface, narrow, size)?.len());
    let throwing = |darts: usize| Ok(thrown(&surface, narrow, usize::MAX, darts).0.len());
    type Run<'a> = &'a dyn Fn(usize) -> Result<usize>;
    let three = |parameters: Vec<Option<usize>>| [0, 1, 2].map(|i| parameters[i]);
    let threads = context.num_threads();
    let runs: [(&'static str, usize, [Option<usize>; 3], Run); 7] = [
        ("dart throwing (Cook 1986)", 1, darts, &throwing),
        ("elimination (Corsini et al. 2012)", 1, three(tuned(&elimination)?), &elimination),
        ("phase groups (Bowers et al. 2010)", threads, three(tuned(&phases)?), &phases),
        ("projected", threads, iterations, &|count| projected(context, count)),
        ("projected", 1, iterations, &|count| projected(&single, count)),
        ("filled", threads, [Some(0); 3], &|_| filled(context)),
        ("filled", 1, [Some(0); 3], &|_| filled(&single)),
    ];
    let mut all: Vec<_> = runs
        .iter()
        .map(|&(name, threads, parameters, _)| Method { name, threads, parameters, seconds: [None, None, None] })
        .collect();
    for column in 0..RHO.len() {
        let calls: Vec<_> =
            runs.iter().filter_map(|(_, _, parameters, run)| Some((parameters[column]?, run))).collect();
        let calls: Vec<_> = calls.into_iter().map(|(parameter, run)| move || run(parameter)).collect();
        let calls: Vec<&dyn Fn() -> Result<usize>> = calls.iter().map(|call| call as &dyn Fn() -> _).collect();
        let timed = in_turns(rounds, &calls)?;
        let reached = all.iter_mut().filter(|method| method.parameters[column].is_some());
        reached.zip(timed).for_each(|(method, timed)| method.seconds[column] = Some(timed.scaled(1.0)));
    }
    Ok(Methods { reference, all })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::scenes::sphere;

    const RADIUS: f32 = 0.1;

    /// Checks that no two samples are closer than the radius, and that each of the points is closer to one of them.
    fn check(samples: &[Vec3], pool: &[Vec3]) {
        let is_near = |a: Vec3, b: Vec3| a.distance_squared(b) < RADIUS * RADIUS;
        for (i, &sample) in samples.iter().enumerate() {
            assert!(!samples[..i].iter().any(|&other| is_near(sample, other)));
        }
        assert!(pool.iter().all(|&point| samples.iter().any(|&sample| is_near(sample, point))));
    }

    #[test]
    fn each_method_leaves_no_point_of_its_pool_uncovered() {
        let mesh = sphere().unwrap();
        let surface = Surface::new(&mesh);
        let size = 8000;
        let pool = surface.pool(size);
        let (samples, darts) = thrown(&surface, RADIUS, usize::MAX, size);
        assert_eq!(darts, size);
        check(&samples, &pool);
        // The order of the pool is that of the darts.
        assert_eq!(eliminated(&surface, RADIUS, size), samples);
        let mut of_threads =
            [1, 3].map(|n| by_phase_groups(&Context::new(n).unwrap(), &surface, RADIUS, size).unwrap());
        of_threads.iter().for_each(|samples| check(samples, &pool));
        let [one, three] = &mut of_threads;
        assert_eq!(one, three);
    }

    #[test]
    fn random_points_are_where_the_area_is() {
        let mesh = sphere().unwrap();
        let surface = Surface::new(&mesh);
        let mut octants = [0; 8];
        for point in surface.pool(16_000) {
            octants[point.to_array().iter().fold(0, |octant, &x| 2 * octant + usize::from(x > 0.0))] += 1;
        }
        let chi2: f64 = octants.iter().map(|&n| (f64::from(n) - 2000.0).powi(2) / 2000.0).sum();
        assert!(chi2 < 30.0, "chi2 of 7 degrees of freedom: {chi2}");
    }

    #[test]
    fn denser_sets_take_more_darts_and_no_fewer_iterations() {
        let mesh = sphere().unwrap();
        let Methods { reference, all } = measure(&Context::new(2).unwrap(), &mesh, 0.08, 2).unwrap();
        assert!(reference > 1000);
        for method in &all {
            let found: Vec<_> = method.parameters.iter().flatten().collect();
            assert!(found.is_sorted() && method.parameters[0].is_some(), "{}: {found:?}", method.name);
            assert!(
                method.seconds.each_ref().map(|it| it.is_some()) == method.parameters.map(|it| it.is_some()),
                "{}",
                method.name
            );
        }
        assert!(all[0].parameters[1] > all[0].parameters[0].map(|darts| 2 * darts));
    }
}
