//! Stamps: the voxels that the disk of a sample covers, for the filling of gaps (`fill.rs`; not in the thesis).
//!
//! A voxel is a quarter of a cell wide. Which of those around a sample lie in its disk depends only on where in its own
//! voxel the sample lies; to a sixteenth of a voxel that is looked up in a table. The table holds what is covered for
//! certain: it may leave out voxels that are covered, but never has one that is not.

use crate::math::square;

/// Voxels along a cell's side.
pub const PER_CELL: i32 = 4;

/// Positions in a voxel that the table distinguishes, per axis.
pub const PLACES: u32 = 16;

/// Voxels on each side of a sample's own that its disk can cover: r is at most 6 voxels (see [`Stamps::new`]).
pub const REACH: i32 = 6;

/// Rows that a stamp is laid on: it begins in one of the first eight, and some are empty.
pub const ROWS: usize = 24;

/// Voxels around a sample, one per bit, by rows: bit 0 of row 8 is [`REACH`] columns and rows before the sample's own.
/// The rows before are empty.
pub type Stamp = [u16; 8 + ROWS];

/// The stamps of a plane.
pub struct Stamps {
    /// Places per lattice point, per axis, in units of 2^-32.
    places: [i64; 2],
    /// By the row and the column of the place in the voxel.
    table: Box<[Stamp; (PLACES * PLACES) as usize]>,
}

impl Stamps {
    /// The stamps of disks of the given radius on cells with the given sides, in lattice points: a little less than
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
    /// squared radius, with all that rounding can add to it.
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

    /// Where a sample lies after the edge of a voxel, along an axis, in places.
    #[inline(always)]
    pub fn place(&self, axis: usize, after: i32) -> i32 {
        ((i64::from(after) * self.places[axis]) >> 32) as i32
    }

    /// The stamp of a sample whose place counts from any voxel's edge.
    #[inline(always)]
    pub fn at(&self, [x, y]: [u32; 2]) -> &Stamp {
        &self.table[(y % PLACES * PLACES + x % PLACES) as usize]
    }
}
