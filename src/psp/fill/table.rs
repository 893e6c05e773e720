//! A hash table with cells as keys, which a test reads in one place.

/// Entries by their key, with linear probing, at most half full.
pub struct Table<T> {
    slots: Vec<(u64, T)>,
    len: usize,
}

/// The initial number of slots: usually enough for the cells of a cube of `psp/set/cubes.rs`.
const SLOTS: usize = 1 << 10;

/// A key that no cell has.
const FREE: u64 = u64::MAX;

impl<T: Copy + Default> Table<T> {
    pub fn new() -> Self {
        Self { slots: vec![(FREE, T::default()); SLOTS], len: 0 }
    }

    /// The slot at which the search for a key begins.
    #[inline(always)]
    fn start(&self, key: u64) -> usize {
        (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.slots.len().ilog2())) as usize
    }

    /// The slot of a key, or the free one where it would be inserted.
    #[inline(always)]
    fn slot(&self, key: u64) -> usize {
        let (mut slot, last) = (self.start(key), self.slots.len() - 1);
        while self.slots[slot].0 != key && self.slots[slot].0 != FREE {
            slot = (slot + 1) & last;
        }
        slot
    }

    /// The entry of a key; the default entry if it has none.
    #[inline(always)]
    pub fn get(&self, key: u64) -> T {
        self.slots[self.slot(key)].1
    }

    /// The entry of a key, which is inserted if there is none.
    #[inline]
    pub fn entry(&mut self, key: u64) -> &mut T {
        let mut slot = self.slot(key);
        if self.slots[slot].0 == FREE {
            if 2 * self.len >= self.slots.len() {
                self.grow();
                slot = self.slot(key);
            }
            self.slots[slot].0 = key;
            self.len += 1;
        }
        &mut self.slots[slot].1
    }

    fn grow(&mut self) {
        let doubled = vec![(FREE, T::default()); 2 * self.slots.len()];
        for entry in std::mem::replace(&mut self.slots, doubled) {
            if entry.0 != FREE {
                let slot = self.slot(entry.0);
                self.slots[slot] = entry;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};
    use std::collections::HashMap;

    #[test]
    fn holds_what_a_map_holds() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let (mut table, mut map) = (Table::new(), HashMap::new());
        for step in 1..5000 {
            let key = rng.below(3000) << (21 * (step % 3));
            *table.entry(key) = step;
            map.insert(key, step);
            let key = rng.below(3000);
            assert_eq!(table.get(key), map.get(&key).copied().unwrap_or_default());
        }
        assert!(map.iter().all(|(&key, &step)| table.get(key) == step));
    }
}
