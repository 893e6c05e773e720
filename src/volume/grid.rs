//! A cell list of balls: each cell lists all balls that touch it, so that a dart or a voxel looks at one cell.
//!
//! The cells of a region are equal parts of it, as real boxes. The balls of a cell stand on pages of sixteen, in `f32`
//! relative to the cell's centre and in radii, so that one vector operation tests a page.
//!
//! # Exactness
//! Coordinates on a page are below 2, those of voxels below 1, and each is within 2·10^-7 of the true one. With the rounding
//! of differences, squares and sums, squared distances near 1 are right to 2·10^-6. With a slack of 2^-18 = 3.8·10^-6 the
//! tests in `f32` give only answers that are certain: a squared distance below `1 - SLACK` is a conflict, one above
//! `1 + SLACK` none, and what lies between is decided by the integers. Voxels that a ball covers within the slack only are
//! divided, until the last ones are searched in integers (`search.rs`).

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use crate::plane::{Disk, Rect, Separation};
use crate::simd::{LANES, Lanes};
use crate::volume::obstacles::{Cells, Obstacles};
use crate::volume::search::{Centre, square, touches};
use crate::volume::voxels::{Level, Voxel, VoxelBox};

/// Squared distances in `f32`, in squared radii, are wrong by less than this.
const SLACK: f32 = 1.0 / (1 << 18) as f32;
const CERTAIN: f32 = 1.0 - SLACK;
const POSSIBLE: f32 = 1.0 + SLACK;

/// A coordinate for lanes without a ball. Its square is a float.
const FAR: f32 = 1e18;

/// The longest side of a cell, in radii: a ball then touches [`TOUCHED`] cells along an axis at most. An axis has four
/// cells or fewer, or they are longer than 4/5 of this.
const CELL: f64 = 0.9;

/// The most cells along an axis that a ball touches.
const TOUCHED: usize = 4;

/// A dart is rounded down to a lattice point, which can lie outside its cell by this many units: 1, and more than rounding.
const MARGIN: f64 = 1.25;

/// The margin in radii: more than the rounding of a dart in `f32`.
const MARGIN_IN_RADII: f64 = 1e-6;

/// Up to sixteen balls, by their centres: one axis after the other.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Page([[f32; LANES]; 3]);

impl Page {
    const EMPTY: Self = Self([[FAR; LANES]; 3]);
}

/// Grids that no thread uses now: their memory is used again.
#[derive(Default)]
pub struct Grids<G>(Mutex<Vec<G>>);

impl<G: Default> Grids<G> {
    pub fn take(&self) -> G {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default()
    }

    pub fn give(&self, grid: G) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(grid);
    }
}

/// The cells of a region, a box of lattice points, and the balls of one radius that touch them.
#[derive(Default)]
pub struct Grid {
    /// The first lattice point. All others here are relative to it.
    origin: [i32; 3],
    size: [i32; 3],
    counts: [usize; 3],
    /// The sides of a cell in lattice units, and cells per unit.
    sides: [f64; 3],
    per_unit: [f64; 3],
    /// The radius in lattice units, and radii per unit.
    radius: f64,
    per_radius: f64,
    separation: Separation,
    /// Balls are listed in cells within this distance, in lattice units; and its square, in squared radii.
    reach: f64,
    limit: f32,
    /// Places within this squared distance, in squared radii, have covered lattice points next to them only.
    deep: f32,
    /// The numbers of each cell along the axes.
    places: Vec<[u16; 3]>,
    /// The number of balls of each cell.
    filled: Vec<u32>,
    /// The last page of each cell.
    last: Vec<u32>,
    /// The first page of each cell, and then the others.
    pages: Vec<Page>,
    /// The page of the same cell that follows on each page, or 0.
    next: Vec<u32>,
    balls: Vec<Centre>,
    given: Obstacles,
}

