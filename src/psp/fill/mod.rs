//! Filling what is uncovered, until the set is maximal (departs from the thesis, which has no such step).
//!
//! On an empty surface darts rain first, about six for each sample that will stand there. Then one pass over the
//! triangles drops those that a single sample covers, which are nearly all of them, and rounds of darts close what is
//! open. A mesh thus costs two short passes, and all else is in proportion to the samples.
//!
//! Where many samples are expected each cube of space does so for itself, in the colours of `cubes.rs`: its samples
//! then stay in the cache, and threads share the cubes. Few samples are made in one piece, since sorting the triangles
//! costs more.

pub(super) mod balls;
pub(super) mod blocks;
pub(super) mod cells;
pub(super) mod darts;
pub(super) mod extent;
pub(super) mod grid;
pub(super) mod ground;
pub(super) mod items;
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
use crate::index::Weights;
use crate::job::{Job, chunks_of};
use crate::math::power;
use crate::mesh::Mesh;
use crate::psp::estimate::expected_samples;
use crate::psp::facing::Facing;
use crate::psp::fill::blocks::{Block, Blocks};
use crate::psp::fill::darts::random_point;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::ground::{Ground, Point, UniformGround};
use crate::psp::fill::region::{first_darts, open_parts, open_triangles, throw_at, throw_first};
use crate::psp::fill::rounds::{Open, PATCH, rounds};
use crate::psp::fill::space::Space;
use crate::psp::fill::triangles::{Measures, Triangles};
use crate::psp::given::GivenSamples;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// Up to so many expected samples a surface is filled in one piece.
pub(super) const ONE_PIECE: f64 = 25_000.0;

/// With how many random points, and some more where more is open, the open area of a surface is measured, ...
pub(super) const PROBES: usize = 1 << 10;
/// ... and that of each of its cubes.
pub(super) const PROBES_IN_CUBE: usize = 1 << 6;

/// Where samples are given, first darts rain if at least this share of the surface is open. If less is, most of them
/// would be wasted, and rounds on what is open are faster.
pub(super) const RAIN_FROM: f64 = 0.15;

/// Groups of triangles per task.
pub(super) const CHUNK: usize = 1 << 10;

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

/// What is to be filled, and around what.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub mesh: &'a Mesh,
    pub measures: &'a Measures,
    pub given: &'a GivenSamples,
    pub facing: Facing,
}

impl<'a> Surface<'a> {
    /// The surface without any sample of the radius, or the part of it in a box.
    fn ground(&self, radius: f64, extent: Option<&Extent>) -> UniformGround<'a> {
        UniformGround::new(self.mesh, Space::new(self.mesh, radius), extent, self.facing, &self.given.obstacles)
    }

    /// The share of it that given samples leave open, roughly: that of random points.
    fn open_share(&self, ground: &UniformGround, rng: &mut Rng) -> f64 {
        let (triangles, groups) = (self.measures.triangles(), Weights::new(self.measures.areas.clone()));
        if groups.total() == 0.0 {
            return 0.0;
        }
        let point = |rng: &mut Rng| {
            let group = groups.pick(rng) as usize;
            let areas = triangles.measure(self.mesh, group).0;
            let index = triangles.group(group).start + Weights::new(areas.to_vec()).pick(rng) as usize;
            Point { triangle: triangles.at(index), barycentrics: random_point(rng), local: () }
        };
        open_share(ground, PROBES, || point(rng))
    }
}

/// How a surface is filled.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    pub seed: u64,
    /// Whether darts rain on the surface before it is looked at what is open: where samples cover little of it.
    pub rains: bool,
    /// Whether the area that is open at first is measured.
    pub measures: bool,
    /// The longest patches that darts are thrown on, in radii: at most [`PATCH`].
    pub patch: f32,
    /// The largest rank of the samples that are added, if these get ranks (`levels.rs`).
    pub largest_rank: Option<f64>,
}

impl Manner {
    /// How an empty surface is filled.
    pub fn from_nothing(seed: u64) -> Self {
        Self { seed, rains: true, measures: true, patch: PATCH as f32, largest_rank: None }
    }

    /// How a set is filled around the samples that it has.
    fn of(samples: &SampleSet, seed: u64) -> Self {
        Self { rains: samples.len() == 0, ..Self::from_nothing(seed) }
    }
}

