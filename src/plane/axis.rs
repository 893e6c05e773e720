//! The cuts of an axis into cells.

/// How one axis of a plane is cut into cells: at the multiples of size / count, rounded down to lattice points. Cell `i`
/// holds the lattice points from `edge(i)` to before `edge(i + 1)`; on a torus `i` may be any integer.
#[derive(Clone, Debug)]
pub(crate) struct CellAxis {
    pub(super) size: i32,
    count: i32,
}

impl CellAxis {
    /// Cells so small that any two points of one of them conflict at `radius`.
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

    /// Finds the cells of points from `first` on, for many of them.
    pub(super) fn finder(&self, first: i32) -> Finder {
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

    /// How many cells away a conflict can be, when points conflict up to `reach` apart.
    pub(super) fn cells_within(&self, reach: i32) -> i32 {
        (1..self.count).find(|&cells| self.gap(cells) > f64::from(reach)).map_or(self.count, |cells| cells - 1)
    }

    /// A lower bound of the distance between points of two cells that are `cells` apart.
    fn gap(&self, cells: i32) -> f64 {
        if cells == 0 { 0.0 } else { (f64::from(cells - 1) * self.side() * (1.0 - 1e-9)).floor() + 1.0 }
    }
}

/// [`CellAxis::cell`] with the division as a multiplication, counted from the cell of a first point. Points are up to
/// 2^26 on either side of it.
pub(super) struct Finder {
    points: i64,
    offset: i64,
    /// 2^(64 + shift) / divisor, rounded up. As the divisor is below 2^(shift + 2), the quotients of numbers below 2^62 are
    /// exact (Granlund and Montgomery 1994).
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