/// Cells that a ball may touch: ranges of their numbers.
pub struct Touched {
    /// Along x.
    pub columns: Range<usize>,
    /// Along y and z.
    pub rows: [Range<usize>; 2],
}

/// A place in a cell where a sample may be put.
#[derive(Clone, Copy)]
pub struct Dart {
    pub cell: u16,
    /// The vector from the cell's centre, in radii.
    pub offset: [f32; 3],
}

impl Grid {
    /// Forgets all balls, and covers another region, for a radius in lattice units, with given balls that may matter to it.
    pub fn reset(&mut self, region: &Rect<3>, radius: f64, separation: Separation, given: &[Disk<3>]) {
        self.origin = region.min;
        self.size = std::array::from_fn(|axis| region.length(axis));
        self.counts = self.size.map(|size| (f64::from(size) / (CELL * radius)).ceil() as usize);
        self.sides = std::array::from_fn(|axis| f64::from(self.size[axis]) / self.counts[axis] as f64);
        self.per_unit = self.sides.map(|side| 1.0 / side);
        (self.radius, self.per_radius, self.separation) = (radius, 1.0 / radius, separation);
        let margin = Self::margin(radius);
        self.reach = radius + margin;
        self.limit = ((self.reach / radius) * (self.reach / radius)) as f32;
        // A lattice point is at most sqrt(3) margins away.
        let deep = (radius - 2.0 * margin) / radius;
        self.deep = (deep * deep) as f32 - SLACK;
        let [columns, rows, layers] = self.counts.map(|count| count as u16);
        self.places.clear();
        for z in 0..layers {
            self.places.extend((0..rows).flat_map(|y| (0..columns).map(move |x| [x, y, z])));
        }
        let cells = self.places.len();
        self.balls.clear();
        self.filled.clear();
        self.filled.resize(cells, 0);
        self.last.clear();
        self.last.extend(0..cells as u32);
        self.pages.clear();
        self.pages.resize(cells, Page::EMPTY);
        self.next.clear();
        self.next.resize(cells, 0);
        self.given = if given.is_empty() { Obstacles::default() } else { self.obstacles(given, margin) };
    }

    /// The distance from its voxel at which a rounded dart can be, in units.
    pub fn margin(radius: f64) -> f64 {
        MARGIN + MARGIN_IN_RADII * radius
    }

    /// The cells along each axis.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The cells that a ball may touch, if there are any: a box around it. Its centre need not lie in the region.
    #[inline(always)]
    pub fn touched(&self, centre: Centre) -> Option<Touched> {
        let [columns, rows, layers] = [0, 1, 2].map(|axis| self.cells_near(axis, centre, self.reach));
        let is_none = columns.is_empty() || rows.is_empty() || layers.is_empty();
        (!is_none).then_some(Touched { columns, rows: [rows, layers] })
    }

    /// The cells of a row, by its numbers along y and z, that a ball may touch.
    pub fn touched_columns(&self, centre: Centre, y: usize, z: usize) -> Range<usize> {
        let along = |axis: usize| f64::from(centre[axis] - self.origin[axis]);
        let beyond = |axis: usize, cell: usize| {
            ((along(axis) - (cell as f64 + 0.5) * self.sides[axis]).abs() - 0.5 * self.sides[axis]).max(0.0)
        };
        let [y, z] = [beyond(1, y), beyond(2, z)];
        // Wider by more than rounding.
        let half = (self.reach * self.reach - y * y - z * z).max(0.0).sqrt() + 1e-6 * self.reach;
        self.cells_near(0, centre, half)
    }

    /// The cells along an axis within a distance of a place.
    #[inline(always)]
    fn cells_near(&self, axis: usize, centre: Centre, distance: f64) -> Range<usize> {
        let along = f64::from(centre[axis] - self.origin[axis]);
        let [low, high] = [along - distance, along + distance].map(|plane| plane * self.per_unit[axis]);
        // Rounded towards 0, both: near a place below the region is no cell, or the first one.
        let (low, high) = (low.max(0.0) as usize, high.min(self.counts[axis] as f64 - 1.0));
        if high < low as f64 { 0..0 } else { low..high as usize + 1 }
    }

