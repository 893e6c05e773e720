//! Fill blocks: the jittered grid in whose blocks the gaps are filled, in four phases (thesis §2.4.3, after Wei 2008).
//!
//! A block is filled with regard to everything within r of it: the samples that elimination left, and those of blocks
//! of earlier phases. Blocks of one phase are farther than r apart, so each depends only on a few others and the plane
//! needs no order beyond that of the phases.
//!
//! Regular edges would leave peaks in the spectrum, so each is moved by up to a quarter of the regular width.

use crate::plane::{CellGrid, Lattice, Rect};
use crate::points::Boundary;
use crate::rng::{Draw, Rng, hash};

/// The largest width of a block, in radii, before jitter. With jitter it touches
/// [`MOST_CELLS`](super::fill::MOST_CELLS) cells at most, since a domain worth tiling has cells of at least 0.67 radii.
const WIDTH: f64 = 4.8;

/// The largest displacement of an edge, as a share of the width.
const JITTER: f64 = 0.25;

/// The phases: the parity of their blocks' column and row, and the number of columns and rows around a window of blocks
/// that must be filled in this phase for the window's own blocks to be right.
///
/// A block depends on the blocks of earlier phases that touch it, at most one column and one row away (the narrowest
/// block is wider than r). Parities change one at a time from phase to phase, so (0, 1) depends on (1, 1) in the next
/// columns, this on (1, 0) in the next rows, this on (0, 0) in the next columns; and (0, 1) on (1, 0) and (1, 1) on
/// (0, 0) at the corners.
pub const PHASES: [([i32; 2], [i32; 2]); 4] = [([0, 0], [2, 1]), ([1, 0], [1, 1]), ([1, 1], [1, 0]), ([0, 1], [0, 0])];

/// A fill block: its lattice points, and the cells that hold them.
pub struct Block {
    pub rect: Rect,
    pub cells: Rect,
}

/// The blocks of a plane. Columns and rows count from 0; on a torus they continue beyond its edges.
#[derive(Clone, Debug)]
pub struct Blocks {
    size: [i32; 2],
    counts: [i32; 2],
    /// The starts of the columns (axis 0) and rows (axis 1) of the domain, and the end of the last.
    edges: [Vec<i32>; 2],
    boundary: Boundary,
    seed: u64,
}

impl Blocks {
    /// True if a lattice can be cut into blocks: a torus must be at least two of them wide and high.
    pub fn fit(lattice: &Lattice) -> bool {
        let fits = |size: i32| f64::from(size) >= 2.0 * WIDTH * lattice.radius;
        lattice.boundary == Boundary::Bounded || lattice.size.into_iter().all(fits)
    }

    /// The blocks of a lattice that they fit.
    pub fn new(lattice: &Lattice, seed: u64) -> Self {
        let counts = lattice.size.map(|size| {
            let widths = f64::from(size) / (WIDTH * lattice.radius);
            // The parities of the phases must go on across the seam of a torus.
            if lattice.boundary == Boundary::Periodic { 2 * (widths / 2.0).ceil() as i32 } else { widths.ceil() as i32 }
        });
        let edges = std::array::from_fn(|axis| {
            let (size, count) = (i64::from(lattice.size[axis]), i64::from(counts[axis]));
            let limit = (size as f64 / count as f64 * JITTER) as i64;
            let jitter = |index: i64| {
                Rng::at(seed, Draw::Block, &[axis as u64, index as u64]).below(2 * limit as u64 + 1) as i64 - limit
            };
            let edge = |index| size * index / count + if index % count == 0 { 0 } else { jitter(index) };
            (0..=count).map(|index| edge(index) as i32).collect()
        });
        Self { size: lattice.size, counts, edges, boundary: lattice.boundary, seed }
    }

    /// Columns and rows of the domain.
    pub fn counts(&self) -> [i32; 2] {
        self.counts
    }

    /// Lattice points per axis; on a torus also the period.
    pub fn size(&self) -> [i32; 2] {
        self.size
    }

