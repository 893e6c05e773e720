//! A set of a cuboid, filled block by block, on request around the copies of a tiling.

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::levels::LevelOptions;
use crate::plane::Rect;
use crate::simd::Level;
use crate::volume::blocks::{Blocks, REACH};
use crate::volume::fill::{Fill, Pass};
use crate::volume::grid::{Grid, Grids};
use crate::volume::ranks;
use crate::volume::search::Centre;
use crate::volume::space::Space;
use crate::volume::tiling::{Conquered, Tiling};

/// The samples that one task assigns to blocks, and the share of a level that this takes.
const SAMPLES_PER_TASK: usize = 1 << 14;
const SORTING: f64 = 0.05;

/// The shares of a tiled set that its pattern takes, and that and the clips.
const PATTERN: f64 = 0.1;
const CLIPS: f64 = 0.2;

/// A sample of a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub point: Centre,
    /// The distance to the nearest sample that was there when it was put there (`levels.rs`).
    pub rank: f32,
}

/// The samples of a cuboid as lattice points, by their blocks.
pub struct Set<'a> {
    space: Space<'a>,
    blocks: Blocks,
    samples: Vec<Vec<Centre>>,
    /// The number of samples of each block that were there at first.
    known: Vec<usize>,
    /// The largest rank, and the ranks of the samples that were added to each block, if they get any.
    largest_rank: Option<f64>,
    ranks: Vec<Vec<f32>>,
    grids: Grids<Grid>,
    level: Level,
    tiled: Option<Tiled<'a>>,
}

/// A tiling, and the points of its clips that were eliminated, by blocks.
struct Tiled<'a> {
    tiling: Tiling<'a>,
    eliminated: Vec<Vec<Centre>>,
}

impl<'a> Set<'a> {
    /// A maximal set around given balls, tiled if it has leaves, by the widest vectors of the processor.
    pub fn maximal(job: &Job, space: Space<'a>, leaf_size: Option<f64>, seed: u64) -> Result<Self> {
        let level = Level::widest();
        leaf_size.map_or_else(|| Self::new(job, space, seed, level), |size| Self::tiled(job, space, size, seed, level))
    }

    /// A maximal set around given balls, by instructions of some level.
    pub fn new(job: &Job, space: Space<'a>, seed: u64, level: Level) -> Result<Self> {
        let mut set = Self::empty(space, seed, level);
        set.fill(job, Pass::ALL)?;
        Ok(set)
    }

    /// A maximal set around given balls that is tiled by leaves of some size, by instructions of some level. The cuboid must be
    /// worth it.
    pub fn tiled(job: &Job, space: Space<'a>, leaf_size: f64, seed: u64, level: Level) -> Result<Self> {
        let tiling = Tiling::new(&job.part(0.0, PATTERN), space.lattice, leaf_size, seed, level)?;
        let mut set = Self::empty(space, seed, level);
        let conquered = job.part(PATTERN, CLIPS).map(set.blocks.leaves.len(), |block| {
            let block = &set.blocks.leaves[block].rect;
            let mut grid = set.grids.take();
            let conquered = tiling.conquer(block, &space.given.near(block), &mut grid);
            set.grids.give(grid);
            conquered
        })?;
        let mut eliminated = Vec::with_capacity(conquered.len());
        for (samples, Conquered { samples: stay, eliminated: others }) in set.samples.iter_mut().zip(conquered) {
            *samples = stay;
            eliminated.push(others);
        }
        set.tiled = Some(Tiled { tiling, eliminated });
        set.fill(&job.part(CLIPS, 1.0), Pass::LAST)?;
        Ok(set)
    }