    /// The cells along each axis all of whose lattice points lie in a box.
    pub fn cells_within(&self, rect: &Rect<3>) -> [Range<usize>; 3] {
        std::array::from_fn(|axis| {
            let (size, count) = (i64::from(self.size[axis]), self.counts[axis] as i64);
            let edge = |cell: usize| ((cell as i64 * size + count - 1) / count) as i32 + self.origin[axis];
            let first = (0..self.counts[axis]).find(|&cell| edge(cell) >= rect.min[axis]);
            let last = (0..self.counts[axis]).rfind(|&cell| edge(cell + 1) <= rect.max[axis]);
            match (first, last) {
                (Some(first), Some(last)) if first <= last => first..last + 1,
                _ => 0..0,
            }
        })
    }

    /// True if a given ball has a lattice point of the region.
    pub fn given_covers(&self, point: Centre) -> bool {
        let (mut cell, mut local) = (0, [0; 3]);
        for axis in [2, 1, 0] {
            local[axis] = point[axis] - self.origin[axis];
            let along = (f64::from(local[axis]) * self.per_unit[axis]) as usize;
            cell = cell * self.counts[axis] + along.min(self.counts[axis] - 1);
        }
        self.given.cover_cell(cell) || self.given.cover(cell as u16, local)
    }

    /// The numbers of a cell along the axes.
    pub fn place(&self, cell: usize) -> [u16; 3] {
        self.places[cell]
    }

