//! The values of a grid's cells: in a table, where these may be anywhere, or in rows, where they are those of a box.
//!
//! A cell of a box is found without a search, and neighbours lie side by side. A box of few cells is smaller than the
//! table.

use crate::psp::fill::extent::Extent;
use crate::psp::fill::space::{KEY, Space};
use crate::psp::fill::table::Table;

/// The largest number of cells of a box. A cube of `psp/set/cubes.rs` has 16 along an axis, or 32 where triangles are long.
const MOST: u32 = 1 << 15;

/// A value for each cell.
pub struct Cells<T> {
    /// The first and the last cell along each axis.
    range: [[u32; 3]; 2],
    /// The shifts of a cell's numbers along the second and the third axis in its number.
    shifts: [u32; 2],
    slots: Slots<T>,
}

enum Slots<T> {
    Anywhere(Table<T>),
    Box(Vec<T>),
}

impl<T: Copy + Default> Cells<T> {
    /// The values of all cells.
    pub fn anywhere() -> Self {
        Self { range: [[0; 3], [u32::MAX; 3]], shifts: KEY, slots: Slots::Anywhere(Table::new()) }
    }

    /// The values of the cells in an extent, and of one more on each side, which searches for samples of different
    /// radii reach.
    pub fn around(extent: &Extent, space: &Space) -> Self {
        let [low, high] = extent.corners().map(|corner| space.cell(space.place(corner)));
        let range = [low.map(|number| number - 1), high.map(|number| number + 1)];
        let digits = [0, 1, 2].map(|axis| (range[1][axis] - range[0][axis] + 1).next_power_of_two().ilog2());
        let all: u32 = digits.iter().sum();
        if 1 << all.min(31) > MOST {
            return Self::anywhere();
        }
        let shifts = [digits[0], digits[0] + digits[1]];
        Self { range, shifts, slots: Slots::Box(vec![T::default(); 1 << all]) }
    }

    /// The part of a range of cells that has values here.
    #[inline(always)]
    pub fn clip(&self, [low, high]: [[u32; 3]; 2]) -> [[u32; 3]; 2] {
        let [first, last] = self.range;
        [[0, 1, 2].map(|axis| low[axis].max(first[axis])), [0, 1, 2].map(|axis| high[axis].min(last[axis]))]
    }

    /// The first cell along each axis, at which the numbers begin, and their shifts.
    #[inline(always)]
    pub fn numbering(&self) -> ([u32; 3], [u32; 2]) {
        (self.range[0], self.shifts)
    }

    /// The number of a cell among those with values.
    #[inline(always)]
    pub fn number(&self, [x, y, z]: [u32; 3]) -> u64 {
        let ([first, _], [row, layer]) = (self.range, self.shifts);
        let [x, y, z] = [x.wrapping_sub(first[0]), y.wrapping_sub(first[1]), z.wrapping_sub(first[2])];
        u64::from(x) | u64::from(y) << row | u64::from(z) << layer
    }

    /// The value of the cell with a number.
    #[inline(always)]
    pub fn get(&self, number: u64) -> T {
        match &self.slots {
            Slots::Anywhere(table) => table.get(number),
            Slots::Box(slots) => slots.get(number as usize).copied().unwrap_or_default(),
        }
    }

    /// The value of a cell, to be changed.
    #[inline(always)]
    pub fn entry(&mut self, cell: [u32; 3]) -> &mut T {
        let number = self.number(cell);
        match &mut self.slots {
            Slots::Anywhere(table) => table.entry(number),
            Slots::Box(slots) => &mut slots[number as usize],
        }
    }
}

/// Calls `visit` with all cells from the lowest to the highest.
#[inline(always)]
pub fn each_cell([low, high]: [[u32; 3]; 2], mut visit: impl FnMut([u32; 3])) {
    for z in low[2]..=high[2] {
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                visit([x, y, z]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// Each cell has its own number, and so its own entry; what lies outside is clipped.
    #[test]
    fn a_box_and_a_table_hold_the_same() {
        let corners = vec![[0.0, 0.0, 0.0], [20.0, 3.0, 0.0], [0.0, 3.0, 11.0]];
        let mesh = Mesh::new(corners.clone(), vec![[0, 1, 2]]).unwrap();
        let space = Space::new(&mesh, 1.0);
        let mut extent = Extent::EMPTY;
        corners.iter().for_each(|&corner| extent.add(corner));
        let (mut box_, mut table) = (Cells::<u32>::around(&extent, &space), Cells::<u32>::anywhere());
        assert!(matches!(box_.slots, Slots::Box(_)) && matches!(table.slots, Slots::Anywhere(_)));
        let range = box_.clip([[0; 3], [1 << 20; 3]]);
        assert_eq!(
            [0, 1, 2].map(|axis| range[1][axis] - range[0][axis]),
            [12, 3, 7],
            "11, 2 and 6 cells, and one more on each side"
        );
        let mut count = 0;
        for _ in 0..2 {
            each_cell(range, |cell| {
                count += 1;
                *box_.entry(cell) += count;
                *table.entry(cell) += count;
            });
        }
        assert_eq!(count, 2 * 13 * 4 * 8);
        each_cell(range, |cell| assert_eq!(box_.get(box_.number(cell)), table.get(table.number(cell))));
        extent.add([200.0, 300.0, 100.0]);
        assert!(matches!(Cells::<u32>::around(&extent, &space).slots, Slots::Anywhere(_)), "too many cells");
    }
}
