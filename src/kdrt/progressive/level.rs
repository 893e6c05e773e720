//! A level: what the samples of the levels before leave farther than its radius is filled around them, by the blocks
//! and phases of KDRT (`blocks.rs`).
//!
//! A new sample has the distance to the nearest sample that was there when it was accepted: one of the levels before,
//! of its own block, or of a block of an earlier phase. Some sample of the levels before is nearer than their radius,
//! which is at most 1.5 times that of this level, and blocks of one phase are farther apart than that; so the order in
//! which these are filled does not matter to the distance either. The radii of the first levels fall faster: they are
//! filled as a whole.

use std::sync::Arc;

use crate::error::Result;
use crate::job::Job;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::plane::{CellAxis, CellGrid, Quadtree};
use crate::points::Boundary;
use crate::rng::{Draw, Rng};

use crate::kdrt::around::Around;
use crate::kdrt::blocks::Blocks;
use crate::kdrt::conquer::SeamCells;
use crate::kdrt::fill::Filling;
use crate::kdrt::progressive::Sample;
use crate::kdrt::progressive::ladder::crowded_radius;
use crate::kdrt::region::{Part, Region};
use crate::kdrt::stack::Layer;
use crate::kdrt::stamp::Stamps;
use crate::kdrt::tiling::{cut, is_wide};

/// Fill blocks along the side of the windows that are filled at once.
const WINDOW_BLOCKS: i32 = 256;

/// A level of a plane.
pub struct Level {
    lattice: Lattice,
    axes: [CellAxis; 2],
    /// The largest distance along an axis to the nearest sample of the levels before.
    sight: i32,
    /// The radius of the level before.
    before: f64,
    /// A plane that is kept has all samples of the levels that have no more than this in the whole domain.
    most_kept: f64,
    /// None for one of the first levels, and on a torus on which blocks could see themselves: these are filled as a
    /// whole.
    blocks: Option<Blocks>,
    /// Where cells are as wide as stamps need them.
    stamps: Option<Stamps>,
    seed: u64,
    around: Arc<Around>,
}

impl Level {
    /// The level of a lattice's radius, after one of a longer radius in lattice units.
    pub fn new(lattice: Lattice, before: &Lattice, seed: u64, around: Arc<Around>, most_kept: f64) -> Self {
        let axes = lattice.size.map(|size| CellAxis::new(size, lattice.radius));
        let is_wide = is_wide(&lattice);
        // With a reserve, as radii are rounded.
        let is_first = lattice.radius > crowded_radius(lattice.size.map(f64::from)) * (1.0 - 1e-6);
        let is_cut = !is_first && (is_wide || lattice.boundary == Boundary::Bounded);
        let blocks = is_cut.then(|| Blocks::new(&lattice, seed));
        let sides = [0, 1].map(|axis: usize| axes[axis].side());
        Self {
            sight: before.separation.reach,
            before: before.radius,
            most_kept,
            stamps: is_wide.then(|| Stamps::new(lattice.radius, sides)),
            axes,
            blocks,
            seed,
            around,
            lattice,
        }
    }

    /// The radius in lattice units.
    pub fn radius(&self) -> f64 {
        self.lattice.radius
    }

    /// The lattice points whose samples a window of blocks depends on.
    fn known(&self, blocks: &Blocks, window: &Rect) -> Rect {
        let rect = blocks.rect(&blocks.filled(window)).grown(self.sight);
        match self.lattice.boundary {
            Boundary::Periodic => rect,
            Boundary::Bounded => rect.intersection(&self.lattice.rect()),
        }
    }

    /// The samples of this level in a window of blocks, as far as they lie in `rect`.
    fn fill_window(&self, blocks: &Blocks, before: &Region<Sample>, window: &Rect, rect: &Rect) -> Vec<Sample> {
        let known = self.known(blocks, window);
        let mut grid = CellGrid::new(&self.axes, &known, self.lattice.separation);
        grid.set_obstacles(self.around.near(&known));
        before.visit(&known, |sample| grid.insert(grid.cell(sample.point), sample.point));
        let rect = blocks.rect(window).intersection(rect);
        let mut samples = Vec::new();
        let mut accepted = |grid: &CellGrid, point| {
            if rect.contains(point) {
                samples.push(Sample { point, square: grid.nearest_square(point, self.sight) });
            }
        };
        match &self.stamps {
            Some(stamps) => {
                let mut filling = Filling::new(stamps, SeamCells::all(&grid), self.lattice.separation.reach);
                blocks.in_phases(&mut grid, window, |grid, block, place| {
                    filling.fill(grid, block, || blocks.rng(place), &mut accepted);
                });
            }
            None => blocks.in_phases(&mut grid, window, |grid, block, place| {
                Quadtree::of_empty_cells(grid, block.rect).fill(grid, &mut blocks.rng(place), &mut accepted);
            }),
        }
        samples
    }

