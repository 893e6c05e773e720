//! The cell list of a block where radii vary: balls with their radii, and bounds of the radius in each cell.
//!
//! A ball of a sample with radius s covers a place of radius r if they are nearer than (s + r) / 2. So each ball has half its
//! radius on its page, and a cell lists the balls that reach it with its largest radius. A voxel is covered by a ball that
//! reaches its farthest corner with a lower bound of its radii.
//!
//! # Exactness
//! All is relative to the cell's centre, in a unit of at most [`LONGEST_UNIT`] times the least radius of the region, as in the grid
//! of one radius (`volume/grid.rs`). So the distance of a conflict is at least 1/3, and an error of coordinates of 1.2·10^-7 times
//! the distance and 2.5·10^-7 makes one of squared distances of 4·10^-6 of the square at most. With a slack of 2^-17 = 7.6·10^-6
//! tests in `f32` give only answers that are certain, whatever the radii; what lies between is decided in `f64` by the squared
//! distance, an integer.

use crate::plane::{Rect, Separation};
use crate::simd::{LANES, Lanes};
use crate::volume::adaptive::field::{BEYOND, RadiusField};
use crate::volume::grid::{Dart, Grid, splat, sum_of_squares};
use crate::volume::search::{Centre, square};
use crate::volume::voxels::{Level, Voxel, VoxelBox};

/// Squared distances in `f32`, relative to those of conflicts, are wrong by less than this.
const SLACK: f32 = 1.0 / (1 << 17) as f32;
const CERTAIN: f32 = 1.0 - SLACK;
const POSSIBLE: f32 = 1.0 + SLACK;

/// More than the rounding of lengths in `f32`, as a share.
const ROUNDING: f64 = 1e-5;

/// The longest unit of a region, in its least radii.
pub const LONGEST_UNIT: f64 = 1.5;

/// The most cells along an axis: regions have sides below 20 of their block's least radius, and cells of .9 · .75 of it.
const MOST_CELLS: usize = 32;

/// The radius of a voxel is asked for if that of its cell is too imprecise: if the radius changes over the voxel by more than this
/// share of the side of its parts.
const FLAT: f64 = 0.1;

/// A sample: its place, and its radius in lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    pub centre: Centre,
    pub radius: f64,
}

impl Ball {
    /// True if a lattice point of this radius is too near.
    #[inline(always)]
    pub fn covers(&self, point: Centre, radius: f64) -> bool {
        (square(self.centre, point) as f64) < limit(self.radius, radius)
    }

    /// True if the ball may cover a point of a box whose radii are at most this.
    pub fn touches(&self, points: &Rect<3>, most: f64) -> bool {
        let nearest = std::array::from_fn(|axis| self.centre[axis].clamp(points.min[axis], points.max[axis] - 1));
        self.covers(nearest, most)
    }

    /// True if the ball covers all points of a box whose radii are at least this.
    pub fn covers_box(&self, points: &Rect<3>, least: f64) -> bool {
        let farthest = std::array::from_fn(|axis| {
            let (first, last) = (points.min[axis], points.max[axis] - 1);
            let is_beyond_middle =
                i64::from(self.centre[axis]) - i64::from(first) > i64::from(last) - i64::from(self.centre[axis]);
            if is_beyond_middle { first } else { last }
        });
        self.covers(farthest, least)
    }
}

/// Two samples whose squared distance is below this conflict.
#[inline(always)]
fn limit(a: f64, b: f64) -> f64 {
    let mean = 0.5 * (a + b);
    // The factor covers the rounding of the squares here and in the user's own check.
    mean * mean * (1.0 + 1e-14)
}

/// The cells of a region, and the balls that may cover places in them.
#[derive(Default)]
pub struct GradedGrid {
    /// The cells, with the centres of balls. Its radius is the unit of all lengths in `f32`.
    pub cells: Grid,
    /// Half the radius of the balls on each page.
    halves: Vec<[f32; LANES]>,
    /// Bounds of the radius in each cell, in lattice units, and half of the lower ones.
    bounds: Vec<[f64; 2]>,
    lower: Vec<f32>,
    /// Half the upper bound of each cell, and some more; and the most of all.
    reach: Vec<f32>,
    farthest: f64,
    origin: Centre,
    counts: [usize; 3],
    unit: f64,
    /// The distance of a dart from its lattice point at most.
    deep: f32,
    /// All balls, relative to the region.
    balls: Vec<Ball>,
}

