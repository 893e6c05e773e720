//! Blocks that windows of a kept plane have made: the next windows there need not make them again.
//!
//! A window of the last layer depends on the layers before in ever larger parts (`stack.rs`), so that neighbouring
//! windows make mostly the same samples. A block of a layer is a function of the plane alone: results do not depend on
//! what is cached.
//!
//! Memory is bounded by two generations: the older one is forgotten when the younger one has half of what may be held,
//! and what is used moves to the younger one. No lock is held while samples are made; what two threads make at once is
//! made twice.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard};

use crate::host::process_id;
use crate::kdrt::{
    blocks::Blocks,
    region::{Part, Placed},
};
use crate::plane::Rect;

/// The bytes of a cache, about: what is added at once may exceed them.
const MOST_BYTES: usize = 1 << 25;

/// Blocks along the side of a page, of which a bit each says if they were made.
const PAGE: i32 = 8;

/// The bytes of a page without samples, about.
const PAGE_BYTES: usize = 96;

/// A layer of which blocks may be cached.
pub trait Cached {
    /// The blocks that the layer is made by, each of which is a function of the plane; none for one that is made as a
    /// whole.
    fn blocks(&self) -> Option<&Blocks>;
}

/// The number of a layer in its stack, and the place of a page in it.
type Key = (usize, [i32; 2]);

/// A square of blocks, some of which were made.
struct Page<S> {
    made: u64,
    /// The samples of the blocks that were made, in the first period of a torus.
    samples: Vec<S>,
}

impl<S> Default for Page<S> {
    fn default() -> Self {
        Self { made: 0, samples: Vec::new() }
    }
}

impl<S> Page<S> {
    fn bytes(&self) -> usize {
        PAGE_BYTES + self.samples.capacity() * size_of::<S>()
    }
}

/// The two generations of pages.
struct Pages<S> {
    young: HashMap<Key, Page<S>>,
    old: HashMap<Key, Page<S>>,
    /// The bytes of the young ones.
    bytes: usize,
}

impl<S> Default for Pages<S> {
    fn default() -> Self {
        Self { young: HashMap::new(), old: HashMap::new(), bytes: 0 }
    }
}

impl<S> Pages<S> {
    /// A page that is used, if there is one.
    fn used(&mut self, key: Key) -> Option<&Page<S>> {
        if let Some(page) = self.old.remove(&key) {
            self.bytes += page.bytes();
            self.young.insert(key, page);
        }
        self.young.get(&key)
    }

    /// Forgets the old ones if there are too many young ones.
    fn turn(&mut self, most_bytes: usize) {
        if self.bytes > most_bytes / 2 {
            self.old = std::mem::take(&mut self.young);
            self.bytes = 0;
        }
    }
}

/// The blocks of the layers of a plane that were made.
pub struct Cache<S> {
    pages: Mutex<Pages<S>>,
    most_bytes: usize,
    /// The process that made the plane. In one that was forked from it the lock may be held for ever.
    process: u32,
}

/// A run of blocks along an axis that lie in one page, and on a torus in one period.
struct Run {
    page: i32,
    /// The first block: in the page, and by its number.
    first: i32,
    index: i32,
    length: i32,
    /// The translation from the first period.
    shift: i32,
}

/// Cuts a rectangle of blocks along an axis.
fn runs(blocks: &Blocks, rect: &Rect, axis: usize) -> Vec<Run> {
    let (count, size) = (blocks.counts()[axis], blocks.size()[axis]);
    let (mut index, end, mut runs) = (rect.min[axis], rect.max[axis], Vec::new());
    while index < end {
        let (turn, place) = (index.div_euclid(count), index.rem_euclid(count));
        let (page, first) = (place / PAGE, place % PAGE);
        let length = (PAGE - first).min(count - place).min(end - index);
        runs.push(Run { page, first, index, length, shift: turn * size });
        index += length;
    }
    runs
}

/// The bits of the blocks of two runs.
fn bits(x: &Run, y: &Run) -> u64 {
    let row = ((1u64 << x.length) - 1) << x.first;
    (y.first..y.first + y.length).map(|line| row << (line * PAGE)).sum()
}

impl<S: Placed> Cache<S> {
    /// An empty cache.
    pub fn new() -> Self {
        Self::of_bytes(MOST_BYTES)
    }

    fn of_bytes(most_bytes: usize) -> Self {
        Self { pages: Mutex::default(), most_bytes, process: process_id() }
    }

    /// True if samples in these blocks leave room for others.
    pub fn is_for(&self, samples: f64) -> bool {
        samples * (size_of::<S>() as f64) < self.most_bytes as f64 / 16.0 && self.process == process_id()
    }