    /// The longest sides of blocks.
    pub fn largest(&self) -> [i32; 2] {
        let longest = |axis: usize| self.edges[axis].windows(2).map(|edges| edges[1] - edges[0]).max().unwrap_or(0);
        [longest(0), longest(1)]
    }

    /// The start of a column (axis 0) or row (axis 1).
    fn edge(&self, axis: usize, index: i32) -> i32 {
        let (turn, index) = (index.div_euclid(self.counts[axis]), index.rem_euclid(self.counts[axis]));
        turn * self.size[axis] + self.edges[axis][index as usize]
    }

    /// The lattice points of a rectangle of blocks, given by its first and the end of its columns and rows.
    pub fn rect(&self, blocks: &Rect) -> Rect {
        Rect {
            min: std::array::from_fn(|axis| self.edge(axis, blocks.min[axis])),
            max: std::array::from_fn(|axis| self.edge(axis, blocks.max[axis])),
        }
    }

    /// The blocks that hold the lattice points of `rect`, which lies in the domain.
    pub fn holding(&self, rect: &Rect) -> Rect {
        Rect {
            min: std::array::from_fn(|axis| self.index(axis, rect.min[axis])),
            max: std::array::from_fn(|axis| self.index(axis, rect.max[axis] - 1) + 1),
        }
    }

    /// The blocks that lie in `rect`, a part of the domain; perhaps none.
    pub fn within(&self, rect: &Rect) -> Rect {
        let inside = |axis: usize| {
            let first = self.edges[axis].partition_point(|&edge| edge < rect.min[axis]);
            let end = self.edges[axis].partition_point(|&edge| edge <= rect.max[axis]);
            [first as i32, end as i32 - 1]
        };
        let [[left, right], [bottom, top]] = [inside(0), inside(1)];
        Rect { min: [left, bottom], max: [right, top] }
    }

    /// The column (axis 0) or row (axis 1) that holds a lattice point of the domain, or of its images.
    pub fn index(&self, axis: usize, point: i32) -> i32 {
        let regular = i64::from(point) * i64::from(self.counts[axis]) / i64::from(self.size[axis]);
        let mut index = regular as i32;
        while self.edge(axis, index) > point {
            index -= 1;
        }
        while self.edge(axis, index + 1) <= point {
            index += 1;
        }
        index
    }

    /// The columns (axis 0) or rows (axis 1) of a rectangle of blocks that have the given parity, from left to right,
    /// each with its first lattice point and the one after its last.
    pub fn of_parity(&self, blocks: &Rect, axis: usize, parity: i32) -> impl Iterator<Item = (i32, [i32; 2])> {
        let indices = (blocks.min[axis]..blocks.max[axis]).filter(move |index| index & 1 == parity);
        indices.map(move |index| (index, [self.edge(axis, index), self.edge(axis, index + 1)]))
    }

    /// A rectangle of blocks with more columns and rows around it, as far as there are any.
    pub fn grown(&self, blocks: &Rect, [columns, rows]: [i32; 2]) -> Rect {
        let grown = Rect {
            min: [blocks.min[0] - columns, blocks.min[1] - rows],
            max: [blocks.max[0] + columns, blocks.max[1] + rows],
        };
        match self.boundary {
            Boundary::Periodic => grown,
            Boundary::Bounded => grown.intersection(&Rect { min: [0; 2], max: self.counts }),
        }
    }

    /// The smallest rectangle that holds every block that is filled for a window of blocks.
    pub fn filled(&self, window: &Rect) -> Rect {
        let mut filled = *window;
        for (parity, margin) in PHASES {
            let Rect { min, max } = self.grown(window, margin);
            for axis in 0..2 {
                // The first and the last of this parity.
                filled.min[axis] = filled.min[axis].min(min[axis] + ((min[axis] ^ parity[axis]) & 1));
                filled.max[axis] = filled.max[axis].max(max[axis] - (((max[axis] - 1) ^ parity[axis]) & 1));
            }
        }
        filled
    }

