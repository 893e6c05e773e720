//! Conquer, second half (thesis §2.3.3): the gaps that elimination leaves are filled.
//!
//! Departure: the thesis puts a sample at a circumcentre in each gap, again and again, and so prefers the middle of
//! gaps; here a gap is filled by a flat quadtree, uniformly on the uncovered part and until none is left. Its first
//! level is a bitmap, in which nearly all gaps are found and closed.

use crate::kdrt::{blocks::Block, conquer::SeamCells};
use crate::math::square;
use crate::plane::{CellGrid, List, Quadtree, Rect, darts};
use crate::rng::Rng;
use crate::simd::{Lanes, Work, run};

/// The filling of the blocks of a window, one after the other.
pub struct Filling<'a> {
    footprints: &'a Footprints,
    seams: SeamCells,
    /// The largest distance along an axis at which samples conflict.
    reach: i32,
    quadtree: Quadtree,
    /// Working memory for the samples around a block.
    near: List,
    /// Working memory for its open voxels.
    open: Vec<VoxelIndex>,
}

impl<'a> Filling<'a> {
    pub fn new(footprints: &'a Footprints, seams: SeamCells, reach: i32) -> Self {
        Self { footprints, seams, reach, quadtree: Quadtree::empty(), near: List::default(), open: Vec::new() }
    }

    /// Makes the samples of the grid maximal in `block` and shows each new one to `accepted`, with the grid as it is
    /// then. `rng` makes the random numbers of the block.
    pub fn fill(
        &mut self,
        grid: &mut CellGrid,
        block: &Block,
        rng: impl Fn() -> Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        run(grid.vectors(), Fill { filling: self, grid, block, rng, accepted });
    }

    /// The darts of the first level: at voxels of the bitmap, picked from the open ones.
    #[inline(always)]
    fn throw(
        &mut self,
        grid: &mut CellGrid,
        bitmap: &mut Bitmap,
        width: i32,
        rng: &mut Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        let mut misses = darts(self.open.len());
        while misses > 0 {
            misses -= 1;
            let pick = rng.below(self.open.len() as u64) as usize;
            let (cell, rect) = bitmap.voxel(grid, self.open[pick]);
            if let Some(sample) = grid.throw_among(&mut self.near, cell, &rect, width, rng) {
                bitmap.cover(sample);
                accepted(grid, sample);
                bitmap.keep_open(&mut self.open);
                misses = darts(self.open.len());
            }
        }
    }
}

/// [`Filling::fill`] compiled for each level, so that the small functions over `Lanes` (`plane/near.rs`) are inlined, and
/// its loops over bits and footprints use these instructions.
struct Fill<'a, 'f, R, A> {
    filling: &'a mut Filling<'f>,
    grid: &'a mut CellGrid,
    block: &'a Block,
    rng: R,
    accepted: &'a mut A,
}

impl<R: Fn() -> Rng, A: FnMut(&CellGrid, [i32; 2])> Work for Fill<'_, '_, R, A> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        let Self { filling, grid, block, rng, accepted } = self;
        let Some(marked) = filling.seams.marked_in(&block.cells) else { return };
        let mut rng = rng();
        let mut bitmap = Bitmap::of_seams(filling.footprints, grid, &filling.seams, block);
        let around = grid.points_of(&marked).grown(filling.reach);
        grid.collect(&marked, &around, &mut filling.near);
        bitmap.cover_all(&filling.near);
        bitmap.list(&marked, &mut filling.open);
        if grid.has_obstacles() {
            filling.open.retain(|&place| {
                let (cell, voxel) = bitmap.voxel(grid, place);
                !grid.is_hidden(cell, &voxel)
            });
        }

        let width = Bitmap::widest(grid);
        filling.throw(grid, &mut bitmap, width, &mut rng, accepted);
        if filling.open.is_empty() {
            return;
        }
        filling.quadtree.restart_cut(grid, width);
        for &place in &filling.open {
            let (cell, voxel) = bitmap.voxel(grid, place);
            filling.quadtree.add_sixteenths(grid, &filling.near, cell, voxel);
        }
        filling.quadtree.fill(grid, &mut rng, accepted);
    }
}