    /// The samples of a layer in a rectangle of lattice points, but for those of the blocks that are to be made: a
    /// rectangle of lattice points that has all blocks which were not made yet.
    pub fn look_up(&self, layer: usize, blocks: &Blocks, rect: &Rect) -> (Vec<S>, Option<Rect>) {
        let wanted = blocks.holding(rect);
        let (mut found, mut missing) = (Vec::new(), None::<Rect>);
        let (columns, rows) = (runs(blocks, &wanted, 0), runs(blocks, &wanted, 1));
        let mut pages = self.pages();
        for (x, y) in rows.iter().flat_map(|y| columns.iter().map(move |x| (x, y))) {
            let page = pages.used((layer, [x.page, y.page]));
            let lacking = bits(x, y) & !page.map_or(0, |page| page.made);
            if lacking != 0 {
                let lines = (0..PAGE).filter(|line| lacking >> (line * PAGE) & 0xff != 0);
                let row = (0..PAGE).fold(0u64, |row, line| row | lacking >> (line * PAGE) & 0xff);
                let (low, high) = (row.trailing_zeros() as i32, 63 - row.leading_zeros() as i32);
                let (bottom, top) = lines.fold((PAGE, 0), |(bottom, top), line| (bottom.min(line), top.max(line)));
                let origin = [x.index - x.first, y.index - y.first];
                let here = Rect { min: [low, bottom], max: [high + 1, top + 1] }.translated(origin);
                missing = Some(missing.map_or(here, |missing| missing.hull(&here)));
            }
            let samples = page.map_or(&[][..], |page| &page.samples);
            let images = samples.iter().map(|sample| {
                let [column, row] = sample.point();
                sample.moved_to([column + x.shift, row + y.shift])
            });
            found.extend(images.filter(|sample| rect.contains(sample.point())));
        }
        pages.turn(self.most_bytes);
        drop(pages);
        let missing = missing.map(|missing| blocks.rect(&missing));
        if let Some(missing) = &missing {
            found.retain(|sample| !missing.contains(sample.point()));
        }
        (found, missing)
    }

    /// Adds the samples of a layer in a part that consists of blocks, all of which were made.
    pub fn add(&self, layer: usize, blocks: &Blocks, part: &Part, samples: &[S]) {
        let made = blocks.holding(&part.rect);
        let (columns, rows) = (runs(blocks, &made, 0), runs(blocks, &made, 1));
        let mut pages = self.pages();
        // Another thread may have added some of them meanwhile.
        let mut fresh: HashMap<[i32; 2], u64> = HashMap::new();
        for (x, y) in rows.iter().flat_map(|y| columns.iter().map(move |x| (x, y))) {
            let held = pages.used((layer, [x.page, y.page])).map_or(0, |page| page.made);
            *fresh.entry([x.page, y.page]).or_default() |= bits(x, y) & !held;
        }
        fresh.retain(|_, bits| *bits != 0);
        for &page in fresh.keys() {
            if pages.used((layer, page)).is_none() {
                pages.bytes += Page::<S>::default().bytes();
                pages.young.insert((layer, page), Page::default());
            }
        }
        let keys: Vec<Key> = fresh.keys().map(|&page| (layer, page)).collect();
        let bytes = |pages: &Pages<S>| keys.iter().map(|key| pages.young[key].bytes()).sum::<usize>();
        let before = bytes(&pages);
        for sample in samples {
            let (mut place, mut point) = ([0; 2], sample.point());
            for axis in 0..2 {
                let index = blocks.index(axis, point[axis]);
                place[axis] = index.rem_euclid(blocks.counts()[axis]);
                point[axis] -= index.div_euclid(blocks.counts()[axis]) * blocks.size()[axis];
            }
            let (page, bit) = (place.map(|index| index / PAGE), place[1] % PAGE * PAGE + place[0] % PAGE);
            if fresh.get(&page).is_some_and(|bits| bits >> bit & 1 != 0)
                && let Some(page) = pages.young.get_mut(&(layer, page))
            {
                page.samples.push(sample.moved_to(point));
            }
        }
        for (page, bits) in fresh {
            if let Some(page) = pages.young.get_mut(&(layer, page)) {
                page.samples.shrink_to_fit();
                page.made |= bits;
            }
        }
        pages.bytes += bytes(&pages) - before;
        pages.turn(self.most_bytes);
    }

