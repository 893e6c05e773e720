//! Hash grid over points in space that move: a point can be taken from its cell and put elsewhere.

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

/// Points in cells as wide as the radius of a search.
pub struct MovingGrid3 {
    low: DVec3,
    per_cell: f64,
    heads: Vec<u32>,
    entries: Vec<Entry>,
}

impl MovingGrid3 {
    /// The cells of all samples. No position may be below `low`. O(n).
    pub fn new(low: DVec3, side: f64, positions: impl ExactSizeIterator<Item = Vec3>) -> Self {
        let buckets = (2 * positions.len()).next_power_of_two().max(64);
        let mut cells = Self {
            low,
            per_cell: 1.0 / side,
            heads: vec![NONE; buckets],
            entries: Vec::with_capacity(positions.len()),
        };
        for (sample, position) in (0..).zip(positions) {
            cells.entries.push(Entry { position, next: NONE, cell: 0 });
            cells.insert(sample, position);
        }
        cells
    }

    /// The indexed position of a sample.
    #[inline]
    pub fn position(&self, sample: u32) -> Vec3 {
        self.entries[sample as usize].position
    }

    /// Moves a sample to a position.
    pub fn put(&mut self, sample: u32, position: Vec3) {
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
        self.insert(sample, position);
    }

    fn insert(&mut self, sample: u32, position: Vec3) {
        let [x, y, z] = self.cell(position);
        let cell = number(x, y, z);
        let bucket = self.bucket(cell);
        self.entries[sample as usize] = Entry { position, next: self.heads[bucket], cell };
        self.heads[bucket] = sample;
    }

    fn cell(&self, position: Vec3) -> [u64; 3] {
        let place = (position.as_dvec3() - self.low) * self.per_cell;
        // One more than the cell, so that the cell before it has a number. Far out, floats are farther apart than
        // cells, and no cell matters but that of the position itself.
        let index = |along: f64| along.min(FARTHEST) as u64 + 1;
        [index(place.x), index(place.y), index(place.z)]
    }

    #[inline]
    fn bucket(&self, cell: u64) -> usize {
        (cell.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.heads.len().ilog2())) as usize
    }

    /// Visits the samples in the cell of a position and in those around it, with their indexed positions.
    #[inline]
    pub fn around(&self, position: Vec3, mut visit: impl FnMut(u32, Vec3)) {
        let [x, y, z] = self.cell(position);
        for z in z - 1..=z + 1 {
            for y in y - 1..=y + 1 {
                for x in x - 1..=x + 1 {
                    let cell = number(x, y, z);
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

fn number(x: u64, y: u64, z: u64) -> u64 {
    (x & 0x1f_ffff) | (y & 0x1f_ffff) << 21 | (z & 0x1f_ffff) << 42
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
                    cells.put(sample, places[sample as usize]);
                }
            }
        }
    }
}
