//! A set of a cuboid, filled block by block.

use std::sync::{Mutex, PoisonError};

use crate::error::Result;
use crate::job::Job;
use crate::plane::{GivenDisks, Lattice, Rect};
use crate::rng::{Draw, Rng};
use crate::simd::{self, Level};
use crate::volume::blocks::Blocks;
use crate::volume::fill::{Fill, Pass};
use crate::volume::grid::Grid;
use crate::volume::search::Centre;

/// The samples of a cuboid as lattice points, by their blocks.
pub struct Set<'a> {
    lattice: &'a Lattice<3>,
    given: &'a GivenDisks<3>,
    blocks: Blocks,
    samples: Vec<Vec<Centre>>,
    /// Grids that no thread uses now.
    grids: Mutex<Vec<Grid>>,
    level: Level,
}

impl<'a> Set<'a> {
    /// A maximal set around given balls, by instructions of some level.
    ///
    /// Both passes go over all blocks. The first brings three quarters of the samples, with rivals around each block, so
    /// that the faces of blocks leave few traces (docs/design/volume.md). Rivals in the last pass would leave gaps: what a
    /// dropped sample covers would be open.
    pub fn new(job: &Job, lattice: &'a Lattice<3>, given: &'a GivenDisks<3>, seed: u64, level: Level) -> Result<Self> {
        let blocks = Blocks::new(lattice, seed);
        let (count, mut done) = (blocks.leaves.len(), 0);
        let mut set = Self { lattice, given, blocks, samples: vec![Vec::new(); count], grids: Mutex::default(), level };
        let share = |done: usize| done as f64 / (Pass::ALL.len() * count) as f64;
        for pass in Pass::ALL {
            for number in 0..set.blocks.waves.len() {
                let wave = &set.blocks.waves[number];
                let part = job.part(share(done), share(done + wave.len()));
                let added = part.map(wave.len(), |index| set.fill(wave[index], pass))?;
                done += wave.len();
                for (&block, added) in wave.iter().zip(added) {
                    let samples = &mut set.samples[block as usize];
                    samples.reserve_exact(added.len());
                    samples.extend(added);
                }
            }
        }
        Ok(set)
    }

    /// The new samples of one pass over a block, which depend only on its place and on the samples around it.
    fn fill(&self, block: u32, pass: Pass) -> Vec<Centre> {
        let Self { lattice, blocks, .. } = self;
        let leaf = &blocks.leaves[block as usize];
        let region = blocks.region(lattice, &leaf.rect, pass);
        let around = self.around(block, &region.grown(lattice.separation.reach + 1));
        let grids = || self.grids.lock().unwrap_or_else(PoisonError::into_inner);
        let mut grid = grids().pop().unwrap_or_default();
        let fill = Fill {
            grid: &mut grid,
            pass,
            block: leaf.rect,
            region,
            radius: lattice.radius,
            separation: lattice.separation,
            around: &around,
            given: &self.given.near(&region),
            images: &blocks.images,
            rng: Rng::at(leaf.key, Draw::Volume, &[pass as u64]),
        };
        let added = simd::run(self.level, fill);
        grids().push(grid);
        added
    }

    /// The samples of a block, and those of its neighbours in a window, with all images that matter.
    fn around(&self, block: u32, window: &Rect<3>) -> Vec<Centre> {
        let moved = |sample: Centre, by: [i32; 3]| -> Centre { std::array::from_fn(|axis| sample[axis] + by[axis]) };
        let mut around = self.samples[block as usize].clone();
        for &(other, image) in &self.blocks.neighbours[block as usize] {
            let images = self.samples[other as usize].iter().map(|&sample| moved(sample, image));
            around.extend(images.filter(|&sample| window.contains(sample)));
        }
        let count = around.len();
        for &image in &self.blocks.images {
            around.extend_from_within(..count);
            let start = around.len() - count;
            around[start..].iter_mut().for_each(|sample| *sample = moved(*sample, image));
        }
        around
    }

    /// The coordinates of the samples, block after block.
    pub fn into_positions(self) -> Vec<[f32; 3]> {
        let mut positions = Vec::with_capacity(self.samples.iter().map(Vec::len).sum());
        for samples in self.samples {
            positions.extend(samples.into_iter().map(|sample| self.lattice.position(sample)));
        }
        positions
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::volume::search::square;

    fn positions(lattice: &Lattice<3>, seed: u64, level: Level) -> Vec<Centre> {
        let context = Context::new(1).unwrap();
        let set = context.run(None, |job| Set::new(job, lattice, &GivenDisks::default(), seed, level)).unwrap();
        set.samples.into_iter().flatten().collect()
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