    /// The pages; none after a panic, which may have left half of one.
    fn pages(&self) -> MutexGuard<'_, Pages<S>> {
        self.pages.lock().unwrap_or_else(|poisoned| {
            let mut pages = poisoned.into_inner();
            *pages = Pages::default();
            pages
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kdrt::progressive::Sample;
    use crate::plane::Lattice;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// A layer whose blocks have one sample each, at their first lattice point, and all of its images in a rectangle.
    fn samples_in(blocks: &Blocks, rect: &Rect) -> Vec<Sample> {
        let Rect { min, max } = blocks.holding(rect);
        let places = (min[1]..max[1]).flat_map(|y| (min[0]..max[0]).map(move |x| [x, y]));
        let points = places.map(|place| blocks.rect(&Rect { min: place, max: place.map(|index| index + 1) }).min);
        points.filter(|&point| rect.contains(point)).map(|point| Sample { point, square: 7 }).collect()
    }

    fn sorted(mut samples: Vec<Sample>) -> Vec<[i32; 2]> {
        samples.sort_unstable_by_key(|sample| sample.point);
        samples.into_iter().map(|sample| sample.point).collect()
    }

    fn layer(boundary: Boundary) -> (Lattice, Blocks) {
        let domain = Domain { min: [0.0, 1.0], max: [3.0, 2.0], boundary };
        let lattice = Lattice::new(&domain, 0.0123).unwrap();
        let blocks = Blocks::new(&lattice, 5);
        (lattice, blocks)
    }

    /// Random rectangles, on a torus also on other images: what is found and what is made of the missing blocks are all
    /// samples, none of them twice, whatever was made before and forgotten.
    #[test]
    fn what_is_found_and_what_is_missing_are_all_samples_once() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for most_bytes in [3000, 20_000, MOST_BYTES] {
                let (lattice, blocks) = layer(boundary);
                let cache = Cache::of_bytes(most_bytes);
                let mut rng = Rng::at(1, Draw::Probe, &[most_bytes as u64]);
                let (mut full, mut partial) = (0, 0);
                for turn in 0..400 {
                    let mut rect = lattice.rect();
                    for axis in 0..2 {
                        let size = lattice.size[axis];
                        let (low, high) = if boundary == Boundary::Periodic { (-size, 2 * size) } else { (0, size) };
                        rect.min[axis] = low + rng.below((high - low) as u64 - 1) as i32;
                        let length = 1 + rng.below(if turn % 7 == 0 { size } else { size / 5 } as u64) as i32;
                        rect.max[axis] = (rect.min[axis] + length).min(high);
                    }
                    let part = Part::new(&lattice, &rect);
                    let (mut all, missing) = cache.look_up(turn % 2, &blocks, &part.rect);
                    full += usize::from(missing.is_none());
                    if let Some(missing) = missing {
                        partial += usize::from(!all.is_empty());
                        let made = Part::new(&lattice, &missing);
                        let samples = samples_in(&blocks, &made.rect);
                        cache.add(turn % 2, &blocks, &made, &samples);
                        // Samples of which some are there already.
                        cache.add(turn % 2, &blocks, &made, &samples);
                        all.extend(samples_in(&blocks, &part.rect).iter().filter(|s| missing.contains(s.point)));
                    }
                    assert_eq!(sorted(all), sorted(samples_in(&blocks, &part.rect)), "{boundary:?} {part:?}");
                    let pages = cache.pages();
                    let held = |pages: &HashMap<_, Page<Sample>>| pages.values().map(Page::bytes).sum::<usize>();
                    assert_eq!(pages.bytes, held(&pages.young));
                    assert!(pages.bytes <= most_bytes / 2 && pages.young.values().all(|page| page.made != 0));
                }
                assert!(most_bytes < MOST_BYTES || full > 100 && partial > 20, "{full} {partial}");
            }
        }
    }

    #[test]
    fn a_block_that_was_made_without_samples_is_not_missing() {
        let (lattice, blocks) = layer(Boundary::Periodic);
        let cache = Cache::<Sample>::new();
        let rect = blocks.rect(&Rect { min: [3, 4], max: [5, 6] });
        cache.add(0, &blocks, &Part::new(&lattice, &rect), &[]);
        assert_eq!(cache.look_up(0, &blocks, &rect), (Vec::new(), None));
        assert_eq!(cache.look_up(1, &blocks, &rect), (Vec::new(), Some(rect)));
        let wider = blocks.rect(&Rect { min: [3, 4], max: [6, 6] });
        let missing = blocks.rect(&Rect { min: [5, 4], max: [6, 6] });
        assert_eq!(cache.look_up(0, &blocks, &wider), (Vec::new(), Some(missing)));
    }
}
