//! Cells of at most one sample: the exact conflict and coverage tests for all sampling of the plane.

use crate::plane::lattice::Separation;
use crate::plane::rect::Rect;

use crate::plane::list::{Collect, List};
use crate::plane::near::{Gather, Near, SLACK, Uncovered};
use crate::plane::obstacles::{Disk, Obstacles};
use crate::plane::rows::{LANES, NOWHERE, Nearest, Rows};
use crate::simd::{Level, run};

/// The largest distance of a conflict, in cells: cells are narrower than r / sqrt(2) by at most half.
const MAX_MARGIN: i32 = 3;

/// A rectangle of cells with the samples in them, which never conflict.
///
/// Around the cells lies a margin as wide as conflicts reach, so that neighbours are at fixed offsets. It is empty,
/// or on a whole torus holds the images of samples on the other side.
pub(crate) struct CellGrid {
    /// The edges of the cells of each axis, one more than there are cells.
    edges: [Vec<i32>; 2],
    finders: [Finder; 2],
    /// The longest side of a cell of the plane.
    widest_cell: i32,
    margin: [i32; 2],
    /// The number of cells of a row, with its margins.
    stride: usize,
    /// The coordinates of the samples by rows of cells, margins included, and as many cells more as are read beyond the
    /// end of a row.
    samples: [Vec<i32>; 2],
    torus: Option<PeriodicAxes>,
    vectors: Level,
    separation: Separation,
    obstacles: Obstacles,
}

/// The axes along which a grid covers the whole of a torus.
#[derive(Clone, Copy)]
struct PeriodicAxes {
    /// The number of cells of the grid.
    cells: [i32; 2],
    /// The period in lattice points along those axes.
    size: [i32; 2],
    /// 1 along those axes, else 0: the number of images on each side.
    turns: [i32; 2],
}

impl CellGrid {
    /// The empty cells that hold the lattice points of `rect`, for the separation of the lattice.
    pub fn new(axes: &[CellAxis; 2], rect: &Rect, separation: Separation) -> Self {
        let edges: [Vec<i32>; 2] = std::array::from_fn(|axis| {
            let last = axes[axis].cell(rect.max[axis] - 1);
            (axes[axis].cell(rect.min[axis])..=last + 1).map(|cell| axes[axis].edge(cell)).collect()
        });
        // On a torus of few cells the images fill at most one period on each side: the nearest image is nearer.
        let margin = [0, 1].map(|axis| axes[axis].cells_within(separation.reach));
        debug_assert!(margin.into_iter().all(|cells| cells <= MAX_MARGIN));
        let [width, height] = [0, 1].map(|axis| edges[axis].len() - 1 + 2 * margin[axis] as usize);
        Self {
            // That of the plane, whether this grid has such a cell or not: darts must not depend on the window.
            widest_cell: axes[0].side().max(axes[1].side()).ceil() as i32,
            finders: [0, 1].map(|axis: usize| axes[axis].finder(rect.min[axis])),
            samples: [0, 1].map(|_| vec![NOWHERE; width * height + 2 * LANES]),
            stride: width,
            edges,
            margin,
            torus: None,
            vectors: Level::widest(),
            separation,
            obstacles: Obstacles::default(),
        }
    }

    /// The empty cells of a whole torus of the size of `axes`.
    pub fn torus(axes: &[CellAxis; 2], separation: Separation) -> Self {
        let size = [0, 1].map(|axis: usize| axes[axis].size);
        Self::wrapping(axes, &Rect { min: [0; 2], max: size }, [true; 2], separation)
    }

    /// [`CellGrid::new`] for a part of a torus that wraps along some axes, of which `rect` has the first period.
    pub fn wrapping(axes: &[CellAxis; 2], rect: &Rect, wraps: [bool; 2], separation: Separation) -> Self {
        let grid = Self::new(axes, rect, separation);
        let size = [0, 1].map(|axis: usize| if wraps[axis] { axes[axis].size } else { i32::MAX });
        let torus = PeriodicAxes { cells: grid.counts(), size, turns: wraps.map(i32::from) };
        Self { torus: (wraps != [false; 2]).then_some(torus), ..grid }
    }

    /// Excludes samples from disks, before there are any samples. Disks that do not meet the cells have no effect.
    pub fn set_obstacles(&mut self, disks: Vec<Disk>) {
        if !disks.is_empty() {
            self.obstacles = Obstacles::new(&self.edges, |axis, x| self.finders[axis].cell(x) as usize, disks);
        }
    }