impl GradedGrid {
    /// Forgets all balls, and covers another region, in which the radius has these bounds.
    pub fn reset(&mut self, region: &Rect<3>, bounds: [f64; 2], unit: f64, field: &RadiusField) {
        self.cells.reset(region, unit, Separation::default(), &[]);
        (self.origin, self.counts, self.unit) = (region.min, self.cells.counts(), unit);
        debug_assert!(self.counts.iter().all(|&count| count <= MOST_CELLS));
        self.deep = (3f64.sqrt() * Grid::margin(unit) / unit) as f32;
        let sides = self.cells.sides();
        let half = 0.5 * sides.iter().map(|side| side * side).sum::<f64>().sqrt();
        self.bounds.clear();
        self.bounds.extend((0..self.cells.cells()).map(|cell| {
            let place = self.cells.place(cell);
            let along = |axis: usize| f64::from(region.min[axis]) + (f64::from(place[axis]) + 0.5) * sides[axis];
            field.around(std::array::from_fn(along), half, bounds)
        }));
        let reach = |most: f64| (1.0 + ROUNDING) * (0.5 * (most + field.slack(most)) + BEYOND) / unit;
        self.lower.clear();
        self.lower.extend(self.bounds.iter().map(|[least, _]| (0.5 * least / unit) as f32));
        self.reach.clear();
        self.reach.extend(self.bounds.iter().map(|&[_, most]| reach(most) as f32));
        self.farthest =
            unit * (1.0 + ROUNDING) * self.reach.iter().fold(0.0, |most: f32, &reach| most.max(reach)) as f64;
        self.halves.clear();
        self.halves.resize(self.cells.pages(), [0.0; LANES]);
        self.balls.clear();
    }

    /// Bounds of the radius in a cell.
    pub fn bounds(&self, cell: u16) -> [f64; 2] {
        self.bounds[cell as usize]
    }

    /// Half the lower bound of the radius in a cell.
    #[inline(always)]
    pub fn lower(&self, cell: u16) -> f32 {
        self.lower[cell as usize]
    }

    /// Takes memory for so many balls, which are added next, and for a quarter as many new ones: of steep radii a block has a hundred
    /// times as many around it as in it.
    pub fn reserve(&mut self, balls: usize) {
        self.balls.reserve_exact(balls + balls / 4);
    }

    /// Lists a ball in all cells where it may cover a place. Its centre need not lie in the region.
    #[inline(always)]
    pub fn add(&mut self, ball: Ball) {
        let (mut local, mut first, mut count) = ([0; 3], [0; 3], [0; 3]);
        // Of the cells along each axis: the vector from their centre, and the squared distance.
        let (mut offsets, mut squares) = ([[0.0f32; MOST_CELLS]; 3], [[0.0f32; MOST_CELLS]; 3]);
        let (reach, sides, per_unit) = (0.5 * ball.radius + self.farthest, self.cells.sides(), 1.0 / self.unit);
        for axis in 0..3 {
            local[axis] = ball.centre[axis] - self.origin[axis];
            let (along, last) = (f64::from(local[axis]), self.counts[axis] as f64 - 1.0);
            let (low, high) =
                (((along - reach) / sides[axis]).floor().max(0.0), ((along + reach) / sides[axis]).floor().min(last));
            if high < low {
                return;
            }
            (first[axis], count[axis]) = (low as usize, high as usize - low as usize + 1);
            for k in 0..count[axis].min(MOST_CELLS) {
                let offset = along - ((first[axis] + k) as f64 + 0.5) * sides[axis];
                let beyond = (offset.abs() - 0.5 * sides[axis]).max(0.0) * per_unit;
                offsets[axis][k] = (offset * per_unit) as f32;
                squares[axis][k] = (beyond * beyond) as f32;
            }
        }
        self.balls.push(Ball { centre: local, ..ball });
        let half = (0.5 * ball.radius * per_unit) as f32;
        let most = half + (self.farthest * per_unit) as f32;
        for z in 0..count[2] {
            for y in 0..count[1] {
                let across = squares[1][y] + squares[2][z];
                if across >= most * most {
                    continue;
                }
                let row = ((first[2] + z) * self.counts[1] + first[1] + y) * self.counts[0] + first[0];
                for x in 0..count[0] {
                    let distance = half + self.reach[row + x];
                    if across + squares[0][x] < distance * distance {
                        self.list(row + x, [offsets[0][x], offsets[1][y], offsets[2][z]], half);
                    }
                }
            }
        }
    }

