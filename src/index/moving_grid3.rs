//! Hash grid over points in space that move: a point can be taken from its cell and put elsewhere.
//!
//! Where points are searched within radii that differ, they are on several *levels*, each with cells twice as wide as
//! those of the level before.

use glam::{DVec3, Vec3};

const NONE: u32 = u32::MAX;

/// The number of the farthest cell along an axis.
const FARTHEST: f64 = (1u64 << 60) as f64;

/// An indexed position, and the next entry in the chain of its bucket.
#[derive(Clone, Copy)]
pub struct Entry {
    pub position: Vec3,
    next: u32,
    /// The cell. Cells far from each other may have the same number.
    cell: u64,
}

/// The number of levels.
pub const LEVELS: u32 = 4;

/// Points in cells as wide as the radius of a search.
pub struct MovingGrid3 {
    low: DVec3,
    /// Cells of level 0 per unit of length.
    per_cell: f64,
    heads: Vec<u32>,
    entries: Vec<Entry>,
    /// The number of points on each level.
    held: [u32; LEVELS as usize],
}

impl MovingGrid3 {
    /// The cells of all samples, on level 0, where they are `side` wide. No position may be below `low`. O(n).
    pub fn new(low: DVec3, side: f64, positions: impl ExactSizeIterator<Item = Vec3>) -> Self {
        let buckets = (2 * positions.len()).next_power_of_two().max(64);
        let mut cells = Self {
            low,
            per_cell: 1.0 / side,
            heads: vec![NONE; buckets],
            entries: Vec::with_capacity(positions.len()),
            held: [0; LEVELS as usize],
        };
        for (sample, position) in (0..).zip(positions) {
            cells.entries.push(Entry { position, next: NONE, cell: 0 });
            cells.insert(sample, position, 0);
        }
        cells
    }

    /// The indexed position of a sample.
    #[inline]
    pub fn position(&self, sample: u32) -> Vec3 {
        self.entries[sample as usize].position
    }

    /// Moves a sample to a position on a level.
    pub fn put(&mut self, sample: u32, position: Vec3, level: u32) {
        let Entry { next, cell, .. } = self.entries[sample as usize];
        let bucket = self.bucket(cell);
        let mut before = self.heads[bucket];
        if before == sample {
            self.heads[bucket] = next;
        } else {
            while self.entries[before as usize].next != sample {
                before = self.entries[before as usize].next;
            }
            self.entries[before as usize].next = next;
        }
        self.held[level_of(cell) as usize] -= 1;
        self.insert(sample, position, level);
    }

    fn insert(&mut self, sample: u32, position: Vec3, level: u32) {
        let cell = number(self.cell(position.as_dvec3(), level), level);
        self.held[level as usize] += 1;
        let bucket = self.bucket(cell);
        self.entries[sample as usize] = Entry { position, next: self.heads[bucket], cell };
        self.heads[bucket] = sample;
    }

    #[inline]
    fn cell(&self, position: DVec3, level: u32) -> [u64; 3] {
        let place = (position - self.low) * (self.per_cell / f64::from(1u32 << level));
        // One more than the cell, so that the cell before it has a number. Far out, floats are farther apart than
        // cells, and no cell matters but that of the position itself.
        let index = |along: f64| along.min(FARTHEST) as u64 + 1;
        [index(place.x), index(place.y), index(place.z)]
    }

    #[inline]
    fn bucket(&self, cell: u64) -> usize {
        (cell.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.heads.len().ilog2())) as usize
    }

    /// Visits the samples of level 0 in the cell of a position and in those around it, with their indexed positions.
    #[inline]
    pub fn around(&self, position: Vec3, visit: impl FnMut(u32, Vec3)) {
        let cell = self.cell(position.as_dvec3(), 0);
        self.visit(cell.map(|index| index - 1), cell.map(|index| index + 1), 0, visit);
    }

    /// Visits the samples of a level in all cells that a ball around a position may meet, with their indexed positions.
    pub fn within(&self, position: Vec3, radius: f64, level: u32, visit: impl FnMut(u32, Vec3)) {
        if self.held[level as usize] > 0 {
            let corner = |radius: f64| self.cell(position.as_dvec3() + radius, level);
            self.visit(corner(-radius), corner(radius), level, visit);
        }
    }

    #[inline]
    fn visit(&self, low: [u64; 3], high: [u64; 3], level: u32, mut visit: impl FnMut(u32, Vec3)) {
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let cell = number([x, y, z], level);
                    let mut sample = self.heads[self.bucket(cell)];
                    while sample != NONE {
                        let entry = &self.entries[sample as usize];
                        if entry.cell == cell {
                            visit(sample, entry.position);
                        }
                        sample = entry.next;
                    }
                }
            }
        }
    }
}