    /// True if samples are excluded from some disks.
    pub fn has_obstacles(&self) -> bool {
        !self.obstacles.is_empty()
    }

    /// The columns and rows of the cells that one disk covers.
    pub fn hidden_cells(&self) -> impl Iterator<Item = [usize; 2]> {
        self.obstacles.covered_cells()
    }

    /// True if one disk covers all of a rectangle of lattice points in a cell.
    #[inline(always)]
    pub fn is_hidden(&self, cell: [i32; 2], rect: &Rect) -> bool {
        !self.obstacles.is_empty() && self.obstacles.cover(cell, rect)
    }

    /// True if a lattice point of a cell lies in a disk.
    #[inline(always)]
    pub fn is_blocked(&self, cell: [i32; 2], point: [i32; 2]) -> bool {
        self.is_hidden(cell, &Rect { min: point, max: point.map(|x| x + 1) })
    }

    /// Cells per axis.
    pub fn counts(&self) -> [i32; 2] {
        [0, 1].map(|axis: usize| self.edges[axis].len() as i32 - 1)
    }

    /// The longest side of a cell of the plane, in lattice points.
    pub fn widest_cell(&self) -> i32 {
        self.widest_cell
    }

    /// Squared distances below this are below the threshold, even when they are computed in `f32`.
    pub fn certain(&self) -> f32 {
        self.separation.threshold as f32 * (1.0 - SLACK)
    }

    /// The lattice points of a cell.
    #[inline(always)]
    pub fn rect(&self, [x, y]: [i32; 2]) -> Rect {
        let [columns, rows] = &self.edges;
        let (x, y) = (x as usize, y as usize);
        Rect { min: [columns[x], rows[y]], max: [columns[x + 1], rows[y + 1]] }
    }

    /// The lattice points of a rectangle of cells.
    pub fn points_of(&self, cells: &Rect) -> Rect {
        Rect { min: self.rect(cells.min).min, max: self.rect([cells.max[0] - 1, cells.max[1] - 1]).max }
    }

    /// The start and the end of a part of a column (axis 0) or row (axis 1) of cells that is cut in `parts`.
    #[inline(always)]
    pub fn part(&self, axis: usize, cell: i32, part: i32, parts: i32) -> [i32; 2] {
        let (first, length) = self.span(axis, cell);
        let edge = |part: i32| first + (length * part as u32 / parts as u32) as i32;
        [edge(part), edge(part + 1)]
    }

    /// The part of a column (axis 0) or row (axis 1) of cells that holds a coordinate.
    #[inline(always)]
    pub fn part_of(&self, axis: usize, cell: i32, x: i32, parts: i32) -> i32 {
        let (first, length) = self.span(axis, cell);
        // The last one with length * part / parts < x - first + 1, without rounding.
        (((x - first + 1) * parts - 1) as u32 / length) as i32
    }

    /// The start and the length of a column (axis 0) or row (axis 1) of cells.
    #[inline(always)]
    fn span(&self, axis: usize, cell: i32) -> (i32, u32) {
        let edges = &self.edges[axis][cell as usize..][..2];
        (edges[0], (edges[1] - edges[0]) as u32)
    }

    /// The cell of a lattice point of the grid.
    #[inline(always)]
    pub fn cell(&self, [x, y]: [i32; 2]) -> [i32; 2] {
        [self.finders[0].cell(x), self.finders[1].cell(y)]
    }

    /// The columns (axis 0) or rows (axis 1) of cells that hold the coordinates between two, the first and the one
    /// after the last.
    pub fn cells_between(&self, axis: usize, [from, end]: [i32; 2]) -> [i32; 2] {
        [self.finders[axis].cell(from), self.finders[axis].cell(end - 1) + 1]
    }

    /// Uses other vectors than the widest.
    #[cfg(test)]
    pub fn set_vectors(&mut self, vectors: Level) {
        self.vectors = vectors;
    }

    /// The vectors that the grid uses.
    pub fn vectors(&self) -> Level {
        self.vectors
    }

    /// The cells that hold the lattice points of `rect`, as far as there are such cells.
    pub fn cells_of(&self, rect: &Rect) -> Rect {
        let all = Rect { min: self.rect([0; 2]).min, max: [0, 1].map(|axis: usize| *self.edges[axis].last().unwrap()) };
        let rect = rect.intersection(&all);
        if rect.is_empty() {
            return Rect { min: [0; 2], max: [0; 2] };
        }
        Rect { min: self.cell(rect.min), max: self.cell(rect.max.map(|x| x - 1)).map(|cell| cell + 1) }
    }