    /// Puts a ball on a page of a cell.
    #[inline(always)]
    fn list(&mut self, cell: usize, offset: [f32; 3], half: f32) {
        let (page, lane) = self.cells.list(cell, offset);
        if page == self.halves.len() {
            self.halves.push([0.0; LANES]);
        }
        self.halves[page][lane] = half;
    }

    /// The sample at the lattice point next to a dart, unless a ball covers it. `lower` is half a lower bound of the radius there.
    #[inline(always)]
    pub fn hit<L: Lanes>(&self, lanes: L, field: &RadiusField, dart: &Dart, lower: f32) -> Option<Ball> {
        // Nearly all darts miss, most of them without a question for their radius.
        if self.is_within(lanes, dart, lower - self.deep, CERTAIN) {
            return None;
        }
        let (point, rounded) = self.cells.rounded(dart);
        let centre = self.cells.absolute(point);
        let radius = field.at_point(centre, self.bounds(dart.cell));
        let half = (0.5 * radius / self.unit) as f32;
        if self.is_within(lanes, &rounded, half, CERTAIN)
            || self.is_within(lanes, &rounded, half, POSSIBLE) && self.is_covered(point, radius)
        {
            return None;
        }
        Some(Ball { centre, radius })
    }

    /// True if the distance of a dart from a ball's centre is below the sum of both halves, up to a factor of its square.
    #[inline(always)]
    fn is_within<L: Lanes>(&self, lanes: L, dart: &Dart, half: f32, factor: f32) -> bool {
        let ([px, py, pz], mut page) = (splat(lanes, dart.offset), dart.cell as usize);
        let (half, factor) = (lanes.splat(half), lanes.splat(factor));
        loop {
            let ([x, y, z], halves) = (self.cells.page(page), &self.halves[page]);
            let vector = [lanes.sub(lanes.load(x), px), lanes.sub(lanes.load(y), py), lanes.sub(lanes.load(z), pz)];
            let distance = lanes.add(lanes.load(halves), half);
            let limit = lanes.mul(lanes.mul(distance, distance), factor);
            if lanes.bits(lanes.less(sum_of_squares(lanes, vector), limit)) != 0 {
                return true;
            }
            page = self.cells.following(page);
            if page == 0 {
                return false;
            }
        }
    }

    /// True if a ball covers a lattice point of this radius, relative to the region: exact.
    #[cold]
    pub fn is_covered(&self, point: Centre, radius: f64) -> bool {
        self.balls.iter().any(|ball| ball.covers(point, radius))
    }

    /// Half a lower bound of the radius in a voxel of a level with this number, from one that holds there.
    #[inline(always)]
    pub fn narrowed(&self, field: &RadiusField, level: &Level, voxel: Voxel, lower: f32) -> f32 {
        let across = |axis: usize| f64::from(level.cell_halves[axis] / level.part_halves[axis]);
        let is_flat = field.slope * across(0).max(across(1)).max(across(2)) < 4.0 * FLAT;
        if is_flat || level.counts == [1; 3] {
            return lower;
        }
        let (VoxelBox { centre, .. }, place) = (VoxelBox::new(level, voxel), self.cells.place(voxel.cell as usize));
        let sides = self.cells.sides();
        let along = |axis: usize| {
            f64::from(self.origin[axis])
                + (f64::from(place[axis]) + 0.5) * sides[axis]
                + f64::from(centre[axis]) * self.unit
        };
        let [x, y, z] = level.halves.map(f64::from);
        let half = (1.0 + ROUNDING) * self.unit * (x * x + y * y + z * z).sqrt();
        let [least, _] = field.around(std::array::from_fn(along), half, self.bounds(voxel.cell));
        lower.max((0.5 * least / self.unit) as f32)
    }