// # The bitmap of a block
//
// The uncovered parts of a fill block, as a bitmap of voxels that footprints are cleared from: the first level of the
// quadtree of a fill.
//
// A row of a block is one word, and a sample clears, in a dozen words, the voxels that lie in its disk (see
// Footprints). The bitmap may keep voxels that are covered, but never lacks one that is not.

/// Voxels of a block's bitmap before its first one, so that every footprint begins in the bitmap.
const MARGIN: i32 = 2 * REACH;

/// Voxels along the side of the largest block.
const LONGEST: i32 = u64::BITS as i32 - MARGIN;

/// The most cells along the side of a block.
pub const MOST_CELLS: i32 = LONGEST / PER_CELL;

/// The number of rows of a bitmap: those of the longest block with the margin before it, and a footprint that begins in
/// the last one.
const ROWS: usize = (MARGIN + LONGEST) as usize + FOOTPRINT_ROWS;

/// The voxels that may be uncovered, in a word per row.
#[repr(align(64))]
struct OpenRows([u64; ROWS]);

/// The voxels of a block that may be uncovered.
pub struct Bitmap<'a> {
    footprints: &'a Footprints,
    block: Rect,
    /// The cells that hold the block, and the first of their lattice points.
    cells: Rect,
    origin: [i32; 2],
    rows: OpenRows,
}

/// The column and row of a voxel in the bitmap.
pub type VoxelIndex = [u8; 2];

impl<'a> Bitmap<'a> {
    /// The voxels of the block in cells at seams, as if nothing covered them.
    #[inline(always)]
    pub fn of_seams(footprints: &'a Footprints, grid: &CellGrid, seams: &SeamCells, block: &Block) -> Self {
        let &Block { rect, cells } = block;
        debug_assert!((0..2).all(|axis| cells.length(axis) <= MOST_CELLS));
        let mut bitmap =
            Self { footprints, block: rect, cells, origin: grid.rect(cells.min).min, rows: OpenRows([0; ROWS]) };
        let [columns, rows] = [bitmap.inside(grid, 0), bitmap.inside(grid, 1)];
        let cell_rows = bitmap.rows.0[MARGIN as usize..].chunks_exact_mut(PER_CELL as usize);
        for (y, voxel_rows) in (cells.min[1]..cells.max[1]).zip(cell_rows) {
            let voxels = columns & spread(seams.in_row(y, cells.min[0], cells.max[0])) << MARGIN;
            let inside = rows >> (MARGIN + PER_CELL * (y - cells.min[1]));
            for (part, row) in voxel_rows.iter_mut().enumerate() {
                *row = voxels & (inside >> part & 1).wrapping_neg();
            }
        }
        bitmap
    }

    /// The columns (axis 0) or rows (axis 1) of voxels that have lattice points of the block, one per bit.
    #[inline(always)]
    fn inside(&self, grid: &CellGrid, axis: usize) -> u64 {
        let [first, last] = [self.cells.min[axis], self.cells.max[axis] - 1];
        let first_inside = grid.part_of(axis, first, self.block.min[axis], PER_CELL);
        let last_inside = PER_CELL * (last - first) + grid.part_of(axis, last, self.block.max[axis] - 1, PER_CELL);
        u64::MAX >> (63 - (last_inside - first_inside)) << (MARGIN + first_inside)
    }

    /// [`Bitmap::cover`] of many samples.
    #[inline(always)]
    pub fn cover_all(&mut self, samples: &List) {
        for [xs, ys] in samples.eights() {
            // The places of eight at once, also of those that are none at the end.
            let mut places = [[0; 2]; 8];
            for i in 0..8 {
                places[i] = [self.place(xs[i], 0), self.place(ys[i], 1)];
            }
            for [column, row] in places {
                if column < 0 {
                    return;
                }
                self.cover_at([column as u32, row as u32]);
            }
        }
    }

    /// Clears the voxels that a sample covers; it may lie up to the radius outside the block's cells.
    #[inline(always)]
    pub fn cover(&mut self, sample: [i32; 2]) {
        self.cover_at([0, 1].map(|axis: usize| self.place(sample[axis], axis) as u32));
    }

