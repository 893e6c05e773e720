//! Darts: points thrown at voxels, which become samples where nothing conflicts with them.

use crate::plane::rect::Rect;
use crate::rng::Rng;

use crate::plane::cells::CellGrid;
use crate::plane::list::List;

impl CellGrid {
    /// Throws a dart at a voxel of a cell and adds it if it becomes a sample. Every voxel gets the share of darts of one
    /// as wide as `width`; those beyond its own end are void.
    #[inline(always)]
    pub fn throw(&mut self, cell: [i32; 2], voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
        let point = self.aim(cell, voxel, width, rng)?;
        self.insert(cell, point);
        Some(point)
    }

    /// Where a dart of [`CellGrid::throw`] would become a sample, if it would.
    #[inline(always)]
    pub fn aim(&self, cell: [i32; 2], voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
        dart(voxel, width, rng).filter(|&point| !self.conflicts(cell, point))
    }

    /// [`CellGrid::throw`] where all samples that could conflict with it are listed; it is added to the list, too.
    #[inline(always)]
    pub fn throw_among(
        &mut self,
        list: &mut List,
        cell: [i32; 2],
        voxel: &Rect,
        width: i32,
        rng: &mut Rng,
    ) -> Option<[i32; 2]> {
        let point = dart(voxel, width, rng)?;
        if self.conflicts_among(&list.rows(), point) || self.is_blocked(cell, point) {
            return None;
        }
        self.insert(cell, point);
        list.push(point);
        Some(point)
    }
}

/// A point of a square as wide as `width` in the corner of a voxel, if it lies in the voxel.
#[inline(always)]
fn dart(voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
    let [x, y] = rng.pair_below(width as u32);
    let point = [voxel.min[0] + x as i32, voxel.min[1] + y as i32];
    voxel.contains(point).then_some(point)
}
