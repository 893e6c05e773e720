//! Given balls, of any radii and at any places, in the cells of a grid: no sample may lie in one, and what lies in one is
//! covered.
//!
//! # Exactness
//! A ball of radius R around c covers the places where F(p) = s (|p - c|² - R²) is below 0, for any s above 0. Relative to a
//! cell's centre and in the radii of the set, with s = 1 / (2 max(R, 1)), it is F = s |p|² - n · p + h, and in a cell that
//! the ball meets but does not cover, s, n and h are all below 2, however large the ball. So F is right to 2·10^-6 in `f32`,
//! and tests with the slack of the grid give only answers that are certain. As F is convex and a sum over the axes, its
//! largest value in a voxel is the sum of those at the ends of each axis. What is not certain is decided in `f64` at the
//! lattice point (`plane/obstacles.rs`).

use crate::index::Binned;
use crate::plane::{Disk, Rect};
use crate::simd::{LANES, Lanes};
use crate::volume::search::Centre;
use crate::volume::voxels::{Level, VoxelBox};

/// F in `f32` is wrong by less than this, as are the squares of the grid.
const SLACK: f32 = 1.0 / (1 << 18) as f32;

/// F changes by less than this times the length of a step, in cells that a ball meets.
const STEEPEST: f64 = 2.0;

/// A value of F for lanes without a ball.
const OPEN: f32 = 1e18;

/// The functions F of sixteen balls.
#[repr(align(64))]
struct Page {
    squared: [f32; LANES],
    linear: [[f32; LANES]; 3],
    constant: [f32; LANES],
}

impl Page {
    const EMPTY: Self = Self { squared: [0.0; LANES], linear: [[0.0; LANES]; 3], constant: [OPEN; LANES] };

    /// Writes the function of a ball, by its centre and radius in radii of the set.
    fn set(&mut self, lane: usize, centre: [f64; 3], radius: f64) {
        let scale = 0.5 / radius.max(1.0);
        let distance = centre.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.squared[lane] = scale as f32;
        self.constant[lane] = (scale * (distance - radius) * (distance + radius)) as f32;
        for (linear, x) in self.linear.iter_mut().zip(centre) {
            linear[lane] = (2.0 * scale * x) as f32;
        }
    }
}

/// The equal cells of a region that begins at 0, in lattice units.
pub struct Cells {
    pub counts: [usize; 3],
    pub sides: [f64; 3],
    /// The radius of the set.
    pub radius: f64,
    /// Lattice points that belong to a cell or are tested for it lie within this distance of it along each axis.
    pub margin: f64,
}

impl Cells {
    /// The distances from a ball's centre to the nearest and to the farthest place of a cell along an axis.
    fn distances(&self, axis: usize, cell: usize, centre: f64) -> [f64; 2] {
        let half = 0.5 * self.sides[axis];
        let offset = (centre - (2 * cell + 1) as f64 * half).abs();
        [(offset - half - self.margin).max(0.0), offset + half]
    }

    /// The cells along an axis within a distance of a place.
    fn range(&self, axis: usize, place: f64, distance: f64) -> std::ops::Range<usize> {
        let last = self.counts[axis] as f64 - 1.0;
        let [low, high] = [place - distance, place + distance].map(|plane| (plane / self.sides[axis]).floor());
        if high < 0.0 || low > last { 0..0 } else { low.max(0.0) as usize..high.min(last) as usize + 1 }
    }

    /// Visits the cells of the box around a ball, with the distances along each axis.
    fn for_each_around(&self, ball: &Disk<3>, mut visit: impl FnMut(usize, [[f64; 2]; 3])) {
        let range = |axis: usize| self.range(axis, ball.centre[axis], ball.radius + self.margin);
        let [columns, rows, layers] = [range(0), range(1), range(2)];
        for (z, y) in layers.flat_map(|z| rows.clone().map(move |y| (z, y))) {
            let [along_y, along_z] = [self.distances(1, y, ball.centre[1]), self.distances(2, z, ball.centre[2])];
            for x in columns.clone() {
                let cell = (z * self.counts[1] + y) * self.counts[0] + x;
                visit(cell, [self.distances(0, x, ball.centre[0]), along_y, along_z]);
            }
        }
    }
}