/// Adds samples until the set is maximal.
pub(super) fn fill(job: &Job, surface: &Surface, samples: &mut SampleSet, seed: u64) -> Result<Filled> {
    fill_in(Manner::of(samples, seed), job, surface, samples)
}

/// Adds samples in this manner until the set is maximal.
pub(super) fn fill_in(manner: Manner, job: &Job, surface: &Surface, samples: &mut SampleSet) -> Result<Filled> {
    let in_blocks = expected_samples(surface.mesh, surface.measures, samples.radius()) > ONE_PIECE;
    fill_either_way(job, surface, samples, in_blocks, manner)
}

/// Fills cube by cube or in one piece.
fn fill_either_way(
    job: &Job,
    surface: &Surface,
    samples: &mut SampleSet,
    in_blocks: bool,
    manner: Manner,
) -> Result<Filled> {
    let is_empty = samples.len() == 0 && surface.given.is_empty();
    let mut filled = if in_blocks {
        fill_in_blocks(job, surface, samples, manner)?
    } else {
        let mut ground = surface.ground(samples.radius(), None).ranked(manner.largest_rank);
        surface.given.alike().iter().for_each(|&position| ground.add_given(position));
        samples.all().iter().for_each(|sample| ground.add(sample));
        let open_area = fill_in_one_piece(job, surface, &mut ground, manner);
        // What was accepted stays, even where the job is cancelled.
        samples.append(&mut ground.accepted);
        Filled { darts: ground.darts, open_area: open_area? }
    };
    if is_empty {
        filled.open_area = surface.mesh.area();
    }
    Ok(filled)
}

/// The share of so many random points that no sample covers.
fn open_share(ground: &UniformGround, probes: usize, mut point: impl FnMut() -> Point) -> f64 {
    let is_open = |_: &usize| !ground.rejects(&ground.dart_at(point()));
    (0..probes).filter(is_open).count() as f64 / probes as f64
}

/// The area that is open where there were samples before the fill: the share of random points on what may be uncovered
/// that no sample covers.
fn open_area(ground: &UniformGround, open: &Open, probes: usize, rng: &mut Rng) -> f64 {
    let row = Weights::new(open.areas().collect());
    if row.total() == 0.0 {
        return 0.0;
    }
    let share = open_share(ground, probes + row.len() / 8, || open.point(row.pick(rng), rng));
    row.total() * ground.radius() * ground.radius() * share
}