    /// Given balls in the cells.
    #[cold]
    fn obstacles(&self, given: &[Disk<3>], margin: f64) -> Obstacles {
        let Self { counts, sides, radius, origin, .. } = *self;
        let centre = |ball: &Disk<3>| std::array::from_fn(|axis| ball.centre[axis] - f64::from(origin[axis]));
        let balls = given.iter().map(|ball| Disk { centre: centre(ball), ..*ball }).collect();
        Obstacles::new(&Cells { counts, sides, radius, margin }, balls)
    }

    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.places.len()
    }

    /// The cells that no given ball covers as a whole.
    pub fn open_cells(&self) -> Vec<Voxel> {
        (0..self.cells()).filter(|&cell| !self.given.cover_cell(cell)).map(Voxel::cell).collect()
    }

    /// The sizes of voxels.
    pub fn levels(&self) -> Vec<Level> {
        Level::all(self.sides, self.radius)
    }

    /// Lists a ball in all cells that it touches. Its centre need not lie in the region.
    #[inline(always)]
    pub fn add<L: Lanes>(&mut self, lanes: L, centre: Centre) {
        let (mut first, mut local) = ([0; 3], [0; 3]);
        // Of up to four cells along each axis: the vector from their centre, and the squared distance, both in radii.
        let (mut offsets, mut squares) = ([[0.0; TOUCHED]; 3], [[FAR; TOUCHED]; 3]);
        let mut axis = 0;
        while axis < 3 {
            local[axis] = centre[axis] - self.origin[axis];
            let (along, last) = (f64::from(local[axis]), self.counts[axis] as f64 - 1.0);
            let [low, high] = [along - self.reach, along + self.reach].map(|plane| plane * self.per_unit[axis]);
            let (low, high) = (low.max(0.0) as i32, high.min(last));
            if high < f64::from(low) {
                return;
            }
            first[axis] = low as usize;
            let (mut k, count) = (0, high as usize - low as usize + 1);
            debug_assert!(count <= TOUCHED);
            while k < count.min(TOUCHED) {
                let offset = along - ((first[axis] + k) as f64 + 0.5) * self.sides[axis];
                let beyond = (offset.abs() - 0.5 * self.sides[axis]).max(0.0) * self.per_radius;
                offsets[axis][k] = (offset * self.per_radius) as f32;
                squares[axis][k] = (beyond * beyond) as f32;
                k += 1;
            }
            axis += 1;
        }
        self.balls.push(local);
        let (mut columns, mut lane) = ([0.0; LANES], 0);
        while lane < LANES {
            columns[lane] = squares[0][lane % TOUCHED] + squares[1][lane / TOUCHED];
            lane += 1;
        }
        let (columns, mut touched, mut layer) = (lanes.load(&columns), 0, 0);
        while layer < TOUCHED {
            let mask = lanes.bits(lanes.less(columns, lanes.splat(self.limit - squares[2][layer])));
            touched |= u64::from(mask) << (LANES * layer);
            layer += 1;
        }
        let corner = (first[2] * self.counts[1] + first[1]) * self.counts[0] + first[0];
        while touched != 0 {
            let bit = touched.trailing_zeros() as usize;
            touched &= touched - 1;
            let [x, y, z] = [bit % TOUCHED, bit / TOUCHED % TOUCHED, bit / LANES];
            let cell = corner + (z * self.counts[1] + y) * self.counts[0] + x;
            self.list(cell, [offsets[0][x], offsets[1][y], offsets[2][z]]);
        }
    }

    /// Puts a ball on a page of a cell: on which one, and in which lane.
    #[inline(always)]
    pub fn list(&mut self, cell: usize, [x, y, z]: [f32; 3]) -> (usize, usize) {
        let filled = self.filled[cell] as usize;
        self.filled[cell] += 1;
        let page =
            if filled > 0 && filled.is_multiple_of(LANES) { self.new_page(cell) } else { self.last[cell] as usize };
        let (Page([xs, ys, zs]), lane) = (&mut self.pages[page], filled % LANES);
        (xs[lane], ys[lane], zs[lane]) = (x, y, z);
        (page, lane)
    }

    /// The centres of the balls on a page, which for the first page of a cell has its number.
    #[inline(always)]
    pub fn page(&self, page: usize) -> &[[f32; LANES]; 3] {
        &self.pages[page].0
    }

    /// The number of the page of the same cell that follows, or 0.
    #[inline(always)]
    pub fn following(&self, page: usize) -> usize {
        self.next[page] as usize
    }

    /// The number of pages of all cells.
    pub fn pages(&self) -> usize {
        self.pages.len()
    }

    /// The sides of a cell in lattice units.
    pub fn sides(&self) -> [f64; 3] {
        self.sides
    }

    /// A new page, the last one of a cell.
    fn new_page(&mut self, cell: usize) -> usize {
        let page = self.pages.len();
        self.next[self.last[cell] as usize] = page as u32;
        self.last[cell] = page as u32;
        self.pages.push(Page::EMPTY);
        self.next.push(0);
        page
    }

    /// A dart on a place in a voxel, by 63 random bits.
    #[inline(always)]
    pub fn dart(&self, level: &Level, voxel: Voxel, bits: u64) -> Dart {
        let (mut offset, mut axis) = ([0.0; 3], 0);
        while axis < 3 {
            let share = (bits >> (21 * axis) & 0x1f_ffff) as i32 as f32 * (1.0 / (1 << 21) as f32);
            offset[axis] = (f32::from(voxel.numbers[axis]) + share) * level.sides[axis] - level.cell_halves[axis];
            axis += 1;
        }
        Dart { cell: voxel.cell, offset }
    }

    /// The lattice point next to a dart, unless a ball covers it. `GIVEN` is true if there are given balls.
    #[inline(always)]
    pub fn hit<L: Lanes, const GIVEN: bool>(&self, lanes: L, dart: &Dart) -> Option<Centre> {
        // Nearly all darts miss, most of them by more than a lattice unit: these are not rounded.
        if self.is_within(lanes, dart, self.deep) {
            return None;
        }
        if GIVEN && self.given.stop(lanes, dart.cell, dart.offset) {
            return None;
        }
        let (point, rounded) = self.rounded(dart);
        if self.is_within(lanes, &rounded, CERTAIN)
            || self.is_within(lanes, &rounded, POSSIBLE) && self.is_covered(point)
            || GIVEN && self.given.cover(dart.cell, point)
        {
            return None;
        }
        Some(self.absolute(point))
    }

    /// The lattice point next to a dart, relative to the region, and the dart that lies there.
    #[inline(always)]
    pub fn rounded(&self, dart: &Dart) -> (Centre, Dart) {
        let (place, mut point, mut offset, mut axis) = (self.places[dart.cell as usize], [0; 3], [0.0; 3], 0);
        while axis < 3 {
            let centre = (f64::from(place[axis]) + 0.5) * self.sides[axis];
            let along = centre + f64::from(dart.offset[axis]) * self.radius;
            point[axis] = (along as i32).clamp(0, self.size[axis] - 1);
            offset[axis] = ((f64::from(point[axis]) - centre) * self.per_radius) as f32;
            axis += 1;
        }
        (point, Dart { offset, ..*dart })
    }

    /// True if the squared distance of a dart from a ball's centre is below a limit.
    #[inline(always)]
    fn is_within<L: Lanes>(&self, lanes: L, dart: &Dart, limit: f32) -> bool {
        let ([px, py, pz], limit, mut page) = (splat(lanes, dart.offset), lanes.splat(limit), dart.cell as usize);
        loop {
            let Page([x, y, z]) = &self.pages[page];
            let vector = [lanes.sub(lanes.load(x), px), lanes.sub(lanes.load(y), py), lanes.sub(lanes.load(z), pz)];
            if lanes.bits(lanes.less(sum_of_squares(lanes, vector), limit)) != 0 {
                return true;
            }
            page = self.next[page] as usize;
            if page == 0 {
                return false;
            }
        }
    }

    /// True if a ball covers a lattice point: exact.
    #[cold]
    fn is_covered(&self, point: Centre) -> bool {
        self.balls.iter().any(|&ball| square(ball, point) < self.separation.threshold)
    }

    /// The parts of a voxel that no single ball certainly covers, a bit for each (see [`Level::part`]).
    #[inline(always)]
    pub fn open_parts<L: Lanes, const GIVEN: bool>(&self, lanes: L, level: &Level, voxel: Voxel) -> u64 {
        let voxel = VoxelBox::new(level, voxel);
        let VoxelBox { centre, .. } = voxel;
        let [cx, cy, cz] = splat(lanes, centre);
        let [half_x, half_y, half_z] = splat(lanes, level.halves);
        let [inner_x, inner_y, inner_z] = splat(lanes, level.inner_halves);
        let [part_x, part_y, part_z] = splat(lanes, level.part_halves);
        let [column_x, column_y] =
            [lanes.add(cx, lanes.load(&level.columns[0])), lanes.add(cy, lanes.load(&level.columns[1]))];
        let (certain, mut covered, mut page) = (lanes.splat(CERTAIN), !level.all, voxel.cell as usize);
        if GIVEN {
            covered |= self.given.covered_parts(lanes, level, &voxel);
        }
        loop {
            let Page([xs, ys, zs]) = &self.pages[page];
            let x = lanes.abs(lanes.sub(lanes.load(xs), cx));
            let y = lanes.abs(lanes.sub(lanes.load(ys), cy));
            let z = lanes.abs(lanes.sub(lanes.load(zs), cz));
            // The farthest corner.
            let far = [lanes.add(x, half_x), lanes.add(y, half_y), lanes.add(z, half_z)];
            if lanes.bits(lanes.less(sum_of_squares(lanes, far), certain)) != 0 {
                return 0;
            }
            // The far corner of the nearest part.
            let near = [
                lanes.max(lanes.sub(x, inner_x), part_x),
                lanes.max(lanes.sub(y, inner_y), part_y),
                lanes.max(lanes.sub(z, inner_z), part_z),
            ];
            let mut covering = lanes.bits(lanes.less(sum_of_squares(lanes, near), certain));
            while covering != 0 {
                let lane = covering.trailing_zeros() as usize % LANES;
                covering &= covering - 1;
                let x = lanes.add(lanes.abs(lanes.sub(lanes.splat(xs[lane]), column_x)), part_x);
                let y = lanes.add(lanes.abs(lanes.sub(lanes.splat(ys[lane]), column_y)), part_y);
                let (squares, mut layer) = (lanes.add(lanes.mul(x, x), lanes.mul(y, y)), 0);
                while layer < level.layers.len() {
                    let z = (zs[lane] - (centre[2] + level.layers[layer])).abs() + level.part_halves[2];
                    let parts = lanes.bits(lanes.less(squares, lanes.splat(CERTAIN - z * z)));
                    covered |= u64::from(parts) << (LANES * layer);
                    layer += 1;
                }
            }
            if covered == u64::MAX {
                return 0;
            }
            page = self.next[page] as usize;
            if page == 0 {
                return !covered;
            }
        }
    }

    /// The lattice points of a voxel.
    pub fn points(&self, level: &Level, voxel: Voxel) -> Rect<3> {
        let place = self.places[voxel.cell as usize];
        // The first lattice point that is not below the voxel's first plane, or the plane after its last.
        let from = |axis: usize, next: i64| {
            let number = i64::from(place[axis]) * i64::from(level.counts[axis]) + i64::from(voxel.numbers[axis]) + next;
            let voxels = self.counts[axis] as i64 * i64::from(level.counts[axis]);
            ((number * i64::from(self.size[axis]) + voxels - 1) / voxels) as i32
        };
        Rect { min: std::array::from_fn(|axis| from(axis, 0)), max: std::array::from_fn(|axis| from(axis, 1)) }
    }

    /// A box with all lattice points of a cell.
    pub fn points_of_cell(&self, cell: u16) -> Rect<3> {
        let place = self.places[cell as usize];
        let low = |axis: usize| (f64::from(place[axis]) * self.sides[axis]) as i32;
        Rect {
            min: std::array::from_fn(low),
            max: std::array::from_fn(|axis| low(axis) + self.sides[axis].ceil() as i32 + 2),
        }
    }

    /// The balls that can cover a lattice point of a cell.
    pub fn balls_near(&self, cell: u16) -> Vec<Centre> {
        let points = self.points_of_cell(cell);
        self.balls.iter().copied().filter(|&ball| touches(&points, ball, self.separation.threshold)).collect()
    }

    /// The given balls that may have points of a cell, relative to the region.
    pub fn given_near(&self, cell: u16) -> Vec<Disk<3>> {
        self.given.near(cell)
    }

    /// All balls, in the order in which they came.
    pub fn balls(&self) -> &[Centre] {
        &self.balls
    }

    /// A lattice point of the region as one of the domain.
    pub fn absolute(&self, point: Centre) -> Centre {
        std::array::from_fn(|axis| point[axis] + self.origin[axis])
    }
}