    /// Clears a footprint that begins at a column and row.
    #[inline(always)]
    fn cover_at(&mut self, place: [u32; 2]) {
        let (column, row) = (place[0] / PLACES, (place[1] / PLACES) as usize);
        // In aligned groups of eight rows: the next footprint reads at once what this one has written, and store
        // forwarding is fast only if both access the same bytes.
        let (first, before) = (row & !7, row & 7);
        let footprint = &self.footprints.at(place)[8 - before..][..FOOTPRINT_ROWS];
        let rows = &mut self.rows.0[first..][..FOOTPRINT_ROWS];
        for i in 0..FOOTPRINT_ROWS {
            rows[i] &= !(u64::from(footprint[i]) << (column & 63));
        }
    }

    /// The start of the footprint of a sample along an axis, in places.
    #[inline(always)]
    fn place(&self, x: i32, axis: usize) -> i32 {
        self.footprints.place(axis, x - self.origin[axis]) + (MARGIN - REACH) * PLACES as i32
    }

    /// True if a voxel may be uncovered.
    pub fn is_open(&self, [column, row]: VoxelIndex) -> bool {
        self.rows.0[usize::from(row)] >> column & 1 == 1
    }

    /// Drops the voxels of a list that are certainly covered.
    #[inline(always)]
    pub fn keep_open(&self, places: &mut Vec<VoxelIndex>) {
        let mut left = 0;
        for i in 0..places.len() {
            // Written unconditionally, kept only if it is open: a branch would not be predictable.
            places[left] = places[i];
            left += usize::from(self.is_open(places[left]));
        }
        places.truncate(left);
    }

    /// All voxels that may be uncovered; they lie in the given cells.
    #[inline(always)]
    pub fn list(&self, cells: &Rect, places: &mut Vec<VoxelIndex>) {
        // This many of a row are always written, whether they exist or not; rarely are there more.
        const ALWAYS: usize = 2;
        let row = |cell: i32| (MARGIN + PER_CELL * (cell - self.cells.min[1])) as usize;
        let rows = row(cells.min[1])..row(cells.max[1]);
        let count: u32 = self.rows.0[rows.clone()].iter().map(|open| open.count_ones()).sum();
        places.resize(count as usize + ALWAYS, [0; 2]);
        let mut rest = places.as_mut_slice();
        for row in rows {
            let mut open = self.rows.0[row];
            let listed = open.count_ones() as usize;
            let mut lowest = || {
                let column = open.trailing_zeros() as u8;
                open &= open.wrapping_sub(1);
                [column, row as u8]
            };
            rest[..ALWAYS].fill_with(&mut lowest);
            if listed > ALWAYS {
                rest[ALWAYS..listed].fill_with(lowest);
            }
            rest = &mut rest[listed..];
        }
        places.truncate(count as usize);
    }

    /// The cell of a voxel and its lattice points in the block.
    #[inline(always)]
    pub fn voxel(&self, grid: &CellGrid, place: VoxelIndex) -> ([i32; 2], Rect) {
        let place = place.map(|index| i32::from(index) - MARGIN);
        let cell = [0, 1].map(|axis: usize| self.cells.min[axis] + place[axis] / PER_CELL);
        let part = |axis: usize| grid.part(axis, cell[axis], place[axis] % PER_CELL, PER_CELL);
        let (x, y) = (part(0), part(1));
        let voxel = Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
        (cell, voxel.intersection(&self.block))
    }

    /// The longest side of a voxel.
    pub fn widest(grid: &CellGrid) -> i32 {
        (grid.widest_cell() + PER_CELL - 1) / PER_CELL
    }
}

/// The lowest sixteen bits, each repeated four times.
fn spread(bits: u64) -> u64 {
    let bits = (bits | bits << 24) & 0x0000_00ff_0000_00ff;
    let bits = (bits | bits << 12) & 0x000f_000f_000f_000f;
    let bits = (bits | bits << 6) & 0x0303_0303_0303_0303;
    let bits = (bits | bits << 3) & 0x1111_1111_1111_1111;
    bits * 0xf
}

// # Footprints
//
// Footprints: the voxels that the disk of a sample covers, for the filling of gaps (not in the thesis).
//
// A voxel is a quarter of a cell wide. The set of voxels around a sample that lie in its disk depends only on the
// sample's position in its own voxel; to a sixteenth of a voxel it is looked up in a table. The table holds the voxels
// that are certainly covered: it may leave out voxels that are covered, but never has one that is not.

/// Voxels along a cell's side.
pub const PER_CELL: i32 = 4;

/// The number of positions in a voxel that the table distinguishes, per axis.
pub const PLACES: u32 = 16;