    /// The index of a cell in `samples`; cells of the margin have one too.
    #[inline(always)]
    fn index(&self, cell: [i32; 2]) -> usize {
        (cell[1] + self.margin[1]) as usize * self.stride + (cell[0] + self.margin[0]) as usize
    }

    /// The sample in a cell.
    #[inline(always)]
    pub fn sample(&self, cell: [i32; 2]) -> Option<[i32; 2]> {
        let index = self.index(cell);
        (self.samples[0][index] != NOWHERE).then(|| [0, 1].map(|axis: usize| self.samples[axis][index]))
    }

    /// The rows of cells around a cell in which samples can conflict with points of it.
    #[inline(always)]
    fn rows_near(&self, cell: [i32; 2]) -> Rows<'_> {
        let before = self.margin[1] as usize * self.stride + self.margin[0] as usize;
        Rows {
            samples: [&self.samples[0], &self.samples[1]],
            first: self.index(cell) - before,
            stride: self.stride,
            count: 2 * self.margin[1] as usize + 1,
        }
    }

    /// Gathers the samples that cover a part of a cell, for the coarse tests.
    #[inline(always)]
    pub fn gather(&self, cell: [i32; 2], near: &mut Near) {
        near.limit = self.certain();
        let (rows, threshold) = (&self.rows_near(cell), self.separation.threshold as f32);
        run(self.vectors, Gather { near, rows, cell: self.rect(cell), threshold });
    }

    /// Gathers from a list the samples that cover a part of a voxel.
    #[inline(always)]
    pub fn gather_among(&self, list: &List, voxel: Rect, near: &mut Near) {
        near.limit = self.certain();
        let (rows, threshold) = (&list.rows(), self.separation.threshold as f32);
        run(self.vectors, Gather { near, rows, cell: voxel, threshold });
    }

    /// [`Uncovered`].
    #[inline(always)]
    pub fn uncovered(&self, near: &Near, voxel: &Rect, width: i32) -> u16 {
        run(self.vectors, Uncovered { near, voxel, width })
    }

    /// True if a sample conflicts with `point`, which lies in `cell`, or if the point lies in a disk.
    #[inline(always)]
    pub fn conflicts(&self, cell: [i32; 2], point: [i32; 2]) -> bool {
        self.conflicts_among(&self.rows_near(cell), point) || self.is_blocked(cell, point)
    }

    /// True if one of the samples of some rows conflicts with `point`.
    #[inline(always)]
    pub fn conflicts_among(&self, rows: &Rows, point: [i32; 2]) -> bool {
        let nearest = run(self.vectors, Nearest { rows, point });
        if nearest >= self.separation.threshold as f32 * (1.0 + SLACK) {
            return false;
        }
        nearest < self.certain() || self.conflicts_exactly(rows, point)
    }

    /// The exact form of [`CellGrid::conflicts_among`], where rounding could decide.
    #[cold]
    fn conflicts_exactly(&self, rows: &Rows, point: [i32; 2]) -> bool {
        rows.iter().any(|[xs, ys]| {
            (0..LANES).any(|lane| {
                let [dx, dy] = [(xs[lane], 0), (ys[lane], 1)].map(|(x, axis)| i64::from(x) - i64::from(point[axis]));
                dx * dx + dy * dy < self.separation.threshold
            })
        })
    }

    /// The samples that can conflict with points of a cell, and perhaps some more. `near` is working memory for them.
    pub fn samples_near<'a>(&self, cell: [i32; 2], near: &'a mut Vec<[i32; 2]>) -> &'a [[i32; 2]] {
        near.clear();
        for [xs, ys] in self.rows_near(cell).iter() {
            near.extend(xs.iter().zip(ys).filter(|(x, _)| **x != NOWHERE).map(|(&x, &y)| [x, y]));
        }
        near
    }

    /// True if one sample of `near` alone conflicts with every lattice point of `rect`, or if `rect` is empty.
    pub fn covers(&self, near: &[[i32; 2]], rect: &Rect) -> bool {
        // Twice the distance to the farthest corner is twice the distance to the centre plus the extent.
        let centre: [i64; 2] = std::array::from_fn(|axis| i64::from(rect.min[axis]) + i64::from(rect.max[axis]) - 1);
        let extent: [i64; 2] = std::array::from_fn(|axis| i64::from(rect.length(axis)) - 1);
        rect.is_empty()
            || near.iter().any(|sample| {
                let dx = (2 * i64::from(sample[0]) - centre[0]).abs() + extent[0];
                let dy = (2 * i64::from(sample[1]) - centre[1]).abs() + extent[1];
                dx * dx + dy * dy < 4 * self.separation.threshold
            })
    }

    /// Adds a sample without conflict to `cell`.
    #[inline(always)]
    pub fn insert(&mut self, cell: [i32; 2], point: [i32; 2]) {
        debug_assert!(self.rect(cell).contains(point) && self.sample(cell).is_none());
        self.place(cell, point);
        if let Some(torus) = self.torus {
            self.insert_images(cell, point, torus);
        }
    }

    #[inline(always)]
    fn place(&mut self, cell: [i32; 2], point: [i32; 2]) {
        let index = self.index(cell);
        self.samples[0][index] = point[0];
        self.samples[1][index] = point[1];
    }

    /// Adds the images of a sample of a torus that lie in the margin.
    fn insert_images(&mut self, cell: [i32; 2], point: [i32; 2], PeriodicAxes { cells, size, turns }: PeriodicAxes) {
        let inside = (0..2).all(|axis| (self.margin[axis]..cells[axis] - self.margin[axis]).contains(&cell[axis]));
        if inside {
            return;
        }
        for turns in (-turns[1]..=turns[1]).flat_map(|y| (-turns[0]..=turns[0]).map(move |x| [x, y])) {
            let image = [0, 1].map(|axis: usize| cell[axis] + turns[axis] * cells[axis]);
            if (0..2).all(|axis| (-self.margin[axis]..cells[axis] + self.margin[axis]).contains(&image[axis])) {
                self.place(image, [0, 1].map(|axis: usize| point[axis] + turns[axis] * size[axis]));
            }
        }
    }

    /// Lists the samples in `rect`, which reaches no farther beyond the given cells than conflicts do; by rows of
    /// cells, the margin included.
    #[inline(always)]
    pub fn collect(&self, cells: &Rect, rect: &Rect, list: &mut List) {
        let [x, y] = self.margin;
        let (width, height) = ((cells.length(0) + 2 * x) as usize, (cells.length(1) + 2 * y) as usize);
        let first = self.index([cells.min[0] - x, cells.min[1] - y]);
        list.clear(width * height);
        let rows = Rows { samples: [&self.samples[0], &self.samples[1]], first, stride: self.stride, count: height };
        run(self.vectors, Collect { rows: &rows, width, rect, list });
        list.end();
    }

    /// The samples in `rect`, by rows of cells.
    pub fn samples_in(&self, rect: &Rect) -> impl Iterator<Item = [i32; 2]> + use<'_> {
        let (cells, rect) = (self.cells_of(rect), *rect);
        (cells.min[1]..cells.max[1])
            .flat_map(move |y| {
                let [first, end] = [cells.min[0], cells.max[0]].map(|x| self.index([x, y]));
                self.samples[0][first..end].iter().zip(&self.samples[1][first..end])
            })
            .map(|(&x, &y)| [x, y])
            .filter(move |&sample| rect.contains(sample))
    }

    /// The squared distance from a sample to the nearest other one, if that is within `reach` along both axes; else any
    /// larger number.
    #[inline(always)]
    pub fn nearest_square(&self, sample: [i32; 2], reach: i32) -> i64 {
        let around = Rect { min: sample, max: sample.map(|x| x + 1) }.grown(reach);
        let cells = self.cells_of(&around);
        let mut nearest = [i64::MAX; LANES];
        for y in cells.min[1]..cells.max[1] {
            for x in (cells.min[0]..cells.max[0]).step_by(LANES) {
                let start = self.index([x, y]);
                let [xs, ys] = [&self.samples[0][start..start + LANES], &self.samples[1][start..start + LANES]];
                for lane in 0..LANES {
                    let [dx, dy] = [xs[lane] - sample[0], ys[lane] - sample[1]].map(i64::from);
                    let square = dx * dx + dy * dy;
                    nearest[lane] = nearest[lane].min(if square == 0 { i64::MAX } else { square });
                }
            }
        }
        nearest.into_iter().fold(i64::MAX, i64::min)
    }

    /// The invariants: every sample lies in its cell, and conflicts with nothing but itself and its own images.
    #[cfg(test)]
    pub fn sanity_check(&self) {
        let ([columns, rows], mut memory) = (self.counts(), Vec::new());
        let size = self.torus.map_or([i32::MAX; 2], |torus| torus.size);
        for cell in (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y])) {
            let Some(sample) = self.sample(cell) else { continue };
            assert!(self.rect(cell).contains(sample), "{sample:?} is not in its cell {cell:?}");
            for other in self.samples_near(cell, &mut memory) {
                let [dx, dy] = [0, 1].map(|axis: usize| i64::from(other[axis]) - i64::from(sample[axis]));
                let same = dx % i64::from(size[0]) == 0 && dy % i64::from(size[1]) == 0;
                assert!(same || dx * dx + dy * dy >= self.separation.threshold, "{sample:?} conflicts with {other:?}");
            }
        }
    }
}

