//! Filling a block: first darts, and the rounds that make its set maximal.
//!
//! Source: Ebeida et al. 2012, "A simple algorithm for maximal Poisson-disk sampling in high dimensions". Departures: a voxel
//! is divided into 4 × 4 × 4 parts at once, of which a ball's cover is a mask of 64 bits; a round throws its darts before it
//! divides; and voxels that are left at the end are searched for open lattice points in integers, so that none is left.

use crate::plane::{Disk, Rect, Separation};
use crate::points::MAXIMAL_DENSITY_IN_SPACE;
use crate::rng::Rng;
use crate::simd::{Lanes, Work};
use crate::volume::grid::Grid;
use crate::volume::search::{Centre, open_point};
use crate::volume::shape::{Shape, Voxels};
use crate::volume::voxels::{Level, Voxel};

/// The first darts for each sample that will stand in the region: they bring three quarters of them.
pub const FIRST_DARTS: f64 = 20.0;

/// A region that is thinner than this, in radii, has as many samples as one of this thickness: those of a plane.
const THIN: f64 = 0.95;

/// The darts of a round for each voxel: from the first round on, the last for all others.
pub const DARTS: [f64; 4] = [1.0, 1.0, 1.0, 2.0];

/// The part of a fill that is done at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// First darts, also around the block: those are its rivals at its border, and are dropped.
    First,
    /// The rounds, until the block is covered.
    Last,
}

impl Pass {
    /// The passes in their order.
    pub const ALL: &[Self] = &[Self::First, Self::Last];
    /// Those where samples cover most of the domain already.
    pub const LAST: &[Self] = &[Self::Last];
}

/// One pass over a block. The result are the new samples in it.
pub struct Fill<'a, S> {
    /// The part of the block that is filled.
    pub shape: S,
    /// Memory that is used again.
    pub grid: &'a mut Grid,
    pub pass: Pass,
    pub block: Rect<3>,
    /// The lattice points that darts fall on.
    pub region: Rect<3>,
    /// In lattice units.
    pub radius: f64,
    pub separation: Separation,
    /// The samples that stand in the region and near it, with their images.
    pub around: &'a [Centre],
    /// The given balls that may have points of the region.
    pub given: &'a [Disk<3>],
    /// The displacements of the images of a new sample that matter to the block.
    pub images: &'a [[i32; 3]],
    pub rng: Rng,
}

impl<'a, S> Fill<'a, S> {
    /// The same of another shape.
    pub fn of_shape<T>(self, shape: T) -> Fill<'a, T> {
        let Self { grid, pass, block, region, radius, separation, around, given, images, rng, .. } = self;
        Fill { shape, grid, pass, block, region, radius, separation, around, given, images, rng }
    }
}

impl<S: Shape> Work for Fill<'_, S> {
    type Out = Vec<Centre>;

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) -> Vec<Centre> {
        self.grid.reset(&self.region, self.radius, self.separation, self.given);
        self.shape.begin(self.grid);
        for &sample in self.around {
            if self.shape.needs(self.grid, sample) {
                self.grid.add(lanes, sample);
            }
        }
        // Compiled twice, so that sets without given samples pay nothing for them.
        if self.given.is_empty() { self.fill::<L, false>(lanes) } else { self.fill::<L, true>(lanes) }
    }
}

