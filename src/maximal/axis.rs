//! The cuts of an axis into cells.

/// How one axis of a plane is cut into cells. Cell `i` holds the lattice points from `border(i)` to before
/// `border(i + 1)`; on a torus `i` may be any integer.
#[derive(Clone, Debug)]
pub(crate) struct CellAxis {
    pub(super) size: i32,
    count: i32,
    side: f64,
}

impl CellAxis {
    /// Cells so small that any two points of one of them conflict at `radius`.
    pub fn new(size: i32, radius: f64) -> Self {
        let widest = radius * std::f64::consts::FRAC_1_SQRT_2 * (1.0 - 1e-9);
        let count = (f64::from(size) / widest).ceil().max(1.0);
        // Rounded upwards, so that the last border is `size` and not one below it.
        let side = f64::from(size) / count * (1.0 + 2.0 * f64::EPSILON);
        Self { size, count: count as i32, side }
    }

    /// The side of a cell, in lattice points; borders are rounded.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// The number of cells in the domain.
    pub fn count(&self) -> i32 {
        self.count
    }

    /// The first lattice point of a cell. Borders repeat exactly with the period of the torus.
    pub fn border(&self, cell: i32) -> i32 {
        let (turn, cell) = (cell.div_euclid(self.count), cell.rem_euclid(self.count));
        turn * self.size + (f64::from(cell) * self.side) as i32
    }

    /// The cell that a lattice point lies in.
    pub fn cell(&self, point: i32) -> i32 {
        let (turn, point) = (point.div_euclid(self.size), point.rem_euclid(self.size));
        let mut cell = (f64::from(point) / self.side) as i32;
        while self.border(cell) > point {
            cell -= 1;
        }
        while self.border(cell + 1) <= point {
            cell += 1;
        }
        turn * self.count + cell
    }

    /// How many cells away a conflict can be, when points conflict up to `reach` apart.
    pub(super) fn cells_within(&self, reach: i32) -> i32 {
        (1..self.count).find(|&cells| self.gap(cells) > f64::from(reach)).map_or(self.count, |cells| cells - 1)
    }

    /// A lower bound of the distance between points of two cells that are `cells` apart.
    fn gap(&self, cells: i32) -> f64 {
        if cells == 0 { 0.0 } else { (f64::from(cells - 1) * self.side * (1.0 - 1e-9)).floor() + 1.0 }
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
            assert_eq!((axis.border(0), axis.border(axis.count)), (0, size));
            for cell in (-3..axis.count.min(3)).chain(axis.count - 3..axis.count + 3) {
                let (first, end) = (axis.border(cell), axis.border(cell + 1));
                assert!(first < end && 2.0 * f64::from(end - 1 - first).powi(2) < radius * radius);
                assert_eq!((axis.cell(first), axis.cell(end - 1)), (cell, cell));
                assert_eq!(axis.border(cell + axis.count), first + size);
            }
        }
    }
}