    /// The samples that a fill adds to those of a larger radius: a level, with ranks up to the largest one.
    pub fn added(job: &Job, space: Space<'a>, options: LevelOptions, before: &[Sample]) -> Result<Vec<Sample>> {
        let LevelOptions { seed, throws_first, largest_rank } = options;
        let mut set = Self { largest_rank, ..Self::empty(space, seed, Level::widest()) };
        let chunks = chunks_of(before.len(), SAMPLES_PER_TASK);
        let blocks = job.part(0.0, SORTING).flat_map(chunks.len(), |chunk| {
            chunks.range(chunk).map(|index| set.blocks.holding(before[index].point)).collect()
        })?;
        for (sample, block) in before.iter().zip(blocks) {
            set.samples[block as usize].push(sample.point);
        }
        set.known = set.samples.iter().map(Vec::len).collect();
        set.fill(&job.part(SORTING, 1.0), if throws_first { Pass::ALL } else { Pass::LAST })?;

        let mut added = Vec::new();
        for ((samples, &known), ranks) in set.samples.iter().zip(&set.known).zip(&set.ranks) {
            let ranks = ranks.iter().copied().chain(std::iter::repeat(f32::INFINITY));
            added.extend(samples[known..].iter().zip(ranks).map(|(&point, rank)| Sample { point, rank }));
        }
        Ok(added)
    }

    fn empty(space: Space<'a>, seed: u64, level: Level) -> Self {
        let blocks = Blocks::new(space.lattice, seed);
        let count = blocks.leaves.len();
        let (samples, ranks) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let (known, grids) = (vec![0; count], Grids::default());
        Self { space, blocks, samples, known, largest_rank: None, ranks, grids, level, tiled: None }
    }

    /// Adds samples until the set is maximal.
    ///
    /// Each pass goes over all blocks. The first brings three quarters of the samples, with rivals around each block, so
    /// that the faces of blocks leave few traces (docs/design/volume.md). Rivals in the last pass would leave gaps: what a
    /// dropped sample covers would be open.
    fn fill(&mut self, job: &Job, passes: &[Pass]) -> Result<()> {
        let (count, mut done) = (self.blocks.leaves.len(), 0);
        let share = |done: usize| done as f64 / (passes.len() * count) as f64;
        for &pass in passes {
            for number in 0..self.blocks.waves.len() {
                let wave = &self.blocks.waves[number];
                let part = job.part(share(done), share(done + wave.len()));
                let added = part.map(wave.len(), |index| self.fill_block(wave[index], pass))?;
                done += wave.len();
                for (&block, (added, ranks)) in wave.iter().zip(added) {
                    let samples = &mut self.samples[block as usize];
                    samples.reserve_exact(added.len());
                    samples.extend(added);
                    self.ranks[block as usize].extend(ranks);
                }
            }
        }
        Ok(())
    }

    /// The new samples of one pass over a block, which depend only on its place and on the samples around it, and their ranks.
    fn fill_block(&self, block: u32, pass: Pass) -> (Vec<Centre>, Vec<f32>) {
        let Self { space: Space { lattice, given, .. }, blocks, .. } = self;
        let leaf = &blocks.leaves[block as usize];
        let mut region = blocks.region(lattice, &leaf.rect, pass);
        let margin = lattice.separation.reach + 1;
        let exposed = self.tiled.as_ref().map(|Tiled { tiling, eliminated }| {
            tiling.exposed(&region, self.around(eliminated, block, &region.grown(margin)))
        });
        if let Some(exposed) = &exposed {
            region = exposed.extent;
            if region.is_empty() {
                return Default::default();
            }
        }
        let mut window = region.grown(margin);
        if self.largest_rank.is_some() {
            window = window.hull(&leaf.rect.grown((REACH * lattice.radius).ceil() as i32 + 1));
        }
        let around = self.around(&self.samples, block, &window);
        let mut grid = self.grids.take();
        let fill = Fill {
            shape: (),
            grid: &mut grid,
            pass,
            block: leaf.rect,
            region,
            radius: lattice.radius,
            separation: lattice.separation,
            around: &around,
            given: &given.near(&region),
            images: &blocks.images,
            rng: blocks.rng(block, pass),
        };
        let added = self.space.run(self.level, fill, exposed);
        self.grids.give(grid);
        let ranks = self
            .largest_rank
            .map(|largest| ranks::up_to(largest, lattice, &leaf.rect, &around, &added, &blocks.images));
        (added, ranks.unwrap_or_default())
    }