/// Fills the whole surface, and returns the area that was open before.
fn fill_in_one_piece(job: &Job, surface: &Surface, ground: &mut UniformGround, manner: Manner) -> Result<f64> {
    let (measures, seed) = (surface.measures, manner.seed);
    let triangles = measures.triangles();
    let chunks = chunks_of(triangles.groups(), CHUNK);
    let mut rng = Rng::at(seed, Draw::Fill, &[]);
    let share = match (manner.rains, surface.given.is_empty()) {
        (false, _) => 0.0,
        (true, true) => 1.0,
        (true, false) => surface.open_share(ground, &mut rng),
    };
    let rains = share >= RAIN_FROM;
    if rains {
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
    let balls = measures.balls(&job.part(0.2, 0.25), ground.mesh, ground.radius())?;
    let in_chunk = |chunk: usize| {
        let left = |&group: &usize| balls.is_none_or(|balls| !ground.covers(&balls[group]));
        let groups = chunks.range(chunk).filter(left);
        open_triangles(ground, triangles, groups.flat_map(|group| triangles.group(group)))
    };
    job.part(0.25, 0.5).stream(chunks.len(), in_chunk, |mut part| {
        open.append(&mut part);
        Ok(())
    })?;
    let open_area = match (rains, manner.measures) {
        (true, _) => share * ground.mesh.area(),
        (false, true) => open_area(ground, &open, PROBES, &mut rng),
        (false, false) => 0.0,
    };
    let job = job.part(0.5, 1.0);
    rounds(ground, open, manner.patch, &mut rng, |round| job.report(1.0 - power(0.8, round as u32)))?;
    Ok(open_area)
}

/// Fills the surface cube by cube.
fn fill_in_blocks(job: &Job, surface: &Surface, samples: &mut SampleSet, manner: Manner) -> Result<Filled> {
    let blocks = Blocks::new(&job.part(0.0, 0.1), surface.mesh, surface.measures, samples)?;
    samples.grow(&job.part(0.1, 1.0), &blocks.cubes, |number, samples| {
        fill_block(surface, &blocks.block(number), samples, manner)
    })
}

/// The samples that a cube needs to be covered, and what that took.
fn fill_block(surface: &Surface, block: &Block, samples: &SampleSet, manner: Manner) -> (Vec<Sample>, Filled) {
    let (cube, items) = (block.cube, &block.items);
    let mut ground = surface.ground(samples.radius(), Some(&block.extent)).ranked(manner.largest_rank);
    let mut rng = Rng::at(manner.seed, Draw::Fill, &cube.key());
    let reach = manner.largest_rank.unwrap_or(ground.radius());
    let is_near = |position: [f32; 3]| block.extent.is_in_reach(position, reach);
    surface.given.alike_around(cube).filter(|&position| is_near(position)).for_each(|near| ground.add_given(near));
    // What given samples leave open, before those of other cubes cover a part of it.
    let mut row = manner.rains.then(|| items.row(ground.mesh));
    let share = row.as_mut().map_or(0.0, |row| match surface.given.is_empty() {
        true => 1.0,
        false => open_share(&ground, PROBES_IN_CUBE, || row.point(&mut rng)),
    });
    samples.around(cube).filter(|sample| is_near(sample.position)).for_each(|sample| ground.add(sample));
    let mut first = row.filter(|_| share >= RAIN_FROM);
    if let Some(row) = &mut first {
        throw_first(&mut ground, row, &mut rng);
    }
    let left = items.indices_but(|ball| ground.covers(ball));
    let mut open = open_triangles(&ground, Triangles::Listed(&items.triangles), left);
    items.pieces.iter().for_each(|piece| open_parts(&ground, piece, &mut open));
    let open_area = match first {
        Some(row) => share * row.total(),
        None if manner.measures => open_area(&ground, &open, PROBES_IN_CUBE, &mut rng),
        None => 0.0,
    };
    let Ok(()) = rounds(&mut ground, open, manner.patch, &mut rng, |_| Ok::<(), std::convert::Infallible>(()));
    (ground.accepted, Filled { darts: ground.darts, open_area })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::Given;
    use crate::job::Context;
    use crate::mesh::exact;
    use crate::psp::fill::blocks::tests::rows;

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

    /// Given samples near and on the mesh, every second of them with the radius of the set, the others with clearances
    /// from a hundredth to ten times it.
    fn obstacles(mesh: &Mesh, radius: f64, count: usize) -> (Vec<[f32; 3]>, Vec<f64>) {
        let mut rng = Rng::at(9, Draw::Probe, &[]);
        let mut given = |i: usize| {
            let triangle = rng.below(mesh.triangles().len() as u64) as u32;
            let place = mesh.point_exact(triangle, random_point(&mut rng)).to_array();
            let position = place.map(|x| (x + 0.5 * radius * (rng.unit() - 0.5)) as f32);
            let own = radius * libm::exp10(4.0 * rng.unit() * rng.unit() - 2.0);
            (position, if i.is_multiple_of(2) { radius } else { own.min(10.0 * radius) })
        };
        (0..count).map(&mut given).unzip()
    }

    /// Does something with the surface of a mesh, around nothing that is given.
    fn with_surface<T>(mesh: &Mesh, measures: &Measures, radius: f64, does: impl FnOnce(&Surface) -> T) -> T {
        let given =
            &GivenSamples::new(mesh, Given::default(), radius, &SampleSet::new(mesh, radius), Facing::ANY).unwrap();
        does(&Surface { mesh, measures, given, facing: Facing::ANY })
    }

    /// The positions of a set that is made from nothing.
    fn filled(mesh: &Mesh, measures: &Measures, radius: f64, in_blocks: bool) -> Vec<[f32; 3]> {
        let (mut samples, manner) = (SampleSet::new(mesh, radius), Manner::from_nothing(5));
        with_surface(mesh, measures, radius, |surface| {
            let fill = |job: &Job| fill_either_way(job, surface, &mut samples, in_blocks, manner);
            Context::new(2).unwrap().run(None, fill).unwrap();
        });
        samples.all().iter().map(|sample| sample.position).collect()
    }

    /// For a few dozen samples the balls spare most looks, and nothing changes.
    #[test]
    fn the_passes_with_balls_find_what_the_first_one_finds() {
        let (positions, triangles) = rows();
        let (mesh, radius) = (Mesh::new(positions, triangles).unwrap(), 17.0);
        let measures = Measures::of(&mesh);
        let places = [(); 3].map(|()| filled(&mesh, &measures, radius, false));
        assert!(places[0].len() > 20 && places[1] == places[0] && places[2] == places[0]);
        let balls = Context::new(1).unwrap().run(None, |job| measures.balls(job, &mesh, radius)).unwrap().unwrap();
        with_surface(&mesh, &measures, radius, |surface| {
            let (mut ground, triangles) = (surface.ground(radius, None), measures.triangles());
            places[0].iter().for_each(|&place| ground.add_given(place));
            let covered: Vec<usize> = (0..balls.len()).filter(|&group| ground.covers(&balls[group])).collect();
            assert!(2 * covered.len() > balls.len());
            let indices = covered.into_iter().flat_map(|group| triangles.group(group));
            assert!(open_triangles(&ground, triangles, indices).areas().next().is_none());
        });
    }

    /// Sets of many radii, one after the other, on what is kept from earlier ones: balls, which are too large for the last
    /// radii. Each is what it is on a mesh that keeps nothing.
    #[test]
    fn cubes_are_filled_alike_whatever_balls_are_kept() {
        let (positions, triangles) = rows();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let kept = Measures::of(&mesh);
        for radius in [17.0, 17.0, 4.0, 2.0, 1.0, 0.5] {
            let in_blocks = radius < 17.0;
            let fresh = filled(&mesh, &Measures::of(&mesh), radius, in_blocks);
            assert!(filled(&mesh, &kept, radius, in_blocks) == fresh, "{radius}");
        }
    }

    /// Each way, on one thread and on three, with given samples and without; then the other way finds nothing left, and
    /// nothing conflicts.
    #[test]
    fn what_is_filled_in_one_piece_and_by_cubes_is_maximal_to_the_other_way() {
        for case in 0..8 {
            let (seed, in_blocks, count) = (case / 4, case % 2 == 1, [0, 100][case as usize / 2 % 2]);
            let (mesh, radius) = (soup(seed), 0.03);
            let measures = Measures::of(&mesh);
            let (positions, clearances) = obstacles(&mesh, radius, count);
            let given = Given::with_clearances(&positions, &clearances);
            let given = &GivenSamples::new(&mesh, given, radius, &SampleSet::new(&mesh, radius), Facing::ANY).unwrap();
            assert!(count == 0 || 10 * given.alike().len() > 4 * count && !given.obstacles.is_empty());
            let surface = Surface { mesh: &mesh, measures: &measures, given, facing: Facing::ANY };
            let fill_with = |threads, samples: &mut SampleSet, in_blocks| {
                let manner = Manner::of(samples, seed);
                let fill = |job: &Job| fill_either_way(job, &surface, samples, in_blocks, manner);
                Context::new(threads).unwrap().run(None, fill).unwrap()
            };
            let [mut one, mut three] = [(); 2].map(|()| SampleSet::new(&mesh, radius));
            let filled = fill_with(1, &mut one, in_blocks);
            fill_with(3, &mut three, in_blocks);
            let places = |set: &SampleSet| set.all().iter().map(|sample| sample.position).collect::<Vec<_>>();
            let samples = places(&one);
            assert_eq!(samples, places(&three), "depends on the threads");
            assert!(samples.len() > 500 && filled.darts > samples.len() as u64);
            assert_eq!(filled.open_area == mesh.area(), count == 0);
            for (i, &a) in samples.iter().enumerate() {
                assert!(samples[..i].iter().all(|&b| exact(a).distance(exact(b)) >= radius));
                let mut given = positions.iter().zip(&clearances);
                assert!(given.all(|(&b, &clearance)| exact(a).distance(exact(b)) >= clearance));
            }
            let again = fill_with(1, &mut one, !in_blocks);
            assert_eq!(one.len(), samples.len(), "a gap was left");
            assert!(again.open_area < 0.01 * mesh.area());
        }
    }
}