/// Voxels on each side of a sample's own that its disk can cover: r is at most 6 voxels (see [`Footprints::new`]).
pub const REACH: i32 = 6;

/// Rows that a footprint is laid on: it begins in one of the first eight, and some are empty.
pub const FOOTPRINT_ROWS: usize = 24;

/// Voxels around a sample, one per bit, by rows: bit 0 of row 8 is [`REACH`] columns and rows before the sample's own.
/// The rows before are empty.
pub type Footprint = [u16; 8 + FOOTPRINT_ROWS];

/// The footprints of a plane.
pub struct Footprints {
    /// Places per lattice point, per axis, in units of 2^-32.
    places: [i64; 2],
    /// Indexed by the row and the column of the place in the voxel.
    table: Box<[Footprint; (PLACES * PLACES) as usize]>,
}

impl Footprints {
    /// The footprints of disks of the given radius on cells with the given sides, in lattice points: a little less than
    /// radius / sqrt(2), and not below radius / (6/4).
    pub fn new(radius: f64, sides: [f64; 2]) -> Self {
        let voxels = sides.map(|side| side / f64::from(PER_CELL));
        let squares = (0..2).map(|axis| Self::squares(radius, voxels[axis])).collect::<Vec<_>>();
        let table = Box::new(std::array::from_fn(|place| {
            let [x, y] = [place % PLACES as usize, place / PLACES as usize];
            std::array::from_fn(|row| {
                let Some(up) = row.checked_sub(8).and_then(|row| squares[1][y].get(row)) else { return 0 };
                let covered = |column: &usize| squares[0][x][*column] + up < 1.0;
                (0..=2 * REACH as usize).filter(covered).map(|column| 1 << column).sum()
            })
        }));
        Self { places: voxels.map(|voxel| (f64::from(PLACES) / voxel * (1u64 << 32) as f64) as i64), table }
    }

    /// For each place along an axis and each voxel: the squared distance to the voxel's farthest point, in units of the
    /// squared radius, with the largest rounding error added.
    fn squares(radius: f64, voxel: f64) -> Vec<Vec<f64>> {
        let places = f64::from(PLACES);
        // Edges are rounded to the lattice; the place is found with a rounded factor.
        let (edge, rounding) = (3.0 / voxel, 0.01 / places);
        let square = |place: u32, column: i32| {
            let (first, last) = (f64::from(place) / places - rounding, f64::from(place + 1) / places + rounding);
            let column = f64::from(column);
            let farthest = (column + 1.0 + edge - first).max(last - column + edge);
            square(farthest * voxel / radius) * (1.0 + 1e-9)
        };
        (0..PLACES).map(|place| (-REACH..=REACH).map(|column| square(place, column)).collect()).collect()
    }

    /// The distance of a sample from the edge of a voxel before it, along an axis, in places.
    #[inline(always)]
    pub fn place(&self, axis: usize, after: i32) -> i32 {
        ((i64::from(after) * self.places[axis]) >> 32) as i32
    }