// # The cuts of an axis
//
// The cuts of an axis into cells.

/// The cuts of one axis of a plane into cells: at the multiples of size / count, rounded down to lattice points. Cell
/// `i` holds the lattice points from `edge(i)` to before `edge(i + 1)`; on a torus `i` may be any integer.
#[derive(Clone, Debug)]
pub(crate) struct CellAxis {
    pub size: i32,
    count: i32,
}

impl CellAxis {
    /// Cells so small that any two points in one of them conflict at `radius`.
    pub fn new(size: i32, radius: f64) -> Self {
        let widest = radius * std::f64::consts::FRAC_1_SQRT_2 * (1.0 - 1e-9);
        Self { size, count: (f64::from(size) / widest).ceil().max(1.0) as i32 }
    }

    /// The side of a cell, in lattice points, before edges are rounded.
    pub fn side(&self) -> f64 {
        f64::from(self.size) / f64::from(self.count)
    }

    /// The number of cells in the domain.
    pub fn count(&self) -> i32 {
        self.count
    }

    /// The first lattice point of a cell. Edges repeat exactly with the period of the torus.
    pub fn edge(&self, cell: i32) -> i32 {
        (i64::from(cell) * i64::from(self.size)).div_euclid(i64::from(self.count)) as i32
    }

    /// The cell that a lattice point lies in.
    pub fn cell(&self, point: i32) -> i32 {
        // The last one with cell · size / count < point + 1, without rounding.
        ((i64::from(point) + 1) * i64::from(self.count) - 1).div_euclid(i64::from(self.size)) as i32
    }