    /// The columns and rows of the blocks that are to be filled in a phase for a window of blocks, row by row.
    pub fn of_phase(&self, window: &Rect, ([column, row], margin): ([i32; 2], [i32; 2])) -> Vec<[i32; 2]> {
        let Rect { min, max } = self.grown(window, margin);
        let of_parity = |axis: usize, parity: i32| (min[axis]..max[axis]).filter(move |index| index & 1 == parity);
        of_parity(1, row).flat_map(|y| of_parity(0, column).map(move |x| [x, y])).collect()
    }

    /// Fills all blocks that a window depends on, and its own, phase after phase: `fill` gets each of them, with its
    /// column and row.
    pub fn in_phases(&self, grid: &mut CellGrid, window: &Rect, mut fill: impl FnMut(&mut CellGrid, &Block, [i32; 2])) {
        for (parity, margin) in PHASES {
            let blocks = self.grown(window, margin);
            // Cells are found once per column and row, not once per block.
            let [columns, rows] = [0, 1].map(|axis: usize| {
                let spans = self.of_parity(&blocks, axis, parity[axis]);
                spans.map(|(index, points)| (index, points, grid.cells_between(axis, points))).collect::<Vec<_>>()
            });
            for (row, y, rows) in rows {
                for &(column, x, columns) in &columns {
                    let rect = |x: [i32; 2], y: [i32; 2]| Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
                    fill(grid, &Block { rect: rect(x, y), cells: rect(columns, rows) }, [column, row]);
                }
            }
        }
    }

