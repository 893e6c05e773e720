//! Items sorted by bins or keys: the counting sort behind every grid and adjacency list here, and buckets that parallel
//! tasks collect.

use std::ops::Range;

use crate::error::Result;
use crate::job::Job;

/// Items sorted by bin, by counting in a first pass over them and sorting in a second; the items of a bin keep the
/// order in which they came.
#[derive(Clone, Debug, Default)]
pub struct Binned<T> {
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

    /// The range of a run of bins in [`Binned::items`].
    #[inline]
    pub fn range(&self, bins: Range<usize>) -> Range<usize> {
        self.starts[bins.start] as usize..self.starts[bins.end] as usize
    }

    /// The items of a bin.
    #[inline]
    pub fn bin(&self, bin: usize) -> &[T] {
        &self.items[self.range(bin..bin + 1)]
    }

    /// The items of a bin, to be reordered.
    pub fn bin_mut(&mut self, bin: usize) -> &mut [T] {
        let range = self.range(bin..bin + 1);
        &mut self.items[range]
    }

    /// All items, by bin.
    #[inline]
    pub fn items(&self) -> &[T] {
        &self.items
    }
}

/// Items sorted by key: the items of a bucket are those of a run of parts.
pub struct Buckets<K, T> {
    /// Keys with some of their items, sorted by key; parts of one key are in the order in which they were made.
    parts: Vec<(K, Vec<T>)>,
    /// The end of each key's parts.
    ends: Vec<usize>,
}

impl<K: Copy + Ord + Send, T: Send> Buckets<K, T> {
    /// The items that each task passes to its second argument with their keys.
    pub fn collect<R: Send>(
        job: &Job,
        count: usize,
        task: impl Fn(usize, &mut dyn FnMut(K, T)) -> R + Sync,
    ) -> Result<(Self, Vec<R>)> {
        let results = job.map(count, |index| {
            let mut parts: Vec<(K, Vec<T>)> = Vec::new();
            let mut last = 0;
            let result = task(index, &mut |key, item| {
                if parts.get(last).is_none_or(|part| part.0 != key) {
                    last = parts.iter().position(|part| part.0 == key).unwrap_or(parts.len());
                    if last == parts.len() {
                        parts.push((key, Vec::new()));
                    }
                }
                parts[last].1.push(item);
            });
            (parts, result)
        })?;
        let (parts, results): (Vec<_>, _) = results.into_iter().unzip();
        let mut parts: Vec<_> = parts.into_iter().flatten().collect();
        parts.sort_by_key(|part| part.0);
        let differs = |&end: &usize| end == parts.len() || parts[end - 1].0 != parts[end].0;
        let ends = (1..=parts.len()).filter(differs).collect();
        Ok((Self { parts, ends }, results))
    }

    /// The number of keys that have items.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The key of a bucket.
    pub fn key(&self, bucket: usize) -> K {
        self.parts[self.ends[bucket] - 1].0
    }

    /// The items of a bucket, in the order of the tasks that made them.
    pub fn items(&self, bucket: usize) -> impl Iterator<Item = &T> + Clone {
        let start = if bucket == 0 { 0 } else { self.ends[bucket - 1] };
        self.parts[start..self.ends[bucket]].iter().flat_map(|part| &part.1)
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
