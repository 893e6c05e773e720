//! Filling what is uncovered, until the set is maximal (departs from the thesis, which has no such step).
//!
//! On an empty surface darts rain first, about six for each sample that will stand there. Then one pass over the
//! triangles drops those that a single sample covers, which are nearly all of them, and rounds of darts close what is
//! open. A mesh thus costs two short passes, and all else is in proportion to the samples.
//!
//! Where many samples are expected each cube of space does so for itself, in the colours of `cubes.rs`: its samples
//! then stay in the cache, and threads share the cubes. Few samples are made in one piece, since sorting the triangles
//! costs more.

mod blocks;
pub(super) mod darts;
pub(super) mod grid;
pub(super) mod ground;
pub(super) mod page;
pub(super) mod region;
pub(super) mod rounds;
pub(super) mod space;
pub(super) mod table;
pub(super) mod triangles;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

use std::ops::AddAssign;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::mesh::Mesh;
use crate::psp::cubes::Cube;
use crate::psp::estimate::expected_samples;
use crate::psp::fill::blocks::Blocks;
use crate::psp::fill::darts::Row;
use crate::psp::fill::ground::{Ground, UniformGround};
use crate::psp::fill::region::{Items, first_darts, open_parts, open_triangles, throw_at, throw_first};
use crate::psp::fill::rounds::{Open, rounds};
use crate::psp::fill::space::Space;
use crate::psp::fill::triangles::{Measures, Triangles};
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// Up to so many expected samples a surface is filled in one piece.
const ONE_PIECE: f64 = 25_000.0;

/// With how many random points, and some more where more is open, the open area of a surface is measured, ...
const PROBES: usize = 1 << 10;
/// ... and that of each of its cubes.
const PROBES_IN_CUBE: usize = 1 << 6;

/// Groups of triangles per task.
const CHUNK: usize = 1 << 8;

/// Counts of a fill, or of a part of it.
#[derive(Default)]
pub(super) struct Filled {
    pub darts: u64,
    /// The area that was open at first.
    pub open_area: f64,
}

impl AddAssign for Filled {
    fn add_assign(&mut self, part: Self) {
        self.darts += part.darts;
        self.open_area += part.open_area;
    }
}

/// Adds samples until the set is maximal.
pub(super) fn fill(job: &Job, mesh: &Mesh, measures: &Measures, samples: &mut SampleSet, seed: u64) -> Result<Filled> {
    let in_blocks = expected_samples(mesh, measures, samples.radius()) > ONE_PIECE;
    fill_either_way(job, mesh, measures, samples, in_blocks, seed)
}

/// Fills cube by cube or in one piece.
fn fill_either_way(
    job: &Job,
    mesh: &Mesh,
    measures: &Measures,
    samples: &mut SampleSet,
    in_blocks: bool,
    seed: u64,
) -> Result<Filled> {
    let is_empty = samples.len() == 0;
    let mut filled = if in_blocks {
        fill_in_blocks(job, mesh, measures, samples, is_empty, seed)?
    } else {
        let mut ground = UniformGround::new(mesh, Space::new(mesh, samples.radius()));
        samples.all().iter().for_each(|sample| ground.add(sample.position));
        let open_area = fill_in_one_piece(job, &mut ground, measures, is_empty, seed);
        // What was accepted stays, even where the job is cancelled.
        samples.append(&mut ground.accepted);
        Filled { darts: ground.darts, open_area: open_area? }
    };
    if is_empty {
        filled.open_area = mesh.area();
    }
    Ok(filled)
}

/// The area that is open where there were samples before the fill: the share of random points on what may be uncovered
/// that no sample covers.
fn open_area(ground: &UniformGround, open: &Open, probes: usize, rng: &mut Rng) -> f64 {
    let row = Row::new(open.areas());
    if row.total() == 0.0 {
        return 0.0;
    }
    let probes = probes + row.len() / 8;
    let is_open = |_: &usize| {
        let (triangle, barycentrics, ()) = open.point(row.hit(rng), rng);
        !ground.rejects(&ground.dart(triangle, barycentrics, ()))
    };
    let uncovered = (0..probes).filter(is_open).count();
    row.total() * ground.radius() * ground.radius() * uncovered as f64 / probes as f64
}

/// Fills the whole surface, and returns the area that was open before the rounds.
fn fill_in_one_piece(
    job: &Job,
    ground: &mut UniformGround,
    measures: &Measures,
    is_empty: bool,
    seed: u64,
) -> Result<f64> {
    let triangles = measures.triangles();
    let chunks = chunks_of(triangles.groups(), CHUNK);
    let mut rng = Rng::at(seed, Draw::Fill, &[]);
    if is_empty {
        let mut darts = Vec::new();
        let in_chunk = |chunk: usize| {
            let groups = chunks.range(chunk).map(|group| (group, measures.areas[group]));
            let rng = &mut Rng::at(seed, Draw::Fill, &[chunk as u64]);
            first_darts(ground.mesh, ground.radius(), triangles, groups, rng)
        };
        job.part(0.0, 0.2).stream(chunks.len(), in_chunk, |mut part| {
            darts.append(&mut part);
            Ok(())
        })?;
        throw_at(ground, triangles, darts, &mut rng);
    }
    let mut open = Open::default();
    let in_chunk = |chunk: usize| open_triangles(ground, triangles, chunks.range(chunk));
    job.part(0.2, 0.5).stream(chunks.len(), in_chunk, |mut part| {
        open.append(&mut part);
        Ok(())
    })?;
    let open_area = if is_empty { 0.0 } else { open_area(ground, &open, PROBES, &mut rng) };
    let job = job.part(0.5, 1.0);
    rounds(ground, open, &mut rng, |round| job.report(1.0 - 0.8f64.powi(round)))?;
    Ok(open_area)
}

