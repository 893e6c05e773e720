//! Rows of cells around a place, as all coarse tests of the plane read them.

use crate::simd::{HALF, Lanes, Work};

/// The coordinates of a cell without a sample: far beyond every threshold.
pub const NOWHERE: i32 = -(1 << 29);

/// The number of cells of a row that are read together: at least as many as a conflict can span.
pub const LANES: usize = HALF;

/// The rows of cells around a place in which samples can conflict with its points. Samples of a row beyond the reach of
/// conflicts are read too; they keep their coordinates, and cannot conflict. A cell without a sample has coordinates
/// far away.
pub struct Rows<'a> {
    /// The x and the y of the samples of all cells.
    pub samples: [&'a [i32]; 2],
    /// The index at which the first row begins.
    pub first: usize,
    /// The distance from one row to the next.
    pub stride: usize,
    /// The number of rows; at least 1.
    pub count: usize,
}

impl<'a> Rows<'a> {
    /// The x and the y of each row.
    pub fn iter(&self) -> impl Iterator<Item = [&'a [i32; LANES]; 2]> {
        (0..self.count).map(|row| {
            let start = self.first + row * self.stride;
            self.samples.map(|samples| samples[start..start + LANES].try_into().expect("eight cells"))
        })
    }

    /// The row and the next one, each as the x and the y of its cells; after the last one there are cells of no sample.
    #[inline(always)]
    pub fn two<L: Lanes>(&self, lanes: L, row: usize) -> [L::Ints; 2] {
        let start = self.first + row * self.stride;
        let next = start + self.stride;
        let is_last = row + 1 == self.count;
        let mut two = [lanes.splat_int(NOWHERE); 2];
        let mut axis = 0;
        while axis < 2 {
            let samples = self.samples[axis];
            let lower = eight(samples, start);
            let upper = if is_last { &[NOWHERE; LANES] } else { eight(samples, next) };
            two[axis] = lanes.load_halves([lower, upper]);
            axis += 1;
        }
        two
    }
}

#[inline(always)]
fn eight(samples: &[i32], start: usize) -> &[i32; LANES] {
    samples[start..start + LANES].try_into().expect("eight cells")
}

/// The squared distance from a point to the nearest sample of the rows.
pub struct Nearest<'a> {
    pub rows: &'a Rows<'a>,
    pub point: [i32; 2],
}

impl Work for Nearest<'_> {
    type Out = f32;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f32 {
        let (px, py) = (lanes.splat_int(self.point[0]), lanes.splat_int(self.point[1]));
        let (mut nearest, mut row) = (lanes.splat(f32::MAX), 0);
        while row < self.rows.count {
            let [xs, ys] = self.rows.two(lanes, row);
            let (dx, dy) = (lanes.floats(lanes.sub_ints(xs, px)), lanes.floats(lanes.sub_ints(ys, py)));
            nearest = lanes.min(nearest, lanes.add(lanes.mul(dx, dx), lanes.mul(dy, dy)));
            row += 2;
        }
        lanes.least(nearest)
    }
}