impl<S: Shape> Fill<'_, S> {
    #[inline(always)]
    fn fill<L: Lanes, const GIVEN: bool>(mut self, lanes: L) -> Vec<Centre> {
        let (levels, mut accepted) = (self.grid.levels(), Vec::new());
        let open = self.shape.cells(lanes, self.grid, self.grid.open_cells());
        match self.pass {
            _ if open.is_empty() => (),
            Pass::First => self.throw_first::<L, GIVEN>(lanes, &levels, &open, &mut accepted),
            Pass::Last => self.close::<L, GIVEN>(lanes, &levels, open, &mut accepted),
        }
        accepted
    }

    /// Throws darts on all open cells, and on the parts of cut ones that may lie in the shape.
    #[inline(always)]
    fn throw_first<L: Lanes, const GIVEN: bool>(
        &mut self,
        lanes: L,
        levels: &[Level],
        open: &Voxels,
        accepted: &mut Vec<Centre>,
    ) {
        let (cells, mut parts) = (&levels[0], Voxels::default());
        let (per_cell, mut index) = (u64::from(cells.all.count_ones()), 0);
        while index < open.cut.len() && !cells.is_last {
            let [inside, cut] = self.shape.parts(lanes, self.grid, cells, open.cut[index], cells.all);
            cells.push_parts(open.cut[index], inside, &mut parts.inside);
            cells.push_parts(open.cut[index], cut, &mut parts.cut);
            index += 1;
        }
        let side = |axis: usize| (f64::from(self.region.length(axis)) / self.radius).max(THIN);
        let expected = MAXIMAL_DENSITY_IN_SPACE * (0..3).map(side).product::<f64>();
        let whole = open.inside.len() as u64 * per_cell;
        let share = (whole + parts.len() as u64) as f64 / (self.grid.cells() as u64 * per_cell) as f64;
        let mut left = (FIRST_DARTS * expected * share).ceil() as u64;
        if parts.is_empty() {
            let inside = &open.inside;
            while left > 0 {
                left -= 1;
                let cell = inside[self.rng.below(inside.len() as u64) as usize];
                self.throw::<L, GIVEN>(lanes, cells, cell, false, accepted);
            }
            return;
        }
        while left > 0 {
            left -= 1;
            let number = self.rng.below(whole + parts.len() as u64);
            if number < whole {
                let cell = open.inside[(number / per_cell) as usize];
                self.throw::<L, GIVEN>(lanes, cells, cell, false, accepted);
            } else {
                let (voxel, is_cut) = parts.get((number - whole) as usize);
                self.throw::<L, GIVEN>(lanes, &levels[1], voxel, is_cut, accepted);
            }
        }
    }

    /// Throws darts on open voxels and divides them, until none is open.
    #[inline(always)]
    fn close<L: Lanes, const GIVEN: bool>(
        &mut self,
        lanes: L,
        levels: &[Level],
        mut open: Voxels,
        accepted: &mut Vec<Centre>,
    ) {
        let (mut parts, mut number) = (Voxels::default(), 0);
        loop {
            let level = &levels[number];
            // First darts have fallen on whole cells: the rounds begin with their parts.
            if number > 0 && !open.is_empty() {
                let per_voxel = DARTS[(number - 1).min(DARTS.len() - 1)];
                let left = (per_voxel * open.len() as f64).ceil() as u64;
                self.throw_all::<L, GIVEN>(lanes, level, &open, left, accepted);
            }
            if level.is_last {
                return self.search(lanes, level, &open.inside, accepted);
            }
            parts.clear();
            let mut index = 0;
            while index < open.inside.len() {
                let bits = self.grid.open_parts::<L, GIVEN>(lanes, level, open.inside[index]);
                level.push_parts(open.inside[index], bits, &mut parts.inside);
                index += 1;
            }
            let mut index = 0;
            while index < open.cut.len() {
                let bits = self.grid.open_parts::<L, GIVEN>(lanes, level, open.cut[index]);
                if bits != 0 {
                    let [inside, cut] = self.shape.parts(lanes, self.grid, level, open.cut[index], bits);
                    level.push_parts(open.cut[index], inside, &mut parts.inside);
                    level.push_parts(open.cut[index], cut, &mut parts.cut);
                }
                index += 1;
            }
            std::mem::swap(&mut open, &mut parts);
            number += 1;
        }
    }

    /// Throws darts on voxels at random.
    #[inline(always)]
    fn throw_all<L: Lanes, const GIVEN: bool>(
        &mut self,
        lanes: L,
        level: &Level,
        open: &Voxels,
        mut left: u64,
        accepted: &mut Vec<Centre>,
    ) {
        while left > 0 {
            left -= 1;
            let number = self.rng.below(open.len() as u64) as usize;
            let (voxel, is_cut) = open.get(number);
            self.throw::<L, GIVEN>(lanes, level, voxel, is_cut, accepted);
        }
    }

    #[inline(always)]
    fn throw<L: Lanes, const GIVEN: bool>(
        &mut self,
        lanes: L,
        level: &Level,
        voxel: Voxel,
        is_cut: bool,
        accepted: &mut Vec<Centre>,
    ) {
        let dart = self.grid.dart(level, voxel, self.rng.bits());
        if let Some(sample) = self.grid.hit::<L, GIVEN>(lanes, &dart)
            && (!is_cut || self.shape.holds(sample))
        {
            self.accept(lanes, sample, accepted);
        }
    }

    /// Puts samples on open lattice points of voxels, which are sorted by cell, until there are none.
    fn search<L: Lanes>(&mut self, lanes: L, level: &Level, open: &[Voxel], accepted: &mut Vec<Centre>) {
        for voxels in open.chunk_by(|a, b| a.cell == b.cell) {
            let (mut near, given) = (self.grid.balls_near(voxels[0].cell), self.grid.given_near(voxels[0].cell));
            for &voxel in voxels {
                let points = self.grid.points(level, voxel);
                while let Some(point) = open_point(&points, &near, self.separation.threshold, &given) {
                    let known = self.grid.balls().len();
                    self.accept(lanes, self.grid.absolute(point), accepted);
                    near.extend(&self.grid.balls()[known..]);
                }
            }
        }
    }

    #[inline(always)]
    fn accept<L: Lanes>(&mut self, lanes: L, sample: Centre, accepted: &mut Vec<Centre>) {
        self.grid.add(lanes, sample);
        for image in self.images {
            self.grid.add(lanes, std::array::from_fn(|axis| sample[axis] + image[axis]));
        }
        if self.block.contains(sample) {
            accepted.push(sample);
        }
    }
}
