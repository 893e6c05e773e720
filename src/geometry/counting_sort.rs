//! Counting sort: items in the order of their bins, in two passes over them. It is what stands behind every grid and adjacency
//! list here.

use std::ops::Range;

/// Items sorted by bin; those of a bin follow each other in the order in which they came.
#[derive(Clone, Debug, Default)]
pub(crate) struct Binned<T> {
    /// Bin `b` holds the items `starts[b]..starts[b + 1]`.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy + Default> Binned<T> {
    /// Sorts fewer than 2^32 items, each given with its bin, one of `bins`.
    pub fn new(bins: usize, items: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0u32; bins + 1];
        items.clone().for_each(|(bin, _)| starts[bin + 1] += 1);
        for bin in 1..starts.len() {
            starts[bin] += starts[bin - 1];
        }
        let mut next = starts.clone();
        let mut sorted = vec![T::default(); starts[bins] as usize];
        items.for_each(|(bin, item)| {
            sorted[next[bin] as usize] = item;
            next[bin] += 1;
        });
        Self { starts, items: sorted }
    }
}

impl<T> Binned<T> {
    /// The number of bins.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the items of a run of bins stand in [`Binned::items`].
    #[inline]
    pub fn range(&self, bins: Range<usize>) -> Range<usize> {
        self.starts[bins.start] as usize..self.starts[bins.end] as usize
    }

    /// The items of a bin.
    #[inline]
    pub fn bin(&self, bin: usize) -> &[T] {
        &self.items[self.range(bin..bin + 1)]
    }

    /// The items of a bin, to be put in an order of their own.
    pub fn bin_mut(&mut self, bin: usize) -> &mut [T] {
        let range = self.range(bin..bin + 1);
        &mut self.items[range]
    }

    /// All items, by bins.
    #[inline]
    pub fn items(&self) -> &[T] {
        &self.items
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn the_order_is_that_of_a_stable_sort() {
        for (bins, count) in [(1, 0), (1, 5), (7, 100), (100, 7)] {
            let mut rng = Rng::at(bins as u64, Draw::Probe, &[]);
            let mut items: Vec<_> = (0..count).map(|item| (rng.below(bins as u64) as usize, item)).collect();
            let binned = Binned::new(bins, items.iter().copied());
            items.sort_by_key(|&(bin, _)| bin);
            assert_eq!(binned.len(), bins);
            assert_eq!(binned.items(), items.iter().map(|&(_, item)| item).collect::<Vec<_>>());
            for bin in 0..bins {
                let expected: Vec<_> = items.iter().filter(|item| item.0 == bin).map(|&(_, item)| item).collect();
                assert_eq!(binned.bin(bin), expected);
            }
        }
    }
}