    /// Finds the cells of many points from `first` on.
    pub fn finder(&self, first: i32) -> Finder {
        let turns = i64::from(-first.div_euclid(self.size));
        // Twice each, so that the shift is never negative.
        let [size, count] = [self.size, self.count].map(|x| 2 * i64::from(x));
        let shift = size.ilog2() - 1;
        Finder {
            points: count,
            offset: (1 + turns * i64::from(self.size)) * count - 2,
            reciprocal: ((1u128 << (64 + shift)) / size as u128 + 1) as u64,
            shift,
            first: (self.cell(first) as i64 + turns * i64::from(self.count)) as i32,
        }
    }

    /// The largest distance of a conflict, in cells, when points conflict up to `reach` apart.
    pub fn cells_within(&self, reach: i32) -> i32 {
        (1..self.count).find(|&cells| self.gap(cells) > f64::from(reach)).map_or(self.count, |cells| cells - 1)
    }

    /// A lower bound of the distance between points of two cells that are `cells` apart.
    fn gap(&self, cells: i32) -> f64 {
        if cells == 0 { 0.0 } else { (f64::from(cells - 1) * self.side() * (1.0 - 1e-9)).floor() + 1.0 }
    }
}

/// [`CellAxis::cell`] with the division as a multiplication, counted from the cell of a first point. Points are up to
/// 2^26 on either side of it.
pub struct Finder {
    points: i64,
    offset: i64,
    /// 2^(64 + shift) / divisor, rounded up. As the divisor is below 2^(shift + 2), the quotients of numbers below 2^62
    /// are exact (Granlund and Montgomery 1994).
    reciprocal: u64,
    shift: u32,
    first: i32,
}

