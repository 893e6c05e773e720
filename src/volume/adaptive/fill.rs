//! Filling a block where radii vary: first darts, and the rounds that make its set maximal, as in a set of one radius
//! (`volume/fill.rs`, Ebeida et al. 2012). Each open voxel has a lower bound of its radii.

use crate::plane::Rect;
use crate::rng::Rng;
use crate::simd::{Lanes, Work};
use crate::volume::adaptive::field::RadiusField;
use crate::volume::adaptive::grid::{Ball, GradedGrid};
use crate::volume::fill::{DARTS, FIRST_DARTS, Pass};
use crate::volume::search::Centre;
use crate::volume::shape::{Shape, Voxels};
use crate::volume::voxels::{Level, Voxel};

/// First darts fall on a cell in proportion to its density, but no less often than this.
const LEAST_SHARE: f32 = 1.0 / 64.0;

/// The most voxels of a level, per cell: slopes of 1 take about forty.
const MOST_VOXELS: usize = 1 << 10;

/// One pass over a block. The result are the new samples in it.
pub struct Fill<'a, S> {
    /// The part of the block that is filled.
    pub shape: S,
    /// Memory that is used again.
    pub grid: &'a mut GradedGrid,
    pub field: &'a RadiusField<'a>,
    pub pass: Pass,
    pub block: Rect<3>,
    /// An upper bound of the radius in the block.
    pub most: f64,
    /// The lattice points that darts fall on, and bounds of the radius there.
    pub region: Rect<3>,
    pub around: [f64; 2],
    /// The unit of the grid.
    pub unit: f64,
    /// The samples that stand in the region and near it, with their images.
    pub standing: &'a [Ball],
    /// The displacements of the images of a new sample that matter to the block.
    pub images: &'a [[i32; 3]],
    pub rng: Rng,
}

impl<'a, S> Fill<'a, S> {
    /// The same of another shape.
    pub fn of_shape<T>(self, shape: T) -> Fill<'a, T> {
        let Self { grid, field, pass, block, most, region, around, unit, standing, images, rng, .. } = self;
        Fill { shape, grid, field, pass, block, most, region, around, unit, standing, images, rng }
    }
}

/// Open voxels, and half a lower bound of the radius in each.
#[derive(Default)]
struct Open {
    voxels: Voxels,
    lower: [Vec<f32>; 2],
}

impl Open {
    fn clear(&mut self) {
        self.voxels.clear();
        self.lower.iter_mut().for_each(Vec::clear);
    }

    /// A voxel, true if it is cut, and its bound.
    #[inline(always)]
    fn get(&self, number: usize) -> (Voxel, bool, f32) {
        let (voxel, is_cut) = self.voxels.get(number);
        let inside = self.voxels.inside.len();
        (voxel, is_cut, if is_cut { self.lower[1][number - inside] } else { self.lower[0][number] })
    }

    /// Adds the parts of a voxel that lie in the shape, and those that are cut.
    #[inline(always)]
    fn push(&mut self, level: &Level, voxel: Voxel, [inside, cut]: [u64; 2], lower: f32) {
        level.push_parts(voxel, inside, &mut self.voxels.inside);
        self.lower[0].resize(self.voxels.inside.len(), lower);
        level.push_parts(voxel, cut, &mut self.voxels.cut);
        self.lower[1].resize(self.voxels.cut.len(), lower);
    }
}

impl<S: Shape> Work for Fill<'_, S> {
    type Out = Vec<Ball>;

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) -> Vec<Ball> {
        self.grid.reset(&self.region, self.around, self.unit, self.field);
        self.shape.begin(&self.grid.cells);
        let (levels, mut accepted) = (self.grid.cells.levels(), Vec::new());
        let voxels = self.shape.cells(lanes, &self.grid.cells, self.grid.cells.open_cells());
        if voxels.is_empty() || self.field.has_failed() {
            return accepted;
        }
        self.grid.reserve(self.standing.len());
        for &ball in self.standing {
            self.grid.add(ball);
        }
        let mut open = Open { voxels, ..Open::default() };
        let lower = [&open.voxels.inside, &open.voxels.cut];
        open.lower = lower.map(|voxels| voxels.iter().map(|voxel| self.grid.lower(voxel.cell)).collect());
        match self.pass {
            Pass::First => self.throw_first(lanes, &levels, &open, &mut accepted),
            Pass::Last => self.close(lanes, &levels, open, &mut accepted),
        }
        accepted
    }
}