    /// The random numbers of a block: the same for all its images.
    pub fn rng(&self, block: [i32; 2]) -> Rng {
        let [column, row] = [0, 1].map(|axis: usize| block[axis].rem_euclid(self.counts[axis]) as u64);
        Rng::at(hash(self.seed, Draw::Block, &[]), Draw::Darts, &[column, row])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kdrt::fill::MOST_CELLS;
    use crate::plane::CellAxis;
    use crate::points::Domain;

    fn blocks(boundary: Boundary, seed: u64) -> (Lattice, Blocks) {
        let domain = Domain { min: [0.0, 1.0], max: [3.0, 2.0], boundary };
        let lattice = Lattice::new(&domain, 0.0123).unwrap();
        let blocks = Blocks::new(&lattice, seed);
        (lattice, blocks)
    }

    #[test]
    fn blocks_are_wider_than_the_radius_and_fill_the_domain() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for seed in 0..50 {
                let (lattice, blocks) = blocks(boundary, seed);
                for axis in 0..2 {
                    let edges: Vec<_> = (0..=blocks.counts[axis]).map(|index| blocks.edge(axis, index)).collect();
                    assert!(edges.windows(2).all(|pair| pair[1] - pair[0] > lattice.separation.reach));
                    assert_eq!((edges[0], edges[edges.len() - 1]), (0, lattice.size[axis]));
                    assert!(boundary == Boundary::Bounded || blocks.counts[axis] % 2 == 0);
                }
            }
        }
    }

    #[test]
    fn what_is_narrower_than_two_blocks_is_one_block_or_none() {
        let fits = |width: f64, boundary| {
            let lattice = Lattice::new(&Domain { min: [0.0; 2], max: [width, 40.0], boundary }, 1.0).unwrap();
            Blocks::fit(&lattice).then(|| Blocks::new(&lattice, 3).counts())
        };
        assert_eq!(fits(0.1, Boundary::Bounded), Some([1, 9]));
        assert_eq!(fits(4.7, Boundary::Bounded), Some([1, 9]));
        assert_eq!((fits(0.1, Boundary::Periodic), fits(9.5, Boundary::Periodic)), (None, None));
        assert_eq!(fits(9.7, Boundary::Periodic), Some([4, 10]));
    }

    #[test]
    fn blocks_of_a_plane_touch_no_more_cells_than_a_bitmap_has() {
        for tenths in (131..400).chain([1000, 3333]) {
            for boundary in [Boundary::Periodic, Boundary::Bounded] {
                let (width, seed) = (f64::from(tenths) / 10.0, tenths as u64);
                let lattice = Lattice::new(&Domain { min: [0.0; 2], max: [width; 2], boundary }, 1.0).unwrap();
                let (blocks, cells) = (Blocks::new(&lattice, seed), CellAxis::new(lattice.size[0], lattice.radius));
                for index in 0..blocks.counts[0] {
                    let (first, end) = (blocks.edge(0, index), blocks.edge(0, index + 1));
                    let touched = cells.cell(end - 1) + 1 - cells.cell(first);
                    assert!(touched <= MOST_CELLS, "{touched} cells of a plane {width} wide");
                }
            }
        }
    }

    #[test]
    fn a_torus_of_blocks_goes_on_beyond_its_borders() {
        let (lattice, blocks) = blocks(Boundary::Periodic, 4);
        for index in -3..10 {
            for axis in 0..2 {
                let image = index + 2 * blocks.counts[axis];
                assert_eq!(blocks.edge(axis, image), blocks.edge(axis, index) + 2 * lattice.size[axis]);
            }
            let image = [index - blocks.counts[0], index + blocks.counts[1]];
            assert_eq!(blocks.rng(image).bits(), blocks.rng([index; 2]).bits());
        }
    }

    #[test]
    fn every_lattice_point_is_held_by_the_block_around_it() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let (lattice, blocks) = blocks(boundary, 9);
            let mut rng = Rng::at(9, Draw::Probe, &[]);
            for _ in 0..1000 {
                let index = [0, 1].map(|axis: usize| rng.below(blocks.counts[axis] as u64) as i32);
                let block = Rect { min: index, max: index.map(|index| index + 1) };
                assert_eq!(blocks.holding(&blocks.rect(&block)), block);
                let corner = blocks.rect(&block).min.map(|x| (x - 1).max(0));
                let point = Rect { min: corner, max: corner.map(|x| x + 1) };
                assert!(blocks.rect(&blocks.holding(&point)).contains(corner));
                assert_eq!(blocks.holding(&lattice.rect()), Rect { min: [0; 2], max: blocks.counts });
            }
        }
    }

    #[test]
    fn no_block_is_filled_outside_of_what_is_filled() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let (_, blocks) = blocks(boundary, 2);
            let all = Rect { min: [0; 2], max: blocks.counts };
            let places = (0..all.max[1]).flat_map(|row| (0..all.max[0]).map(move |column| [column, row]));
            for (min, length) in places.flat_map(|min| (1..5).map(move |length| (min, length))) {
                let window = Rect { min, max: min.map(|index| index + length) }.intersection(&all);
                let mut held = window;
                for (parity, margin) in PHASES {
                    let around = blocks.grown(&window, margin);
                    for (axis, parity) in parity.into_iter().enumerate() {
                        for (index, _) in blocks.of_parity(&around, axis, parity) {
                            held.min[axis] = held.min[axis].min(index);
                            held.max[axis] = held.max[axis].max(index + 1);
                        }
                    }
                }
                assert_eq!(blocks.filled(&window), held, "{window:?}");
            }
        }
    }

    /// Walks all dependencies from one block: the margins of the phases are exactly those needed.
    #[test]
    fn the_margins_of_the_phases_are_exactly_what_a_block_depends_on() {
        let phase = |[x, y]: [i32; 2]| PHASES.iter().position(|&(parity, _)| parity == [x & 1, y & 1]).unwrap();
        let mut reached = [[0; 2]; 4];
        let mut pending: Vec<[i32; 2]> = (0..2).flat_map(|y| (0..2).map(move |x| [x, y])).collect();
        while let Some(block) = pending.pop() {
            let beyond = block.map(|index: i32| (-index).max(index - 1));
            let margin = &mut reached[phase(block)];
            *margin = std::array::from_fn(|axis| margin[axis].max(beyond[axis]));
            let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [block[0] + x, block[1] + y]));
            pending.extend(around.filter(|&other| phase(other) < phase(block)));
        }
        assert_eq!(reached, PHASES.map(|(_, margin)| margin));
    }
}