/// Fills the surface cube by cube.
fn fill_in_blocks(
    job: &Job,
    mesh: &Mesh,
    measures: &Measures,
    samples: &mut SampleSet,
    is_empty: bool,
    seed: u64,
) -> Result<Filled> {
    let blocks = Blocks::new(&job.part(0.0, 0.1), mesh, measures.triangles(), samples)?;
    let space = Space::new(mesh, samples.radius());
    samples.grow(&job.part(0.1, 1.0), &blocks.cubes, |block, samples| {
        let (triangles, pieces) = blocks.content(block);
        let items = Items { triangles: Triangles::Listed(&triangles), pieces: &pieces };
        fill_block(UniformGround::new(mesh, space), items, blocks.cubes[block], samples, is_empty, seed)
    })
}

/// The samples that a cube needs to be covered, and what that took.
fn fill_block(
    mut ground: UniformGround,
    items: Items,
    cube: Cube,
    samples: &SampleSet,
    is_empty: bool,
    seed: u64,
) -> (Vec<Sample>, Filled) {
    let mut rng = Rng::at(seed, Draw::Fill, &cube.key());
    let (low, high) = items.reached(ground.mesh, ground.radius());
    for sample in samples.around(cube) {
        if (0..3).all(|axis| low[axis] <= sample.position[axis] && sample.position[axis] <= high[axis]) {
            ground.add(sample.position);
        }
    }
    let triangles = items.triangles;
    if is_empty {
        throw_first(&mut ground, items, &mut rng);
    }
    let mut open = open_triangles(&ground, triangles, 0..triangles.groups());
    items.pieces.iter().for_each(|piece| open_parts(&ground, piece, &mut open));
    let open_area = if is_empty { 0.0 } else { open_area(&ground, &open, PROBES_IN_CUBE, &mut rng) };
    let Ok(()) = rounds(&mut ground, open, &mut rng, |_| Ok::<(), std::convert::Infallible>(()));
    (ground.accepted, Filled { darts: ground.darts, open_area })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::mesh::exact;

    /// Triangles of all sizes, and needles, crossing each other: a large one across many cubes, small ones in heaps.
    fn soup(seed: u64) -> Mesh {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        let mut positions: Vec<[f32; 3]> = Vec::new();
        for triangle in 0..300 {
            let size = [1.0, 0.2, 0.05, 0.01, 1e-3][triangle % 5];
            let flat = if triangle % 7 == 0 { 1e-5 } else { 1.0 };
            let at = [(); 3].map(|()| rng.unit() * (1.0 - size));
            let corner = |rng: &mut Rng| [size, size * flat, size * flat].map(|size| rng.unit() * size);
            positions.extend([(); 3].map(|()| {
                let corner = corner(&mut rng);
                [0, 1, 2].map(|axis| (at[axis] + corner[axis]) as f32)
            }));
        }
        Mesh::new(positions, (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap()
    }

    /// Each way, on one thread and on three; then the other way finds nothing left, and nothing conflicts.
    #[test]
    fn what_is_filled_in_one_piece_and_by_cubes_is_maximal_to_the_other_way() {
        for (seed, in_blocks) in (0..2).flat_map(|seed| [(seed, false), (seed, true)]) {
            let (mesh, radius) = (soup(seed), 0.03);
            let measures = Measures::of(&mesh);
            let fill_with = |threads, samples: &mut SampleSet, in_blocks| {
                let fill = |job: &Job| fill_either_way(job, &mesh, &measures, samples, in_blocks, seed);
                Context::new(threads).unwrap().run(None, fill).unwrap()
            };
            let [mut one, mut three] = [(); 2].map(|()| SampleSet::new(&mesh, radius));
            let filled = fill_with(1, &mut one, in_blocks);
            fill_with(3, &mut three, in_blocks);
            let positions = |set: &SampleSet| set.all().iter().map(|sample| sample.position).collect::<Vec<_>>();
            let samples = positions(&one);
            assert_eq!(samples, positions(&three), "depends on the threads");
            assert!(samples.len() > 1000 && filled.darts > samples.len() as u64 && filled.open_area == mesh.area());
            for (i, &a) in samples.iter().enumerate() {
                assert!(samples[..i].iter().all(|&b| exact(a).distance(exact(b)) >= radius));
            }
            let again = fill_with(1, &mut one, !in_blocks);
            assert_eq!(one.len(), samples.len(), "a gap was left");
            assert!(again.open_area < 0.01 * mesh.area());
        }
    }
}