    /// The points of a block, of some that are sorted by blocks, and those of its neighbours in a window, with all images that
    /// matter.
    fn around(&self, points: &[Vec<Centre>], block: u32, window: &Rect<3>) -> Vec<Centre> {
        let moved = |sample: Centre, by: [i32; 3]| -> Centre { std::array::from_fn(|axis| sample[axis] + by[axis]) };
        let mut around = points[block as usize].clone();
        for &(other, image) in &self.blocks.neighbours[block as usize] {
            let images = points[other as usize].iter().map(|&point| moved(point, image));
            around.extend(images.filter(|&point| window.contains(point)));
        }
        let count = around.len();
        for &image in &self.blocks.images {
            around.extend_from_within(..count);
            let start = around.len() - count;
            around[start..].iter_mut().for_each(|sample| *sample = moved(*sample, image));
        }
        around
    }

    /// The samples as lattice points, block after block.
    pub fn into_points(self) -> Vec<Centre> {
        self.samples.into_iter().flatten().collect()
    }

    /// The coordinates of the samples, block after block.
    pub fn into_positions(self) -> Vec<[f32; 3]> {
        let mut positions = Vec::with_capacity(self.samples.iter().map(Vec::len).sum());
        for samples in self.samples {
            positions.extend(samples.into_iter().map(|sample| self.space.lattice.position(sample)));
        }
        positions
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::plane::{GivenDisks, Lattice};
    use crate::points::{Boundary, Domain};
    use crate::volume::search::square;

    fn positions(lattice: &Lattice<3>, seed: u64, level: Level) -> Vec<Centre> {
        let context = Context::new(1).unwrap();
        let given = GivenDisks::default();
        let space = Space { lattice, given: &given, solid: None };
        let set = context.run(None, |job| Set::new(job, space, seed, level)).unwrap();
        set.into_points()
    }

    #[test]
    fn all_levels_of_vector_instructions_make_the_same_set() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [0.0; 3], max: [1.0, 0.9, 0.3], boundary };
            let lattice = Lattice::of_any_size(&domain, 0.04).unwrap();
            let portable = positions(&lattice, 5, Level::Portable);
            assert!(portable.len() > 2_000);
            assert!(Level::available().into_iter().all(|level| positions(&lattice, 5, level) == portable));
        }
    }

    /// Domains of few floats, in which every lattice point is tested against every sample.
    #[test]
    fn every_lattice_point_is_covered_and_no_two_samples_conflict() {
        let spacing = f64::from(f32::EPSILON);
        let cases =
            [([90, 70, 80], 64.0), ([200, 150, 3], 64.9), ([130, 2, 1], 65.0), ([64, 64, 64], 64.0), ([9, 5, 7], 99.0)];
        for (boundary, (size, radius)) in
            [Boundary::Periodic, Boundary::Bounded].into_iter().flat_map(|b| cases.map(|c| (b, c)))
        {
            for seed in 0..4 {
                let max = size.map(|x: i32| 1.0 + f64::from(x) * spacing);
                let lattice = Lattice::of_any_size(&Domain { min: [1.0; 3], max, boundary }, radius * spacing).unwrap();
                assert_eq!(lattice.size, size);
                let samples = positions(&lattice, seed, Level::widest());
                let nearest = |point: Centre| {
                    let image = |sample: Centre| -> Centre {
                        std::array::from_fn(|axis| {
                            let d = (point[axis] - sample[axis]).abs();
                            if boundary == Boundary::Periodic { d.min(size[axis] - d) } else { d }
                        })
                    };
                    samples
                        .iter()
                        .map(|&sample| square(image(sample), [0; 3]))
                        .filter(|&d2| d2 > 0)
                        .min()
                        .unwrap_or(i64::MAX)
                };
                assert!(samples.iter().all(|&sample| nearest(sample) >= lattice.separation.threshold));
                for z in 0..size[2] {
                    for point in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y, z])) {
                        assert!(samples.contains(&point) || nearest(point) < lattice.separation.threshold, "{point:?}");
                    }
                }
            }
        }
    }
}