    /// The parts of a voxel that no single ball certainly covers, a bit for each (see [`Level::part`]).
    #[inline(always)]
    pub fn open_parts<L: Lanes>(&self, lanes: L, level: &Level, voxel: Voxel, lower: f32) -> u64 {
        let VoxelBox { centre, cell } = VoxelBox::new(level, voxel);
        let [cx, cy, cz] = splat(lanes, centre);
        let [half_x, half_y, half_z] = splat(lanes, level.halves);
        let [inner_x, inner_y, inner_z] = splat(lanes, level.inner_halves);
        let [part_x, part_y, part_z] = splat(lanes, level.part_halves);
        let [column_x, column_y] =
            [lanes.add(cx, lanes.load(&level.columns[0])), lanes.add(cy, lanes.load(&level.columns[1]))];
        let (lower, certain) = (lanes.splat(lower), lanes.splat(CERTAIN));
        let (mut covered, mut page) = (!level.all, cell as usize);
        loop {
            let ([xs, ys, zs], halves) = (self.cells.page(page), &self.halves[page]);
            let x = lanes.abs(lanes.sub(lanes.load(xs), cx));
            let y = lanes.abs(lanes.sub(lanes.load(ys), cy));
            let z = lanes.abs(lanes.sub(lanes.load(zs), cz));
            let distance = lanes.add(lanes.load(halves), lower);
            let limit = lanes.mul(lanes.mul(distance, distance), certain);
            // The farthest corner.
            let far = [lanes.add(x, half_x), lanes.add(y, half_y), lanes.add(z, half_z)];
            if lanes.bits(lanes.less(sum_of_squares(lanes, far), limit)) != 0 {
                return 0;
            }
            // The far corner of the nearest part.
            let near = [
                lanes.max(lanes.sub(x, inner_x), part_x),
                lanes.max(lanes.sub(y, inner_y), part_y),
                lanes.max(lanes.sub(z, inner_z), part_z),
            ];
            let mut covering = lanes.bits(lanes.less(sum_of_squares(lanes, near), limit));
            let mut limits = [0.0; LANES];
            if covering != 0 {
                lanes.store(limit, &mut limits);
            }
            while covering != 0 {
                let lane = covering.trailing_zeros() as usize % LANES;
                covering &= covering - 1;
                let x = lanes.add(lanes.abs(lanes.sub(lanes.splat(xs[lane]), column_x)), part_x);
                let y = lanes.add(lanes.abs(lanes.sub(lanes.splat(ys[lane]), column_y)), part_y);
                let (squares, mut layer) = (lanes.add(lanes.mul(x, x), lanes.mul(y, y)), 0);
                while layer < level.layers.len() {
                    let z = (zs[lane] - (centre[2] + level.layers[layer])).abs() + level.part_halves[2];
                    let parts = lanes.bits(lanes.less(squares, lanes.splat(limits[lane] - z * z)));
                    covered |= u64::from(parts) << (LANES * layer);
                    layer += 1;
                }
            }
            if covered == u64::MAX {
                return 0;
            }
            page = self.cells.following(page);
            if page == 0 {
                return !covered;
            }
        }
    }

    /// The balls that can cover a lattice point of a cell, relative to the region.
    pub fn balls_near(&self, field: &RadiusField, cell: u16) -> Vec<Ball> {
        let (points, [_, most]) = (self.cells.points_of_cell(cell), self.bounds(cell));
        let most = most + field.slack(most);
        self.balls.iter().copied().filter(|ball| ball.touches(&points, most)).collect()
    }

    /// All balls, in the order in which they came.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }
}