#[inline(always)]
pub fn splat<L: Lanes>(lanes: L, [x, y, z]: [f32; 3]) -> [L::Floats; 3] {
    [lanes.splat(x), lanes.splat(y), lanes.splat(z)]
}

#[inline(always)]
pub fn sum_of_squares<L: Lanes>(lanes: L, [x, y, z]: [L::Floats; 3]) -> L::Floats {
    lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};
    use crate::simd::{self, Level as Simd, Work};

    /// A region with random balls in and around it, and what the vector code says of darts and voxels.
    struct Looks<'a> {
        grid: &'a mut Grid,
        region: Rect<3>,
        radius: f64,
        seed: u64,
    }

    impl Work for Looks<'_> {
        type Out = (Vec<(Dart, Option<Centre>)>, Vec<(usize, Voxel, u64)>);

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> Self::Out {
            let Self { grid, region, radius, seed } = self;
            grid.reset(&region, radius, Separation::new(radius), &[]);
            let mut rng = Rng::at(seed, Draw::Probe, &[]);
            let volume: f64 = (0..3).map(|axis| f64::from(region.length(axis)) / radius + 2.0).product();
            for _ in 0..(0.55 * volume) as usize {
                let beyond = radius as i32;
                let along = |axis: usize, rng: &mut Rng| {
                    region.min[axis] - beyond + rng.below((region.length(axis) + 2 * beyond) as u64) as i32
                };
                let ball = [along(0, &mut rng), along(1, &mut rng), along(2, &mut rng)];
                grid.add(lanes, ball);
            }
            let (levels, cells) = (grid.levels(), grid.cells() as u64);
            let voxel = |number: usize, rng: &mut Rng| {
                let digits = |axis: usize, rng: &mut Rng| rng.below(levels[number].counts[axis].into()) as u16;
                let numbers = [digits(0, rng), digits(1, rng), digits(2, rng)];
                Voxel { cell: rng.below(cells) as u16, numbers }
            };
            let mut thrown = Vec::new();
            for _ in 0..300 {
                let number = rng.below(levels.len() as u64) as usize;
                let dart = grid.dart(&levels[number], voxel(number, &mut rng), rng.bits());
                thrown.push((dart, grid.hit::<L, false>(lanes, &dart)));
            }
            let mut looked = Vec::new();
            for _ in 0..300 {
                let number = rng.below(levels.len().max(2) as u64 - 1) as usize;
                let voxel = voxel(number, &mut rng);
                looked.push((number, voxel, grid.open_parts::<L, false>(lanes, &levels[number], voxel)));
            }
            (thrown, looked)
        }
    }

    /// Regions of a few cells with radii from the smallest to the largest.
    fn regions() -> impl Iterator<Item = (Rect<3>, f64)> {
        let sizes: [[f64; 3]; 4] = [[3.0, 4.7, 2.2], [0.4, 5.0, 0.01], [0.001, 0.002, 0.003], [8.0, 0.9, 0.9]];
        let radii = [64.0, 99.7, 5_000.3, 180_000.0, 12_345_678.9];
        sizes.into_iter().flat_map(move |size| {
            radii.map(|radius| {
                let min = [-17, 1_000_000, 5];
                let length = |axis: usize| (size[axis] * radius).ceil() as i32;
                (Rect { min, max: std::array::from_fn(|axis| min[axis] + length(axis)) }, radius)
            })
        })
    }

    #[test]
    fn darts_hit_what_no_ball_covers() {
        let (mut grid, mut hits) = (Grid::default(), 0);
        for (seed, (region, radius)) in (0..).zip(regions()) {
            let (thrown, _) = simd::run(Simd::widest(), Looks { grid: &mut grid, region, radius, seed });
            let threshold = Separation::new(radius).threshold;
            for (dart, hit) in thrown {
                let place = grid.places[dart.cell as usize];
                let along = |axis: usize| {
                    let centre = (f64::from(place[axis]) + 0.5) * grid.sides[axis];
                    (centre + f64::from(dart.offset[axis]) * radius) as i32
                };
                let point = std::array::from_fn(|axis| along(axis).clamp(0, region.length(axis) - 1));
                let is_open = grid.balls.iter().all(|&ball| square(ball, point) >= threshold);
                assert_eq!(hit, is_open.then(|| grid.absolute(point)), "{region:?} {radius}");
                assert!(hit.is_none_or(|point| region.contains(point)));
                hits += usize::from(is_open);
            }
        }
        assert!(hits > 300, "{hits}");
    }

    #[test]
    fn parts_that_are_not_open_lie_in_a_ball() {
        let (mut grid, mut closed) = (Grid::default(), 0);
        for (seed, (region, radius)) in (0..).zip(regions()) {
            let (_, looked) = simd::run(Simd::widest(), Looks { grid: &mut grid, region, radius, seed });
            let (levels, threshold) = (grid.levels(), Separation::new(radius).threshold);
            for (number, voxel, open) in looked.into_iter().filter(|_| levels.len() > 1) {
                assert_eq!(open & !levels[number].all, 0);
                for bit in (0..64).filter(|bit| levels[number].all >> bit & 1 == 1 && open >> bit & 1 == 0) {
                    let points = grid.points(&levels[number + 1], levels[number].part(voxel, bit));
                    let corner = |ball: Centre| {
                        std::array::from_fn(|axis| {
                            let (first, last) = (points.min[axis], points.max[axis] - 1);
                            if ball[axis] - first > last - ball[axis] { first } else { last }
                        })
                    };
                    let is_covered = grid.balls.iter().any(|&ball| square(ball, corner(ball)) < threshold);
                    assert!(points.is_empty() || is_covered, "{region:?} {radius}");
                    closed += 1;
                }
            }
        }
        assert!(closed > 10_000, "{closed}");
    }

    #[test]
    fn voxels_share_out_the_lattice_points() {
        let mut grid = Grid::default();
        for (region, radius) in regions().filter(|&(_, radius)| radius < 200.0) {
            grid.reset(&region, radius, Separation::new(radius), &[]);
            let levels = grid.levels();
            for (number, level) in levels.iter().enumerate().take(levels.len() - 1) {
                let mut rng = Rng::at(7, Draw::Probe, &[number as u64]);
                for _ in 0..20 {
                    let numbers = level.counts.map(|count| rng.below(count.into()) as u16);
                    let voxel = Voxel { cell: rng.below(grid.cells() as u64) as u16, numbers };
                    let count = |points: Rect<3>| (0..3).map(|axis| i64::from(points.length(axis))).product::<i64>();
                    let parts = (0..64).filter(|bit| level.all >> bit & 1 == 1);
                    let parts = parts.map(|bit| count(grid.points(&levels[number + 1], level.part(voxel, bit))));
                    assert_eq!(parts.sum::<i64>(), count(grid.points(level, voxel)));
                }
            }
            let cells = (0..grid.cells()).map(|cell| grid.points(&levels[0], Voxel::cell(cell)));
            let points = cells.map(|cell| (0..3).map(|axis| i64::from(cell.length(axis))).product::<i64>());
            assert_eq!(points.sum::<i64>(), (0..3).map(|axis| i64::from(region.length(axis))).product::<i64>());
        }
    }

    /// Where radii vary, thousands of small balls reach a cell of a large radius.
    #[test]
    fn a_cell_lists_any_number_of_balls() {
        const BALLS: usize = 70_000;
        let mut grid = Grid::default();
        grid.reset(&Rect { min: [0; 3], max: [40; 3] }, 64.0, Separation::new(64.0), &[]);
        (0..BALLS).for_each(|number| _ = grid.list(0, [number as f32; 3]));
        let (mut page, mut listed) = (0, Vec::new());
        while listed.len() < BALLS {
            listed.extend(grid.page(page)[2]);
            page = grid.following(page);
        }
        assert!(page == 0 && listed.into_iter().eq((0..BALLS).map(|number| number as f32)));
    }

    #[test]
    fn all_levels_of_vector_instructions_see_the_same() {
        let mut grid = Grid::default();
        for (seed, (region, radius)) in (0..).zip(regions()) {
            let mut look = |level: Simd| {
                let (thrown, looked) = simd::run(level, Looks { grid: &mut grid, region, radius, seed });
                let hits: Vec<_> = thrown.into_iter().map(|(dart, hit)| (dart.offset.map(f32::to_bits), hit)).collect();
                (hits, looked)
            };
            let portable = look(Simd::Portable);
            assert!(Simd::available().into_iter().all(|level| look(level) == portable));
        }
    }
}
