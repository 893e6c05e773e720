//! The number of projectors that are processed at once: chains of validity checks by the number of priorities (thesis
//! §3.4.3, fig. 3.16).

use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::Instant;

use azulejo::trace::{Ray, Scene as Tracer};
use azulejo::{Boundary, Context, Domain, Result, kdrt};
use azulejo_cli::draw::rows;
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};
use glam::Vec3;

use crate::args::MeshArgs;
use crate::near::Near;
use crate::psp::scenes::{Scene, radius, scenes};
use crate::reference::stream;
use crate::repeated::{Repeated, cell, lowest};

/// Projectors of a set, a multiple of all [`SIZES`]: the same for each, so that all sets get the same candidates.
const PROJECTORS: usize = 12;
/// The numbers of projectors that are processed at once, each with a priority of its own.
const SIZES: [usize; 6] = [1, 2, 3, 4, 6, 12];
/// Candidates of a parallel task.
const TASK: usize = 1024;

/// The results of checks of validity, and their time.
#[derive(Clone, Copy, Default)]
struct Checks {
    samples: usize,
    /// Checks, and the longest chain of them.
    checks: u64,
    longest: u32,
    seconds: f64,
}

/// True if no valid candidate of higher priority is too close (algorithm 6, `IsValid`), and the length of the chain. As
/// in the thesis's threads, no result is stored.
fn is_valid(candidates: &Near<usize>, (point, projector): (Vec3, usize), checks: &mut u64) -> (bool, u32) {
    *checks += 1;
    let mut longest = 0;
    for other in candidates.around(point).filter(|other| other.1 < projector) {
        let (valid, length) = is_valid(candidates, other, checks);
        longest = longest.max(length);
        if valid {
            return (false, 1 + longest);
        }
    }
    (true, 1 + longest)
}

/// Merges the candidates of all projectors, so many projectors at once (algorithm 6).
fn merged(context: &Context, batches: &[Vec<Vec3>], size: usize, radius: f32) -> Result<Checks> {
    let start = Instant::now();
    let (mut samples, mut total) = (Near::new(radius), Checks::default());
    for batches in batches.chunks(size) {
        let current: Vec<_> =
            batches.iter().enumerate().flat_map(|(i, batch)| batch.iter().map(move |&point| (point, i))).collect();
        let mut candidates = Near::new(radius);
        current.iter().for_each(|&(point, projector)| candidates.add(point, projector));
        let tasks: Vec<_> = current.chunks(TASK).collect();
        let quiet = |_| ControlFlow::Continue(());
        let checked = rows::in_parallel(context.num_threads(), tasks.len(), &quiet, |i| {
            let (mut checks, mut longest, mut valid) = (0, 0, Vec::new());
            for &candidate in tasks[i] {
                let (is_valid, length) = is_valid(&candidates, candidate, &mut checks);
                longest = longest.max(length);
                if is_valid && samples.around(candidate.0).next().is_none() {
                    valid.push(candidate);
                }
            }
            (checks, longest, valid)
        })?;
        for (checks, longest, valid) in checked {
            total.checks += checks;
            total.longest = total.longest.max(longest);
            total.samples += valid.len();
            valid.into_iter().for_each(|(point, _)| samples.add(point, ()));
        }
    }
    Ok(Checks { seconds: start.elapsed().as_secs_f64(), ..total })
}

/// The candidates of projectors in random directions: hits on the rays of a planar pattern, no two of one projector
/// closer than the radius. Lengths are in units of the diagonal of the mesh's box.
fn batches(context: &Context, tracer: &Tracer, radius: f64, seed: u64) -> Result<Vec<Vec<Vec3>>> {
    let mut unit = stream(seed);
    let domain = Domain { min: [-0.5; 2], max: [0.5; 2], boundary: Boundary::Bounded };
    let mut batch = |projector: usize| -> Result<Vec<Vec3>> {
        let (height, turn) = (2.0 * unit() - 1.0, std::f32::consts::TAU * unit());
        let flat = (1.0 - height * height).sqrt();
        let direction = Vec3::new(flat * turn.cos(), flat * turn.sin(), height).normalize();
        let (right, up) = direction.any_orthonormal_pair();
        let options = kdrt::Options::new(radius).domain(domain).seed(PROJECTORS as u64 * seed + projector as u64);
        let mut points = Vec::new();
        for [x, y] in kdrt::sample(context, &options, None)?.positions {
            let origin = x * right + y * up - direction;
            let mut hits = Vec::new();
            tracer.all_hits(&[Ray { origin: origin.to_array(), direction: direction.to_array() }], &mut hits);
            let mut along: Vec<f32> = hits.iter().map(|hit| hit.t - 1.0).collect();
            along.sort_by(f32::total_cmp);
            along.dedup_by(|next, last| f64::from(*next - *last) < radius);
            points.extend(along.into_iter().map(|depth| x * right + y * up + depth * direction));
        }
        Ok(points)
    };
    (0..PROJECTORS).map(&mut batch).collect()
}

