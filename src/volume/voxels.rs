//! Voxels: the parts of cells, level by level.
//!
//! All voxels of a level are equal as real boxes, whatever the number of lattice points in a cell: a lattice point belongs to
//! the voxel between whose planes it lies. So voxels are nested without being cut, and one set of numbers describes all of a
//! level.

use crate::simd::LANES;

/// The parts of a voxel along an axis that is divided.
const PARTS: u16 = 4;

/// The most levels below the cells: so many digits in base [`PARTS`] fit into 16 bits.
const MOST_LEVELS: usize = 8;

/// Voxels are divided while one of their sides is longer than this, in lattice units.
const SHORTEST: f64 = 1.0;

/// A voxel by its cell and its numbers in it, along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Voxel {
    pub cell: u16,
    pub numbers: [u16; 3],
}

impl Voxel {
    /// A whole cell.
    pub fn cell(cell: usize) -> Self {
        Self { cell: cell as u16, numbers: [0; 3] }
    }
}

/// The place of a voxel.
pub struct VoxelBox {
    pub cell: u16,
    /// The vector from the cell's centre to the voxel's, in radii.
    pub centre: [f32; 3],
}

impl VoxelBox {
    /// The place of a voxel of a level.
    #[inline(always)]
    pub fn new(level: &Level, voxel: Voxel) -> Self {
        let (mut centre, mut axis) = ([0.0; 3], 0);
        while axis < 3 {
            centre[axis] = (f32::from(voxel.numbers[axis]) + 0.5) * level.sides[axis] - level.cell_halves[axis];
            axis += 1;
        }
        Self { cell: voxel.cell, centre }
    }
}

/// The voxels of one size. Lengths are in radii.
pub struct Level {
    /// The voxels of a cell along each axis.
    pub counts: [u32; 3],
    /// The sides.
    pub sides: [f32; 3],
    /// Half of the sides.
    pub halves: [f32; 3],
    /// Half of the sides of a cell.
    pub cell_halves: [f32; 3],
    /// The parts of a voxel along each axis: [`PARTS`], or 1 if the axis is too short to be divided yet.
    parts: [u16; 3],
    /// Half of the sides of a part.
    pub part_halves: [f32; 3],
    /// Half of the sides less a part: how far from the voxel's centre the outermost parts begin.
    pub inner_halves: [f32; 3],
    /// The centres of the parts relative to the voxel's: those of a layer of sixteen along x and y, and the four layers
    /// along z. Parts that there are not repeat the last.
    pub columns: [[f32; LANES]; 2],
    pub layers: [f32; PARTS as usize],
    /// The parts that there are, a bit for each: x is the fastest.
    pub all: u64,
    /// True if no side is longer than a lattice unit, or numbers have no digits left.
    pub is_last: bool,
}

impl Level {
    /// The level with `counts` voxels along the axes of a cell with these sides; sides and radius are in lattice units.
    fn new(cell: [f64; 3], counts: [u32; 3], radius: f64, number: usize) -> Self {
        let sides: [f64; 3] = std::array::from_fn(|axis| cell[axis] / f64::from(counts[axis]));
        let longest = sides.into_iter().fold(0.0, f64::max);
        // A side that is much shorter than the longest is divided when the others are as short.
        let parts = sides.map(|side| if 2.0 * side > longest { PARTS } else { 1 });
        let part: [f64; 3] = std::array::from_fn(|axis| sides[axis] / f64::from(parts[axis]) / radius);
        let centre = |axis: usize, number: usize| {
            let number = (number as u16).min(parts[axis] - 1);
            ((f64::from(number) + 0.5 - 0.5 * f64::from(parts[axis])) * part[axis]) as f32
        };
        let exists = |bit: u16| bit % PARTS < parts[0] && bit / PARTS % PARTS < parts[1] && bit / 16 < parts[2];
        Self {
            counts,
            sides: sides.map(|side| (side / radius) as f32),
            halves: sides.map(|side| (0.5 * side / radius) as f32),
            cell_halves: cell.map(|side| (0.5 * side / radius) as f32),
            parts,
            part_halves: part.map(|side| (0.5 * side) as f32),
            inner_halves: std::array::from_fn(|axis| (0.5 * sides[axis] / radius - part[axis]) as f32),
            columns: [std::array::from_fn(|lane| centre(0, lane % 4)), std::array::from_fn(|lane| centre(1, lane / 4))],
            layers: std::array::from_fn(|layer| centre(2, layer)),
            all: (0..64).filter(|&bit| exists(bit)).fold(0, |all, bit| all | 1 << bit),
            is_last: number == MOST_LEVELS || longest <= SHORTEST,
        }
    }

