//! A set of a domain where radii vary, filled octave by octave and block by block.

use crate::error::Result;
use crate::job::Job;
use crate::plane::Rect;
use crate::rng::{Draw, Rng};
use crate::simd::Level;
use crate::volume::adaptive::blocks::Blocks;
use crate::volume::adaptive::fill::Fill;
use crate::volume::adaptive::grid::{Ball, GradedGrid};
use crate::volume::adaptive::ground::Ground;
use crate::volume::fill::Pass;
use crate::volume::grid::Grids;

/// The samples of a domain, by blocks.
struct Set<'a> {
    ground: Ground<'a>,
    blocks: &'a Blocks,
    samples: Vec<Vec<Ball>>,
    grids: Grids<GradedGrid>,
    level: Level,
}

/// A maximal set, block after block.
pub fn maximal(job: &Job, ground: Ground, blocks: &Blocks) -> Result<Vec<Ball>> {
    let samples = vec![Vec::new(); blocks.blocks.len()];
    let mut set = Set { ground, blocks, samples, grids: Grids::default(), level: Level::widest() };
    // In each octave the first pass goes over all blocks: they have rivals at their faces, which leave fewer traces then.
    let (all, mut done) = ((Pass::ALL.len() * blocks.blocks.len()) as f64, 0);
    for octave in &blocks.octaves {
        for &pass in Pass::ALL {
            for wave in octave {
                let part = job.part(done as f64 / all, (done + wave.len()) as f64 / all);
                let added = part.map(wave.len(), |index| set.fill(wave[index], pass))?;
                done += wave.len();
                for (&block, added) in wave.iter().zip(added) {
                    set.samples[block as usize].extend(added?);
                }
            }
        }
    }
    Ok(set.samples.into_iter().flatten().collect())
}

impl Set<'_> {
    /// The new samples of one pass over a block, which depend only on its place and on the samples around it.
    fn fill(&self, number: u32, pass: Pass) -> Result<Vec<Ball>> {
        let (block, field) = (&self.blocks.blocks[number as usize], &self.ground.field.apart());
        let (region, around) = match pass {
            Pass::First => (block.region, block.around),
            Pass::Last => (block.rect, block.bounds),
        };
        let mut grid = self.grids.take();
        let fill = Fill {
            shape: (),
            grid: &mut grid,
            field,
            pass,
            block: block.rect,
            most: block.bounds[1],
            region,
            around,
            unit: self.ground.unit(around),
            standing: &self.standing(number, &region, around[1] + field.slack(around[1])),
            images: &block.images,
            rng: Rng::at(block.key, Draw::Volume, &[pass as u64]),
        };
        let added = self.ground.run(self.level, fill);
        self.grids.give(grid);
        field.check()?;
        Ok(added)
    }

    /// The samples of a block and of its neighbours, with all images, that may cover a place of a region whose radii are at most
    /// this.
    fn standing(&self, number: u32, region: &Rect<3>, most: f64) -> Vec<Ball> {
        let block = &self.blocks.blocks[number as usize];
        let own = &self.samples[number as usize];
        // Of a block of large radii these can be more than all others: memory is taken once, and not more and more.
        let of_neighbours: usize = block.neighbours.iter().map(|&(other, _)| self.samples[other as usize].len()).sum();
        let mut standing = Vec::with_capacity(own.len() + of_neighbours);
        standing.extend(own);
        for &(other, image) in &block.neighbours {
            let moved =
                |ball: &Ball| Ball { centre: std::array::from_fn(|axis| ball.centre[axis] + image[axis]), ..*ball };
            let images = self.samples[other as usize].iter().map(moved);
            // A dart is rounded to a lattice point of the region.
            standing.extend(images.filter(|ball| ball.touches(region, most)));
        }
        standing
    }
}
