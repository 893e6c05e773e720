//! Rows of cells around a place, as all coarse tests of the plane read them.

/// The coordinates of a cell without a sample: far beyond every threshold.
pub const NOWHERE: i32 = -(1 << 29);

/// The cells of a row that are read together: at least as many as conflicts can reach over.
pub const LANES: usize = 8;

/// The rows of cells around a place in which samples can conflict with its points. What lies in a row beyond the reach
/// of conflicts is read too; it is what it is, and cannot conflict. The place of a cell without sample is far away.
pub struct Rows<'a> {
    /// The x and the y of the samples of all cells.
    pub samples: [&'a [i32]; 2],
    /// Where the first row begins.
    pub first: usize,
    /// From one row to the next.
    pub stride: usize,
    /// How many rows; there is one at least.
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

    /// The squared distance from a point to the nearest sample of the rows.
    pub fn nearest(&self, point: [i32; 2]) -> f32 {
        let mut nearest = [f32::MAX; LANES];
        for [xs, ys] in self.iter() {
            for lane in 0..LANES {
                let (dx, dy) = ((xs[lane] - point[0]) as f32, (ys[lane] - point[1]) as f32);
                nearest[lane] = nearest[lane].min(dx * dx + dy * dy);
            }
        }
        nearest.into_iter().fold(f32::MAX, f32::min)
    }
}