impl<S: Shape> Fill<'_, S> {
    /// Throws darts on all open cells, and on the parts of cut ones that may lie in the shape.
    #[inline(always)]
    fn throw_first<L: Lanes>(&mut self, lanes: L, levels: &[Level], open: &Open, accepted: &mut Vec<Ball>) {
        let (cells, mut parts) = (&levels[0], Open::default());
        let per_cell = u64::from(cells.all.count_ones());
        for (&voxel, &lower) in open.voxels.cut.iter().zip(&open.lower[1]) {
            if cells.is_last {
                break;
            }
            let found = self.shape.parts(lanes, &self.grid.cells, cells, voxel, cells.all);
            parts.push(cells, voxel, found, lower);
        }
        let sides = self.grid.cells.sides();
        let lengths = std::array::from_fn(|axis| f64::from(self.region.length(axis)));
        let expected = |voxel: &Voxel| self.field.samples(self.grid.bounds(voxel.cell)[0], sides, lengths);
        let of_parts = parts.voxels.inside.iter().chain(&parts.voxels.cut).map(expected).sum::<f64>() / per_cell as f64;
        let expected = open.voxels.inside.iter().map(expected).sum::<f64>() + of_parts;
        let (mut left, least) = ((FIRST_DARTS * expected).ceil() as u64, (0.5 * self.around[0] / self.unit) as f32);
        let whole = open.voxels.inside.len() as u64 * per_cell;
        let all = whole + parts.voxels.len() as u64;
        if all == 0 {
            return;
        }
        while left > 0 {
            let number = self.rng.below(all);
            let (level, (voxel, is_cut, lower)) = if number < whole {
                (cells, open.get((number / per_cell) as usize))
            } else {
                (&levels[1], parts.get((number - whole) as usize))
            };
            let density = least / lower * (least / lower) * (least / lower);
            if lower > least && self.rng.unit() as f32 >= density.max(LEAST_SHARE) {
                continue;
            }
            left -= 1;
            self.throw(lanes, level, voxel, is_cut, lower, accepted);
        }
    }

    /// Throws darts on open voxels and divides them, until none is open.
    #[inline(always)]
    fn close<L: Lanes>(&mut self, lanes: L, levels: &[Level], mut open: Open, accepted: &mut Vec<Ball>) {
        let (mut parts, mut number) = (Open::default(), 0);
        let most = MOST_VOXELS * self.grid.cells.cells();
        loop {
            let level = &levels[number];
            if open.voxels.len() > most {
                self.field.exceed_work(self.block.min);
            }
            if self.field.has_failed() {
                return;
            }
            // First darts have fallen on whole cells: the rounds begin with their parts.
            if number > 0 && !open.voxels.is_empty() {
                let per_voxel = DARTS[(number - 1).min(DARTS.len() - 1)];
                let mut left = (per_voxel * open.voxels.len() as f64).ceil() as u64;
                while left > 0 {
                    left -= 1;
                    let (voxel, is_cut, lower) = open.get(self.rng.below(open.voxels.len() as u64) as usize);
                    self.throw(lanes, level, voxel, is_cut, lower, accepted);
                }
            }
            if level.is_last {
                return self.search(level, &open.voxels.inside, accepted);
            }
            parts.clear();
            let mut index = 0;
            while index < open.voxels.len() {
                let (voxel, is_cut, lower) = open.get(index);
                index += 1;
                let lower = self.grid.narrowed(self.field, level, voxel, lower);
                let bits = self.grid.open_parts(lanes, level, voxel, lower);
                if bits != 0 {
                    let found =
                        if is_cut { self.shape.parts(lanes, &self.grid.cells, level, voxel, bits) } else { [bits, 0] };
                    parts.push(level, voxel, found, lower);
                }
            }
            std::mem::swap(&mut open, &mut parts);
            number += 1;
        }
    }

    #[inline(always)]
    fn throw<L: Lanes>(
        &mut self,
        lanes: L,
        level: &Level,
        voxel: Voxel,
        is_cut: bool,
        lower: f32,
        accepted: &mut Vec<Ball>,
    ) {
        let dart = self.grid.cells.dart(level, voxel, self.rng.bits());
        if let Some(sample) = self.grid.hit(lanes, self.field, &dart, lower)
            && (!is_cut || self.shape.holds(sample.centre))
        {
            self.accept(sample, accepted);
        }
    }

    /// Puts samples on open lattice points of voxels, which are sorted by cell, until there are none.
    fn search(&mut self, level: &Level, open: &[Voxel], accepted: &mut Vec<Ball>) {
        for voxels in open.chunk_by(|a, b| a.cell == b.cell) {
            let cell = voxels[0].cell;
            let (mut near, bounds) = (self.grid.balls_near(self.field, cell), self.grid.bounds(cell));
            for &voxel in voxels {
                let points = self.grid.cells.points(level, voxel);
                while let Some(point) = self.open_point(&points, &near, bounds) {
                    let centre = self.grid.cells.absolute(point);
                    let radius = self.field.at_point(centre, bounds);
                    if self.field.has_failed() || self.grid.is_covered(point, radius) {
                        self.field.reject(centre);
                        return;
                    }
                    let known = self.grid.balls().len();
                    self.accept(Ball { centre, radius }, accepted);
                    near.extend(&self.grid.balls()[known..]);
                }
            }
        }
    }

    /// A lattice point of a box that no ball covers, if there is one.
    fn open_point(&self, points: &Rect<3>, balls: &[Ball], bounds: [f64; 2]) -> Option<Centre> {
        if points.is_empty() {
            return None;
        }
        let last = points.max.map(|x| x - 1);
        let bounds = if points.min == last {
            [self.field.at_point(self.grid.cells.absolute(last), bounds); 2]
        } else {
            let half = |axis: usize| 0.5 * f64::from(points.length(axis) - 1);
            let along = |axis: usize| f64::from(self.region.min[axis]) + f64::from(points.min[axis]) + half(axis);
            let square: f64 = (0..3).map(|axis| half(axis) * half(axis)).sum();
            self.field.around(std::array::from_fn(along), square.sqrt(), bounds)
        };
        if balls.iter().any(|ball| ball.covers_box(points, bounds[0])) {
            return None;
        }
        let touching: Vec<_> = balls.iter().copied().filter(|ball| ball.touches(points, bounds[1])).collect();
        if touching.is_empty() {
            return Some(points.min);
        }
        let axis = (0..3).max_by_key(|&axis| points.length(axis)).filter(|&axis| points.length(axis) > 1)?;
        let middle = points.min[axis] + points.length(axis) / 2;
        let mut halves = [*points; 2];
        (halves[0].max[axis], halves[1].min[axis]) = (middle, middle);
        halves.iter().find_map(|half| self.open_point(half, &touching, bounds))
    }

    #[inline(always)]
    fn accept(&mut self, sample: Ball, accepted: &mut Vec<Ball>) {
        self.grid.add(sample);
        for image in self.images {
            self.grid.add(Ball { centre: std::array::from_fn(|axis| sample.centre[axis] + image[axis]), ..sample });
        }
        if self.block.contains(sample.centre) {
            // Blocks that are filled at the same time rely on the bound.
            if sample.radius > self.most + self.field.slack(self.most) {
                self.field.reject(sample.centre);
            }
            accepted.push(sample);
        }
    }
}