    /// Fills the domain as a whole.
    fn fill_whole(&self, job: &Job, before: &Region<Sample>) -> Result<Vec<Sample>> {
        let (rect, separation) = (self.lattice.rect(), self.lattice.separation);
        let grid_before = || {
            let mut grid = match self.lattice.boundary {
                Boundary::Periodic => CellGrid::torus(&self.axes, separation),
                Boundary::Bounded => CellGrid::new(&self.axes, &rect, separation),
            };
            grid.set_obstacles(self.around.near(&rect));
            before.samples().iter().for_each(|sample| grid.insert(grid.cell(sample.point), sample.point));
            grid
        };
        let (mut grid, mut points) = (grid_before(), Vec::new());
        let mut rng = Rng::at(self.seed, Draw::Darts, &[]);
        let expected = self.lattice.expected_samples();
        Quadtree::of_empty_cells(&grid, rect).rain(job, &mut grid, &mut rng, expected, |point| points.push(point))?;

        // Once more in their order, for the distances.
        let mut grid = grid_before();
        let samples = points.into_iter().map(|point| {
            let square = self.nearest_square(&grid, point);
            grid.insert(grid.cell(point), point);
            Sample { point, square }
        });
        Ok(samples.collect())
    }

    /// The squared distance to the nearest sample of the whole domain.
    fn nearest_square(&self, grid: &CellGrid, point: [i32; 2]) -> i64 {
        let [x, y] = point;
        let around = Rect { min: point, max: [x + 1, y + 1] }.grown(self.sight);
        // What reaches around a torus has every sample once, and the nearest image of each is to be looked for.
        let part = Part::new(&self.lattice, &around);
        let whole = Part::whole(&self.lattice);
        let square = |sample: [i32; 2]| -> i64 {
            let along = |axis: usize| {
                let along = (sample[axis] - point[axis]).abs();
                let nearest = match self.lattice.boundary {
                    Boundary::Periodic => along.min(self.lattice.size[axis] - along),
                    Boundary::Bounded => along,
                };
                i64::from(nearest).pow(2)
            };
            along(0) + along(1)
        };
        let pieces = whole.images(&part.rect);
        let squares = pieces.flat_map(|(piece, _)| grid.samples_in(&piece)).map(square);
        squares.min().unwrap_or(i64::MAX)
    }
}

impl Layer for Level {
    type Sample = Sample;

    fn is_kept(&self) -> bool {
        self.expected(&Part::whole(&self.lattice)) <= self.most_kept
    }

    fn expected(&self, part: &Part) -> f64 {
        self.lattice.samples_in(&part.rect)
    }

    fn around(&self, part: &Part) -> Part {
        match &self.blocks {
            Some(blocks) => Part::new(&self.lattice, &self.known(blocks, &blocks.holding(&part.rect))),
            None => Part::whole(&self.lattice),
        }
    }

    fn sorted(&self, part: Part, before: &[Sample]) -> Region<Sample> {
        Region::new(part, before, self.before.min(self.radius() * 2.0))
    }

    fn fill(&self, job: &Job, before: &Region<Sample>, part: &Part) -> Result<Vec<Sample>> {
        let Some(blocks) = &self.blocks else {
            let samples = self.fill_whole(job, before)?;
            return Ok(Region::new(Part::whole(&self.lattice), &samples, self.radius()).samples_of(part));
        };
        let windows = cut(&blocks.holding(&part.rect), WINDOW_BLOCKS);
        job.flat_map(windows.len(), |i| self.fill_window(blocks, before, &windows[i], &part.rect))
    }
}