/// The balls that matter to each cell of a grid.
#[derive(Default)]
pub struct Obstacles {
    /// The balls, relative to the grid.
    balls: Vec<Disk<3>>,
    /// For each cell, true if one ball covers it.
    covered: Vec<bool>,
    /// For each other cell the balls that may have points of it.
    met: Binned<u32>,
    /// The first page of each cell, and the one after the last.
    starts: Vec<u32>,
    pages: Vec<Page>,
    /// Darts at which F is below this miss, to whatever lattice point they are rounded.
    deep: f32,
}

impl Obstacles {
    /// The balls of the cells of a grid, relative to it.
    pub fn new(cells: &Cells, mut balls: Vec<Disk<3>>) -> Self {
        let count = cells.counts.iter().product();
        let (mut covered, mut open) = (vec![false; count], count);
        // Large balls first: cells that they cover are not tested again.
        balls.sort_unstable_by(|a, b| b.radius.total_cmp(&a.radius));
        for ball in &balls {
            if open == 0 {
                break;
            }
            cells.for_each_around(ball, |cell, distances| {
                if !covered[cell] && ball.reaches(|axis| distances[axis][1]) {
                    covered[cell] = true;
                    open -= 1;
                }
            });
        }
        // Only then the others, as most cells of a dense set are covered, each by any of many balls that meet it.
        let mut met = Vec::new();
        for (index, ball) in (0..).zip(&balls).take_while(|_| open > 0) {
            cells.for_each_around(ball, |cell, distances| {
                if !covered[cell] && ball.reaches(|axis| distances[axis][0]) {
                    met.push((cell as u32, index));
                }
            });
        }
        let met = Binned::new(count, met.iter().map(|&(cell, ball)| (cell as usize, ball)));
        let (mut starts, mut pages) = (Vec::with_capacity(count + 1), Vec::new());
        for cell in 0..count {
            starts.push(pages.len() as u32);
            let place = [cell % cells.counts[0], cell / cells.counts[0] % cells.counts[1]];
            let place = [place[0], place[1], cell / (cells.counts[0] * cells.counts[1])];
            for balls_of_page in met.bin(cell).chunks(LANES) {
                let mut page = Page::EMPTY;
                for (lane, &ball) in balls_of_page.iter().enumerate() {
                    let Disk { centre, radius } = balls[ball as usize];
                    let middle = |axis: usize| (place[axis] as f64 + 0.5) * cells.sides[axis];
                    let offset = std::array::from_fn(|axis| (centre[axis] - middle(axis)) / cells.radius);
                    page.set(lane, offset, radius / cells.radius);
                }
                pages.push(page);
            }
        }
        starts.push(pages.len() as u32);
        let rounding = STEEPEST * 3f64.sqrt() * cells.margin / cells.radius;
        Self { balls, covered, met, starts, pages, deep: -SLACK - rounding as f32 }
    }