/// The section.
pub fn section(context: &Context, meshes: &MeshArgs, quick: bool) -> Result<String> {
    let (count, trials) = if quick { (2e3, 2) } else { (5e4, 10) };
    let mut text = format!(
        "## Projectors at once (thesis fig. 3.16)\n\nThe candidates of {PROJECTORS} projectors in random directions, merged as \
         in the thesis's algorithm 6, so many projectors at once, each with a priority of its own: the same candidates on \
         every row, at the radius of {} samples of a maximal set; means of {trials} trials, in which the rows \
         take turns to be first. A check of a candidate checks \
         those of higher priority near it, and remembers nothing. *Seconds per sample* are those of a trial over those of one \
         priority in it: the median and the range. A number of priorities is the fastest where its range is below all \
         others. The thesis draws the relative performance without numbers.\n\n",
        grouped(count as usize)
    );
    let Some(dragon) = meshes.dragon.as_deref() else {
        return Ok(text + "**The dragon was not given (`--dragon MESH`) and this is left out.**\n");
    };
    let scene = scenes(None, Some(dragon), 8)?.0.remove(0);
    let sizes = watched("chains", |_| measure(context, &scene, count, trials))?;
    text += "| priorities | samples | checks per candidate | longest chain | seconds per sample over those of one priority |\n\
             |---|---|---|---|---|\n";
    let per_sample =
        |checks: &[Checks]| Repeated::new(checks.iter().map(|checks| checks.seconds / checks.samples as f64).collect());
    let one = per_sample(&sizes[0].1);
    let ratios: Vec<_> = sizes.iter().map(|(_, checks)| per_sample(checks).over(&one)).collect();
    for ((size, (candidates, checks)), ratio) in SIZES.iter().zip(&sizes).zip(&ratios) {
        let samples: usize = checks.iter().map(|checks| checks.samples).sum();
        let all: u64 = checks.iter().map(|checks| checks.checks).sum();
        _ = writeln!(
            text,
            "| {size} | {} | {} | {} | {} |",
            grouped(samples / trials as usize),
            rounded(all as f64 / *candidates as f64, 3),
            checks.iter().map(|checks| checks.longest).max().unwrap_or(0),
            if *size == 1 { "1".to_owned() } else { cell(ratio, 3) },
        );
    }
    _ = match lowest(&ratios.iter().collect::<Vec<_>>()) {
        Some(fastest) => writeln!(text, "\nThe thesis takes 3 priorities; here {} is the fastest.", SIZES[fastest]),
        None => writeln!(text, "\nThe thesis takes 3 priorities; which is the fastest is not decided here."),
    };
    Ok(text)
}

/// The candidates of all trials, and the checks of each, for each size.
fn measure(context: &Context, scene: &Scene, count: f64, trials: u64) -> Result<Vec<(usize, Vec<Checks>)>> {
    let (low, high) = scene.mesh.bounds();
    let (low, high) = (Vec3::from(low), Vec3::from(high));
    let scale = (high - low).length().recip();
    let place = |position: &[f32; 3]| ((Vec3::from(*position) - 0.5 * (low + high)) * scale).to_array();
    let positions: Vec<_> = scene.mesh.positions().iter().map(place).collect();
    let tracer = Tracer::new(&positions, scene.mesh.triangles(), context.num_threads())?;
    let radius = radius(&scene.mesh, count) * f64::from(scale);
    let mut sizes = vec![(0, Vec::new()); SIZES.len()];
    for seed in 0..trials {
        let batches = batches(context, &tracer, radius, seed)?;
        // Each size goes first as often as any other.
        for number in (0..SIZES.len()).map(|turn| (turn + seed as usize) % SIZES.len()) {
            let (candidates, checks) = &mut sizes[number];
            *candidates += batches.iter().map(Vec::len).sum::<usize>();
            checks.push(merged(context, &batches, SIZES[number], radius as f32)?);
        }
    }
    Ok(sizes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a line, of the given projectors, merged so many projectors at once.
    fn line(batches: &[&[f32]], size: usize) -> Checks {
        let batches: Vec<Vec<Vec3>> = batches.iter().map(|xs| xs.iter().map(|&x| x * Vec3::X).collect()).collect();
        merged(&Context::new(2).unwrap(), &batches, size, 1.0).unwrap()
    }

    #[test]
    fn a_chain_is_followed_to_its_end() {
        // Each conflicts with the one before only: the first and the third are valid, as is the fifth.
        let five: [&[f32]; 5] = [&[0.0], &[0.8], &[1.6], &[2.4], &[3.2]];
        let at_once = line(&five, 5);
        assert_eq!((at_once.samples, at_once.longest, at_once.checks), (3, 5, 15));
        // One after the other the result is the same, without chains.
        let in_turn = line(&five, 1);
        assert_eq!((in_turn.samples, in_turn.longest, in_turn.checks), (3, 1, 5));
    }

    #[test]
    fn samples_of_earlier_sets_stand() {
        assert_eq!(line(&[&[0.0, 2.0], &[0.5], &[3.5]], 1).samples, 3);
        assert_eq!(line(&[&[0.0, 2.0], &[0.5], &[3.5]], 2).samples, 3);
    }
}