    /// The footprint of a sample whose place counts from any voxel's edge.
    #[inline(always)]
    pub fn at(&self, [x, y]: [u32; 2]) -> &Footprint {
        &self.table[(y % PLACES * PLACES + x % PLACES) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::{CellAxis, Separation};
    use crate::rng::Draw;

    /// A grid of cells, all of them seams.
    fn everything(size: i32, radius: f64) -> (CellGrid, SeamCells, Footprints) {
        let axes = [size, size - 17].map(|size| CellAxis::new(size, radius));
        let all = Rect { min: [0; 2], max: [size, size - 17] };
        let separation = Separation { threshold: (radius * radius).ceil() as i64, reach: radius as i32 };
        let grid = CellGrid::new(&axes, &all, separation);
        let leaf = crate::kdrt::divide::Leaf { rect: all, key: 0 };
        let seams = SeamCells::new(&grid, &[leaf], &[], size);
        (grid, seams, Footprints::new(radius, [0, 1].map(|axis: usize| axes[axis].side())))
    }

    /// Every voxel of random blocks against the exact distances to one sample, at any position around them.
    #[test]
    fn a_footprint_takes_out_what_is_covered_and_nothing_else() {
        let mut rng = Rng::at(5, Draw::Probe, &[]);
        let mut covered = 0;
        for (radius, size) in [(64.5, 1_100), (1_000.3, 17_000), (70_000.0, 1_400_000), (2_000_000.0, 30_000_000)] {
            let (grid, seams, footprints) = everything(size, radius);
            let threshold = (radius * radius).ceil() as i64;
            for _ in 0..300 {
                let length = (radius * 7.2) as i32;
                let min = [0, 1].map(|_| rng.below((size - 17 - length) as u64) as i32);
                let max = min.map(|x| x + 1 + rng.below(length as u64) as i32);
                let block = Rect { min, max };
                let reach = radius as u64;
                let sample = [0, 1].map(|axis: usize| {
                    let around = rng.below((block.length(axis) as u64) + 2 * reach) as i32;
                    block.min[axis] + around - reach as i32
                });
                let cells = grid.cells_of(&block);
                let mut bitmap = Bitmap::of_seams(&footprints, &grid, &seams, &Block { rect: block, cells });
                let mut places = Vec::new();
                bitmap.list(&cells, &mut places);
                let area: i64 = places.iter().map(|&place| area(&bitmap.voxel(&grid, place).1)).sum();
                assert_eq!(area, self::area(&block), "the voxels are the block");

                bitmap.cover(sample);
                for place in places {
                    let (cell, rect) = bitmap.voxel(&grid, place);
                    assert_eq!(rect.intersection(&grid.rect(cell)), rect);
                    let farthest: i64 = [0, 1]
                        .map(|axis: usize| {
                            let ends = [rect.min[axis], rect.max[axis] - 1];
                            ends.map(|end| i64::from(end - sample[axis]).pow(2)).into_iter().max().unwrap()
                        })
                        .iter()
                        .sum();
                    assert!(bitmap.is_open(place) || farthest < threshold);
                    covered += u32::from(!bitmap.is_open(place));
                    // A voxel that the block's edge cuts is judged as a whole.
                    let is_whole =
                        (0..2).all(|axis| block.min[axis] < rect.min[axis] && rect.max[axis] < block.max[axis]);
                    // Two sixteenths of a voxel, and a few lattice points.
                    let margin = 0.03 * radius + 8.0;
                    assert!(!(bitmap.is_open(place) && is_whole) || (farthest as f64).sqrt() > radius - margin);
                }
            }
        }
        assert!(covered > 10_000);
    }

    fn area(rect: &Rect) -> i64 {
        i64::from(rect.length(0)) * i64::from(rect.length(1))
    }

    #[test]
    fn all_samples_of_a_list_are_covered() {
        let (mut grid, seams, footprints) = everything(17_000, 1_000.3);
        let mut rng = Rng::at(6, Draw::Probe, &[]);
        for _ in 0..3_000 {
            let point = [rng.below(17_000) as i32, rng.below(16_983) as i32];
            if !grid.conflicts(grid.cell(point), point) {
                grid.insert(grid.cell(point), point);
            }
        }
        for _ in 0..50 {
            let rect = Rect { min: [2_000; 2], max: [2_000; 2].map(|x| x + 1 + rng.below(7_200) as i32) };
            let cells = grid.cells_of(&rect);
            let around = grid.points_of(&cells).grown(1_000);
            let (mut list, block) = (List::default(), Block { rect, cells });
            grid.collect(&cells, &around, &mut list);
            let [mut together, mut alone] = [0; 2].map(|_| Bitmap::of_seams(&footprints, &grid, &seams, &block));
            together.cover_all(&list);
            grid.samples_in(&around).for_each(|sample| alone.cover(sample));
            assert_eq!(together.rows.0, alone.rows.0);
            let mut places = Vec::new();
            together.list(&cells, &mut places);
            let open: u32 = together.rows.0.iter().map(|row| row.count_ones()).sum();
            assert_eq!(places.len(), open as usize);
            together.rows.0[20..].fill(0);
            together.keep_open(&mut places);
            assert!(places.iter().all(|&place| place[1] < 20 && together.is_open(place)));
            assert_eq!(places.len(), together.rows.0.iter().map(|row| row.count_ones() as usize).sum::<usize>());
        }
    }

    #[test]
    fn bits_are_spread_four_times_each() {
        assert_eq!(spread(0b1000_0000_0000_0101), 0xf000_0000_0000_0f0f);
    }
}