    /// True if there are no balls.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty()
    }

    /// True if one ball covers a cell.
    pub fn cover_cell(&self, cell: usize) -> bool {
        !self.is_empty() && self.covered[cell]
    }

    #[inline(always)]
    fn pages(&self, cell: u16) -> &[Page] {
        &self.pages[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }

    /// True if a ball certainly covers the lattice point that a dart is rounded to.
    #[inline(always)]
    pub fn stop<L: Lanes>(&self, lanes: L, cell: u16, offset: [f32; 3]) -> bool {
        let place = offset.map(|x| lanes.splat(x));
        let deep = lanes.splat(self.deep);
        let pages = self.pages(cell);
        let mut index = 0;
        while index < pages.len() {
            let page = &pages[index];
            let (squared, mut sum, mut axis) = (lanes.load(&page.squared), lanes.load(&page.constant), 0);
            while axis < 3 {
                let slope = lanes.sub(lanes.mul(squared, place[axis]), lanes.load(&page.linear[axis]));
                sum = lanes.add(sum, lanes.mul(place[axis], slope));
                axis += 1;
            }
            if lanes.bits(lanes.less(sum, deep)) != 0 {
                return true;
            }
            index += 1;
        }
        false
    }

    /// True if a ball covers a lattice point next to a cell, relative to the grid: exact.
    pub fn cover(&self, cell: u16, point: Centre) -> bool {
        let point = Rect { min: point, max: point.map(|x| x + 1) };
        self.met.bin(cell as usize).iter().any(|&ball| self.balls[ball as usize].covers(&point))
    }

    /// The balls that may have points of a cell.
    pub fn near(&self, cell: u16) -> Vec<Disk<3>> {
        if self.is_empty() {
            return Vec::new();
        }
        self.met.bin(cell as usize).iter().map(|&ball| self.balls[ball as usize]).collect()
    }

    /// The parts of a voxel that single balls certainly cover, a bit for each (see [`Level::part`]); all if one covers the
    /// voxel.
    #[inline(always)]
    pub fn covered_parts<L: Lanes>(&self, lanes: L, level: &Level, voxel: &VoxelBox) -> u64 {
        let (limit, pages, mut covered, mut index) = (lanes.splat(-SLACK), self.pages(voxel.cell), 0, 0);
        while index < pages.len() {
            let page = &pages[index];
            let squared = lanes.load(&page.squared);
            let (mut middle, mut beyond, mut axis) = (lanes.load(&page.constant), lanes.splat(0.0), 0);
            let mut convex = lanes.splat(0.0);
            while axis < 3 {
                let (x, half) = (lanes.splat(voxel.centre[axis]), lanes.splat(level.halves[axis]));
                let across = lanes.mul(squared, x);
                let slope = lanes.sub(across, lanes.load(&page.linear[axis]));
                middle = lanes.add(middle, lanes.mul(x, slope));
                beyond = lanes.add(beyond, lanes.mul(lanes.abs(lanes.add(across, slope)), half));
                convex = lanes.add(convex, lanes.mul(half, half));
                axis += 1;
            }
            let most = lanes.add(lanes.add(middle, lanes.mul(squared, convex)), beyond);
            if lanes.bits(lanes.less(most, limit)) != 0 {
                return u64::MAX;
            }
            // Elsewhere F is above this bound: such a ball covers no part.
            let mut covering = lanes.bits(lanes.less(lanes.sub(middle, beyond), limit));
            while covering != 0 {
                let lane = covering.trailing_zeros() as usize % LANES;
                covering &= covering - 1;
                let squared = page.squared[lane];
                let (mut columns, mut axis) = (lanes.splat(page.constant[lane] + SLACK), 0);
                while axis < 2 {
                    let x = lanes.add(lanes.splat(voxel.centre[axis]), lanes.load(&level.columns[axis]));
                    let half = level.part_halves[axis];
                    let across = lanes.mul(lanes.splat(squared), x);
                    let slope = lanes.sub(across, lanes.splat(page.linear[axis][lane]));
                    let beyond = lanes.mul(lanes.abs(lanes.add(across, slope)), lanes.splat(half));
                    let along = lanes.add(lanes.mul(x, slope), lanes.splat(squared * half * half));
                    columns = lanes.add(columns, lanes.add(along, beyond));
                    axis += 1;
                }
                let mut layer = 0;
                while layer < level.layers.len() {
                    let (z, half) = (voxel.centre[2] + level.layers[layer], level.part_halves[2]);
                    let (across, linear) = (squared * z, page.linear[2][lane]);
                    let along = z * (across - linear) + squared * half * half + (2.0 * across - linear).abs() * half;
                    let parts = lanes.bits(lanes.less(columns, lanes.splat(-along)));
                    covered |= u64::from(parts) << (LANES * layer);
                    layer += 1;
                }
            }
            index += 1;
        }
        covered
    }
}