    /// All levels of cells with these sides, from the cells on; sides and radius are in lattice units.
    pub fn all(cell: [f64; 3], radius: f64) -> Vec<Self> {
        let mut levels = vec![Self::new(cell, [1; 3], radius, 0)];
        while let Some(level) = levels.last()
            && !level.is_last
        {
            let counts = std::array::from_fn(|axis| level.counts[axis] * u32::from(level.parts[axis]));
            levels.push(Self::new(cell, counts, radius, levels.len()));
        }
        levels
    }

    /// Adds the parts of a voxel that have a bit to some of the next level.
    #[inline(always)]
    pub fn push_parts(&self, voxel: Voxel, mut bits: u64, parts: &mut Vec<Voxel>) {
        while bits != 0 {
            parts.push(self.part(voxel, bits.trailing_zeros()));
            bits &= bits - 1;
        }
    }

    /// The vector from a voxel's centre to those of its parts with this number along an axis.
    #[inline(always)]
    pub fn offset(&self, axis: usize, number: usize) -> f32 {
        match axis {
            0 => self.columns[0][number],
            1 => self.columns[1][number * PARTS as usize],
            _ => self.layers[number],
        }
    }

    /// The centre of the part that a bit stands for, of a voxel with this centre.
    pub fn part_centre(&self, centre: [f32; 3], bit: u32) -> [f32; 3] {
        let bit = bit as usize;
        let numbers = [bit % 4, bit / 4 % 4, bit / 16];
        std::array::from_fn(|axis| centre[axis] + self.offset(axis, numbers[axis]))
    }

    /// The part of a voxel that a bit stands for: a voxel of the next level.
    #[inline(always)]
    pub fn part(&self, voxel: Voxel, bit: u32) -> Voxel {
        let ([x, y, z], [across, along, up], bit) = (voxel.numbers, self.parts, bit as u16);
        let numbers =
            [x * across + bit % PARTS, y * along + bit / PARTS % PARTS, z * up + bit / (PARTS * PARTS) % PARTS];
        Voxel { numbers, ..voxel }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_equal_sides_are_divided_along_all_axes_to_single_points() {
        let levels = Level::all([150.0, 140.0, 155.0], 160.0);
        assert_eq!(levels.iter().map(|level| level.counts[0]).collect::<Vec<_>>(), [1, 4, 16, 64, 256]);
        assert!(levels.iter().all(|level| level.all == u64::MAX && level.counts == [level.counts[0]; 3]));
        assert!(levels[4].sides[2] * 160.0 <= 1.0 && levels[3].sides[0] * 160.0 > 1.0);
    }

    #[test]
    fn a_short_side_waits_for_the_others() {
        let levels = Level::all([1024.0, 1024.0, 24.0], 1024.0);
        assert_eq!(levels[0].parts, [4, 4, 1]);
        assert_eq!(levels[0].all, 0xffff);
        assert_eq!(levels.iter().map(|level| level.counts[2]).collect::<Vec<_>>(), [1, 1, 1, 1, 4, 16, 64]);
        assert_eq!(Level::all([2.0, 1.0, 1e-3], 1000.0)[0].all, 0xf);
        assert!(Level::all([1.0; 3], 1000.0)[0].is_last);
    }

    #[test]
    fn numbers_of_the_finest_level_fit() {
        let levels = Level::all([6e7; 3], 6.1e7);
        assert_eq!((levels.len(), levels[MOST_LEVELS].counts[0]), (1 + MOST_LEVELS, 1 << 16));
        let last = Voxel { cell: 3, numbers: [16383, 0, 16383] };
        assert_eq!(levels[MOST_LEVELS - 1].part(last, 63), Voxel { cell: 3, numbers: [65535, 3, 65535] });
    }

    #[test]
    fn the_centres_of_parts_are_spread_over_the_voxel() {
        let level = &Level::all([80.0, 80.0, 80.0], 100.0)[0];
        assert_eq!(level.columns[0][..5], [-0.3, -0.1, 0.1, 0.3, -0.3]);
        assert_eq!(level.columns[1][..5], [-0.3, -0.3, -0.3, -0.3, -0.1]);
        assert_eq!((level.layers[3], level.part_halves[0], level.inner_halves[0]), (0.3, 0.1, 0.2));
    }
}
