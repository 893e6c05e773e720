//! Items in buckets by a key, collected by tasks that share nothing.

use crate::error::Result;
use crate::job::Job;

/// Items sorted by their key: those of a bucket are the items of a run of parts.
pub(super) struct Buckets<K, T> {
    /// Keys with some of their items, sorted by key; parts of one key in the order in which they were made.
    parts: Vec<(K, Vec<T>)>,
    /// Where the parts of each key end.
    ends: Vec<usize>,
}

impl<K: Copy + Ord + Send, T: Send> Buckets<K, T> {
    /// The items that each task hands to its second argument with their keys.
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