impl Finder {
    #[inline(always)]
    pub fn cell(&self, point: i32) -> i32 {
        let dividend = (i64::from(point) * self.points + self.offset) as u128;
        let high = ((dividend * u128::from(self.reciprocal)) >> 64) as u64;
        (high >> self.shift) as i32 - self.first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Samples without conflict, thrown one after the other, and every test of the grid against a loop over them.
    #[test]
    fn the_grid_says_what_a_loop_over_all_samples_says() {
        let mut rng = Rng::at(0, Draw::Probe, &[]);
        for (size, radius) in [([700, 900], 64.3), ([90, 1500], 90.0), ([30, 20], 70.0), ([200, 100], 150.0)] {
            for torus in [false, true] {
                let axes = size.map(|size| CellAxis::new(size, radius));
                let separation = Separation { threshold: (radius * radius).ceil() as i64, reach: radius as i32 };
                let all = Rect { min: [0; 2], max: size };
                let mut grid = match torus {
                    true => CellGrid::torus(&axes, separation),
                    false => CellGrid::new(&axes, &all, separation),
                };
                let distance = |a: [i32; 2], b: [i32; 2]| -> i64 {
                    let along = |axis: usize| {
                        let along = (a[axis] - b[axis]).abs();
                        i64::from(if torus { along.min(size[axis] - along) } else { along })
                    };
                    along(0).pow(2) + along(1).pow(2)
                };
                let mut samples: Vec<[i32; 2]> = Vec::new();
                let mut memory = Vec::new();
                for _ in 0..2000 {
                    let point: [i32; 2] = std::array::from_fn(|axis| rng.below(size[axis] as u64) as i32);
                    let cell = grid.cell(point);
                    let part = Rect { min: point, max: point.map(|x| x + 20) }.intersection(&grid.rect(cell));
                    let near = grid.samples_near(cell, &mut memory);
                    if grid.covers(near, &part) {
                        let corners = [part.min, [part.min[0], part.max[1] - 1], [part.max[0] - 1, part.min[1]]];
                        let corners = corners.into_iter().chain([part.max.map(|x| x - 1)]);
                        assert!(
                            corners.into_iter().all(|p| samples.iter().any(|&s| distance(s, p) < separation.threshold))
                        );
                    }
                    let single = Rect { min: point, max: point.map(|x| x + 1) };
                    let conflict = samples.iter().any(|&sample| distance(sample, point) < separation.threshold);
                    assert_eq!(grid.covers(near, &single), conflict);
                    assert_eq!(grid.conflicts(cell, point), conflict);
                    if !conflict {
                        grid.insert(cell, point);
                        samples.push(point);
                    }
                }
                samples.sort_unstable();
                let mut found: Vec<_> = grid.samples_in(&all).collect();
                found.sort_unstable();
                assert_eq!(found, samples);
            }
        }
    }

    #[test]
    fn one_sample_covers_exactly_what_lies_in_its_disk() {
        let axes = [CellAxis::new(500, 100.0), CellAxis::new(500, 100.0)];
        let mut grid =
            CellGrid::new(&axes, &Rect { min: [0; 2], max: [500; 2] }, Separation { threshold: 10_000, reach: 99 });
        grid.insert(grid.cell([250, 250]), [250, 250]);
        let mut memory = Vec::new();
        let near = grid.samples_near(grid.cell([260, 260]), &mut memory);
        let covers = |min, max| grid.covers(near, &Rect { min, max });
        // 60² + 79² < 100² < 61² + 80² = 101.1²; `max` is exclusive.
        assert!(covers([200, 200], [311, 330]));
        assert!(!covers([200, 200], [312, 331]));
        assert!(!covers([169, 189], [311, 311]));
        assert!(covers([300, 300], [300, 400]), "the empty rectangle");
    }

    const SIZES: [i32; 7] = [1, 2, 63, 64, 1000, 99_991, 1 << 25];
    const RADII: [f64; 5] = [64.0, 64.5, 100.1, 12_345.6, (1 << 26) as f64];

    #[test]
    fn cells_fill_an_axis_and_two_points_of_one_conflict() {
        for (size, radius) in SIZES.into_iter().flat_map(|size| RADII.map(|radius| (size, radius))) {
            let axis = CellAxis::new(size, radius);
            assert_eq!((axis.edge(0), axis.edge(axis.count)), (0, size));
            let finder = axis.finder(axis.edge(-4));
            for cell in (-3..axis.count.min(3)).chain(axis.count - 3..axis.count + 3) {
                let (first, end) = (axis.edge(cell), axis.edge(cell + 1));
                assert!(first < end && 2.0 * f64::from(end - 1 - first).powi(2) < radius * radius);
                assert_eq!((axis.cell(first), axis.cell(end - 1)), (cell, cell));
                assert_eq!((finder.cell(first), finder.cell(end - 1)), (cell + 4, cell + 4));
                assert_eq!(axis.edge(cell + axis.count), first + size);
            }
        }
    }
}