fn number([x, y, z]: [u64; 3], level: u32) -> u64 {
    (x & 0xf_ffff) | (y & 0xf_ffff) << 20 | (z & 0xf_ffff) << 40 | u64::from(level) << 60
}

fn level_of(cell: u64) -> u32 {
    (cell >> 60) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};

    #[test]
    fn positions_much_farther_than_cells_are_wide_are_found() {
        let positions = [Vec3::ZERO, Vec3::splat(1e30), Vec3::new(1e38, 0.0, 1e-20)];
        for side in [1e-30, 1e-320, 1e300] {
            let cells = MovingGrid3::new(DVec3::ZERO, side, positions.into_iter());
            for (sample, position) in (0..).zip(positions) {
                let mut found = Vec::new();
                cells.around(position, |other, _| found.push(other));
                assert!(found.contains(&sample), "{side}");
            }
        }
    }

    #[test]
    fn all_that_is_near_is_found_once_wherever_it_was_put() {
        for side in [0.05, 0.3, 2.0] {
            let mut rng = Rng::at(10, Draw::Probe, &[]);
            let mut place = || Vec3::new(rng.unit() as f32, rng.unit() as f32, rng.unit() as f32) - 1.0;
            let mut places: Vec<Vec3> = (0..300).map(|_| place()).collect();
            let mut cells = MovingGrid3::new(DVec3::splat(-1.0), side, places.iter().copied());
            for round in 0..5 {
                for (sample, &centre) in places.iter().enumerate() {
                    let mut found = Vec::new();
                    cells.around(centre, |other, position| {
                        assert!(position == places[other as usize] && cells.position(other) == position);
                        found.push(other);
                    });
                    found.sort_unstable();
                    assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "around {sample}");
                    let near = |&other: &u32| places[other as usize].distance(centre) < side as f32 * 0.9999;
                    assert!((0..300).filter(near).all(|other| found.binary_search(&other).is_ok()));
                }
                for sample in (round..300).step_by(7) {
                    places[sample as usize] = place();
                    cells.put(sample, places[sample as usize], 0);
                }
            }
        }
    }

    #[test]
    fn all_of_a_level_that_are_within_a_radius_are_found_once() {
        let mut rng = Rng::at(12, Draw::Probe, &[]);
        let mut place = || Vec3::new(rng.unit() as f32, rng.unit() as f32, rng.unit() as f32) - 1.0;
        let places: Vec<Vec3> = (0..600).map(|_| place()).collect();
        let mut cells = MovingGrid3::new(DVec3::splat(-1.0), 0.02, places.iter().copied());
        let level_of = |sample: usize, round: usize| (sample * (round + 3) / 5) as u32 % LEVELS;
        for round in 0..3 {
            for (sample, &position) in places.iter().enumerate() {
                cells.put(sample as u32, position, level_of(sample, round));
            }
            for (level, &centre) in (0..LEVELS).cycle().zip(&places) {
                for radius in [0.0, 0.03, 0.2] {
                    let mut found = Vec::new();
                    cells.within(centre, radius, level, |other, _| found.push(other as usize));
                    found.sort_unstable();
                    assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
                    assert!(found.iter().all(|&other| level_of(other, round) == level));
                    let is_near = |&other: &usize| {
                        level_of(other, round) == level && f64::from(places[other].distance(centre)) <= radius
                    };
                    assert!((0..600).filter(is_near).all(|other| found.binary_search(&other).is_ok()));
                }
            }
        }
    }
}
