//! Sets that are edited, in the plane or on a mesh: samples are erased in a region, given samples come and go, and the
//! gaps are filled again. All of it takes time in proportion to what changes, not to the set (not in the thesis).
//!
//! A maximal set has gaps only where something was erased: within a radius of an erased sample, or in the clearance of a
//! given sample that was removed. An edit notes the regions that may have some. Samples are kept by *bins*, parts of the
//! [`Ground`] that are large beside the radius, so that only those near an edit are looked at.
//!
//! The new samples depend on the seed, on the regions of the edits and on the samples that stand around them, by their
//! places alone: after the same edits the same seed gives the same samples, whatever was erased. Edits are filled one by
//! one, the last one first: an earlier one, of which nothing is left to fill, then changes nothing.

use std::collections::HashMap;
use std::hash::Hash;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::host::Stopwatch;
use crate::index::Grid3;
use crate::job::{Context, Job, Progress};
use crate::points::Points;
use crate::region::Region;

/// The reach of a sample in radii, in a search for what it covers: more than 1 by what rounding can matter, which is
/// below a few float spacings, of which a radius has 64.
const REACH: f64 = 1.1;

/// The progress of a refill that its preparation takes.
const PREPARATION: f64 = 0.2;

/// The plane or the mesh that a set stands on, and the way in which its gaps are filled.
pub trait Ground<const AXES: usize> {
    type Sample: Copy;
    /// A part of the ground, for a search of the samples in it.
    type Bin: Copy + Ord + Hash;
    /// The result of a refill.
    type Refilled;

    /// The radius of the set.
    fn radius(&self) -> f64;

    fn position(sample: &Self::Sample) -> [f32; AXES];

    /// The bin of a position. Where no sample can be, any bin whose positions are near each other.
    fn bin(&self, position: [f64; AXES]) -> Self::Bin;

    /// The bins that may have samples in a region, each once.
    fn bins_in(&self, region: &Region, standing: &Standing<Self::Sample, Self::Bin>) -> Vec<Self::Bin>;

    /// True if a position lies in a region.
    fn is_in(&self, region: &Region, position: [f32; AXES]) -> bool;

    /// The places in space at which a search in a grid looks for the samples around a position.
    fn images(&self, position: [f32; AXES]) -> Vec<[f64; 3]>;

    /// True if two samples are too close.
    fn conflict(&self, a: &Self::Sample, b: &Self::Sample) -> bool;

    /// The squared distance of two positions.
    fn squared(&self, a: [f32; AXES], b: [f32; AXES]) -> f64;

    /// A sample of a list, if it can be one of this ground.
    fn sample(&self, points: &Points<AXES>, index: usize) -> Option<Self::Sample>;

    /// The list of samples, without ids.
    fn points(&self, samples: &[Self::Sample]) -> Points<AXES>;

    /// Makes what all refills need, before each of them.
    fn prepare(&mut self, job: &Job) -> Result<()>;

    /// The samples that are missing in the regions of an edit, and the number of darts.
    fn fill(&self, job: &Job, edit: &Edit<AXES, Self::Sample, Self::Bin>) -> Result<(Vec<Self::Sample>, u64)>;

    /// The result of a refill that has added samples by so many darts; the set now has `len`.
    fn refilled(&self, added: Points<AXES>, len: usize, darts: u64, stopwatch: &Stopwatch) -> Self::Refilled;
}

/// An edit that is filled, and all that stands.
pub struct Edit<'a, const AXES: usize, S, B> {
    /// The regions that may have gaps.
    pub regions: &'a [Region],
    pub standing: &'a Standing<S, B>,
    pub given: &'a [GivenSample<AXES>],
    pub seed: u64,
}

/// A given sample, its id and its clearance.
#[derive(Clone, Copy)]
pub struct GivenSample<const AXES: usize> {
    id: u64,
    pub position: [f32; AXES],
    pub clearance: f64,
}

/// A set of samples that is edited, in any part of it at any time: [`psp::EditableSet`](crate::psp::EditableSet) on a
/// mesh, [`kdrt::EditableSet`](crate::kdrt::EditableSet) in the plane.
///
/// Every sample has an *id*, which no other sample of the set ever has, and keeps it, with all its bytes, until it is
/// erased. After a [refill](Self::refill) the set is maximal, around the given samples as they are then. Between an edit
/// and the refill it is a valid set with gaps.
///
/// To undo a stroke of a brush, erase the samples that it added, by their ids, and [restore](Self::restore) those that
/// it erased. To redo it, erase the same region and refill with the same seed: the samples are the same, bit for bit,
/// with new ids.
pub struct EditableSet<const AXES: usize, G: Ground<AXES>> {
    ground: G,
    seed: u64,
    standing: Standing<G::Sample, G::Bin>,
    /// By rising ids.
    given: Vec<GivenSample<AXES>>,
    next_given: u64,
    /// The regions of each edit since the last refill, which may have gaps.
    edits: Vec<Vec<Region>>,
}

impl<const AXES: usize, G: Ground<AXES>> EditableSet<AXES, G> {
    /// A set of samples that do not conflict, and of given ones with their clearances.
    pub(crate) fn begin(
        ground: G,
        seed: u64,
        samples: impl IntoIterator<Item = G::Sample>,
        given: impl IntoIterator<Item = ([f32; AXES], f64)>,
        is_maximal: bool,
    ) -> Self {
        let numbered = |(id, (position, clearance))| GivenSample { id, position, clearance };
        let given: Vec<_> = (0..).zip(given).map(numbered).collect();
        let next_given = given.len() as u64;
        let edits = if is_maximal { Vec::new() } else { vec![vec![Region::EVERYWHERE]] };
        let mut set = Self { ground, seed, standing: Standing::new(), given, next_given, edits };
        samples.into_iter().for_each(|sample| set.add(sample));
        set
    }

    /// The ground.
    pub(crate) fn ground(&self) -> &G {
        &self.ground
    }

    /// Notes that a region may have gaps.
    pub(crate) fn open(&mut self, region: Region) {
        self.edits.push(vec![region]);
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.standing.len
    }

    /// True if there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The seed of the set that this one began as.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The radius: the smallest distance of two samples.
    pub fn radius(&self) -> f64 {
        self.ground.radius()
    }

    /// A copy of the samples, by rising [ids](Points::ids). O(n log n).
    pub fn samples(&self) -> Points<AXES> {
        self.points(self.standing.bins.values().flatten().copied().collect())
    }

    /// Erases the samples in a region, and returns them. O(samples of the bins of about 24 radii that it touches).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `region` with bounds that are NaN or in the wrong order.
    pub fn erase(&mut self, region: &Region) -> Result<Points<AXES>> {
        region.check()?;
        let erased = self.take(region, |ground, position| ground.is_in(region, position));
        self.open(region.grown(REACH * self.radius()));
        Ok(self.points(erased))
    }

    /// Erases samples by their ids, and returns them. O(samples of the bins that they are in).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an id in `ids` that no sample has, or that is listed twice; nothing is erased
    /// then.
    pub fn erase_ids(&mut self, ids: &[u64]) -> Result<Points<AXES>> {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Error::invalid("ids", format!("{} is listed twice", pair[0])));
        }
        let mut by_bin: HashMap<G::Bin, Vec<u64>> = HashMap::new();
        for (index, &id) in ids.iter().enumerate() {
            let Some(bin) = self.standing.bin_with(id) else {
                return Err(Error::invalid("ids", format!("[{index}] is {id}, which no sample of the set has")));
            };
            by_bin.entry(bin).or_default().push(id);
        }
        let mut erased = Vec::new();
        for (bin, mut ids) in by_bin {
            ids.sort_unstable();
            self.standing.take(bin, |own| ids.binary_search(&own.id).is_ok(), &mut erased);
        }
        let reach = REACH * self.radius();
        self.note_balls(erased.iter().map(|own| (G::position(&own.sample), reach)));
        Ok(self.points(erased))
    }

    /// Puts samples back that were erased, with their ids.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `points` that are not samples of this set or stand already, and for one that is
    /// closer than the radius to a sample of the set, or than its clearance to a given one; nothing is put back then.
    pub fn restore(&mut self, points: &Points<AXES>) -> Result<()> {
        let refused = |index: usize, reason: String| Err(Error::invalid("points", format!("[{index}] {reason}")));
        if points.ids.len() != points.len() {
            return Err(Error::invalid("points", "are not samples of a set that is edited"));
        }
        let mut restored = Vec::with_capacity(points.len());
        for (index, &id) in points.ids.iter().enumerate() {
            match self.ground.sample(points, index).filter(|_| self.standing.has_had(id)) {
                Some(sample) => restored.push(Numbered { id, sample }),
                None => {
                    return refused(index, format!("is not a sample of this set, in which the id {id} is another's"));
                }
            }
        }
        let mut around: Vec<G::Bin> = Vec::new();
        for own in &restored {
            let ball = self.ball(G::position(&own.sample), REACH * self.radius());
            around.extend(self.ground.bins_in(&ball, &self.standing));
        }
        around.sort_unstable();
        around.dedup();
        let mut near = Neighbours::new(&self.ground);
        self.standing.in_bins(around).for_each(|own| near.add(*own));
        for (index, own @ Numbered { id, sample }) in restored.iter().enumerate() {
            if self.standing.bin_with(*id).is_some() {
                return refused(index, format!("stands already, with the id {id}"));
            }
            if let Some(other) = near.conflict(sample) {
                return refused(index, format!("conflicts with sample {}", other.id));
            }
            let position = G::position(sample);
            if let Some(given) = self.given.iter().find(|given| given.covers(&self.ground, position)) {
                return refused(index, format!("conflicts with given sample {}", given.id));
            }
            near.add(*own);
        }
        for own in restored {
            self.standing.put(own, self.ground.bin(G::position(&own.sample).map(f64::from)));
        }
        Ok(())
    }

    /// Adds given samples; those without clearances have the radius of the set. Samples that are closer to one than its
    /// clearance are erased. Returns the id of the first given sample, which the others follow, and the erased samples.
    /// O(samples of the bins that the clearances touch, for each).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for given samples out of range, by their index (`given_positions`,
    /// `given_clearances`).
    pub fn add_given(&mut self, given: Given<AXES>) -> Result<(u64, Points<AXES>)> {
        given.check()?;
        let (first, radius, mut erased, mut gaps) = (self.next_given, self.radius(), Vec::new(), Vec::new());
        for (index, &position) in given.positions.iter().enumerate() {
            let clearance = given.clearance(index, radius);
            let given = GivenSample { id: self.next_given, position, clearance };
            self.given.push(given);
            self.next_given += 1;
            let ball = self.ball(position, clearance * REACH);
            let covered = self.take(&ball, |ground, position| given.covers(ground, position));
            if !covered.is_empty() {
                gaps.push((position, REACH * (clearance + radius)));
            }
            erased.extend(covered);
        }
        self.note_balls(gaps.into_iter());
        Ok((first, self.points(erased)))
    }

    /// Removes given samples by their ids. O(given samples).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an id in `ids` that no given sample has; nothing is removed then.
    pub fn remove_given(&mut self, ids: &[u64]) -> Result<()> {
        let place = |id: u64| self.given.binary_search_by_key(&id, |given| given.id);
        if let Some(index) = ids.iter().position(|&id| place(id).is_err()) {
            return Err(Error::invalid("ids", format!("[{index}] is {}, which no given sample has", ids[index])));
        }
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        let (mut gaps, radius) = (Vec::new(), self.radius());
        self.given.retain(|given| {
            let is_removed = sorted.binary_search(&given.id).is_ok();
            if is_removed {
                gaps.push((given.position, REACH * given.clearance.max(radius)));
            }
            !is_removed
        });
        self.note_balls(gaps.into_iter());
        Ok(())
    }

    /// Adds samples until the set is maximal, and returns them, on a mesh with a report. A call takes time in proportion
    /// to the ground in and around the regions that were edited since the last one, and reads the list of given samples
    /// once for each edit; on a mesh the first call also sorts the triangles, in O(triangles).
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: nothing is added then.
    pub fn refill(&mut self, context: &Context, seed: u64, progress: Option<&Progress>) -> Result<G::Refilled> {
        let (stopwatch, first) = (Stopwatch::start(), self.standing.next_id());
        let filled = context.run(progress, |job| self.fill(job, seed));
        let darts = filled.inspect_err(|_| self.standing.forget(first))?;
        self.edits.clear();
        let added = self.points(self.standing.from(first));
        Ok(self.ground.refilled(added, self.len(), darts, &stopwatch))
    }

    /// Fills the gaps of each edit, the last one first, and returns the number of darts.
    fn fill(&mut self, job: &Job, seed: u64) -> Result<u64> {
        self.ground.prepare(&job.part(0.0, PREPARATION))?;
        let (count, mut darts) = (self.edits.len(), 0);
        for step in 0..count {
            let share = |step: usize| PREPARATION + (1.0 - PREPARATION) * step as f64 / count as f64;
            let regions = &self.edits[count - 1 - step];
            let edit = Edit { regions, standing: &self.standing, given: &self.given, seed };
            let (samples, thrown) = self.ground.fill(&job.part(share(step), share(step + 1)), &edit)?;
            samples.into_iter().for_each(|sample| self.add(sample));
            darts += thrown;
        }
        Ok(darts)
    }

    /// Adds a sample with the next id.
    fn add(&mut self, sample: G::Sample) {
        let own = Numbered { id: self.standing.next_id(), sample };
        self.standing.put(own, self.ground.bin(G::position(&sample).map(f64::from)));
    }

    /// Removes the samples in the bins of a region for whose positions a test holds, and returns them.
    fn take(&mut self, region: &Region, is_taken: impl Fn(&G, [f32; AXES]) -> bool) -> Vec<Numbered<G::Sample>> {
        let mut taken = Vec::new();
        for bin in self.ground.bins_in(region, &self.standing) {
            self.standing.take(bin, |own| is_taken(&self.ground, G::position(&own.sample)), &mut taken);
        }
        taken
    }

    /// Notes an edit that can have left gaps in balls, given by centre and radius: by the boxes of those that begin in
    /// the same bin.
    fn note_balls(&mut self, balls: impl Iterator<Item = ([f32; AXES], f64)>) {
        let mut boxes: HashMap<G::Bin, Region> = HashMap::new();
        for (centre, radius) in balls {
            let [low, high] = self.ball(centre, radius).bounds();
            let bin = self.ground.bin(centre.map(f64::from));
            let around = boxes.entry(bin).or_insert_with(|| Region::cuboid(low, high));
            around.min = [0, 1, 2].map(|axis| around.min[axis].min(low[axis]));
            around.max = [0, 1, 2].map(|axis| around.max[axis].max(high[axis]));
        }
        if !boxes.is_empty() {
            self.edits.push(boxes.into_values().collect());
        }
    }

    fn ball(&self, centre: [f32; AXES], radius: f64) -> Region {
        Region::ball(in_space(centre).map(f64::from), radius)
    }

    /// Samples by rising ids.
    fn points(&self, mut numbered: Vec<Numbered<G::Sample>>) -> Points<AXES> {
        numbered.sort_unstable_by_key(|own| own.id);
        let ids = numbered.iter().map(|own| own.id).collect();
        let samples: Vec<G::Sample> = numbered.into_iter().map(|own| own.sample).collect();
        Points { ids, ..self.ground.points(&samples) }
    }
}

impl<const AXES: usize> GivenSample<AXES> {
    /// True if a position is closer than the clearance.
    fn covers(&self, ground: &impl Ground<AXES>, position: [f32; AXES]) -> bool {
        ground.squared(self.position, position) < self.clearance * self.clearance
    }
}

/// A position of the plane in space, at height 0; one in space as it is.
pub fn in_space<const AXES: usize>(position: [f32; AXES]) -> [f32; 3] {
    std::array::from_fn(|axis| position.get(axis).copied().unwrap_or(0.0))
}

/// The first two of some samples that conflict, by their index, the later one first.
pub fn first_conflict<const AXES: usize, G: Ground<AXES>>(ground: &G, samples: &[G::Sample]) -> Option<[u64; 2]> {
    let mut near = Neighbours::new(ground);
    (0..).zip(samples).find_map(|(id, sample)| {
        let other = near.conflict(sample).map(|other| [id, other.id]);
        near.add(Numbered { id, sample: *sample });
        other
    })
}

/// Samples among which those too close to another one are found.
struct Neighbours<'a, const AXES: usize, G: Ground<AXES>> {
    ground: &'a G,
    grid: Grid3,
    samples: Vec<Numbered<G::Sample>>,
}

impl<'a, const AXES: usize, G: Ground<AXES>> Neighbours<'a, AXES, G> {
    fn new(ground: &'a G) -> Self {
        Self { ground, grid: Grid3::new([0.0; 3], ground.radius()), samples: Vec::new() }
    }

    fn add(&mut self, own: Numbered<G::Sample>) {
        self.grid.insert(in_space(G::position(&own.sample)));
        self.samples.push(own);
    }

    /// A sample that conflicts with another one.
    fn conflict(&self, sample: &G::Sample) -> Option<&Numbered<G::Sample>> {
        let images = self.ground.images(G::position(sample)).into_iter();
        let near = images.flat_map(|image| self.grid.candidates(image, REACH * self.ground.radius()));
        near.map(|index| &self.samples[index as usize]).find(|other| self.ground.conflict(sample, &other.sample))
    }
}

// # Samples by bins and ids
//
// The standing samples, and the bin of every sample that has ever stood.

/// A sample and its id.
#[derive(Clone, Copy)]
pub struct Numbered<S> {
    id: u64,
    pub sample: S,
}

/// Samples by bins, and their ids.
pub struct Standing<S, B> {
    bins: HashMap<B, Vec<Numbered<S>>>,
    len: usize,
    /// The bin of each sample that the set has ever had, by id.
    bin_of: Vec<B>,
}

impl<S: Copy, B: Copy + Ord + Hash> Standing<S, B> {
    fn new() -> Self {
        Self { bins: HashMap::new(), len: 0, bin_of: Vec::new() }
    }

    /// The bins that have samples, in any order.
    pub fn bins(&self) -> impl ExactSizeIterator<Item = B> {
        self.bins.keys().copied()
    }

    /// The samples in some bins.
    pub fn in_bins(&self, bins: impl IntoIterator<Item = B>) -> impl Iterator<Item = &Numbered<S>> {
        bins.into_iter().filter_map(|bin| self.bins.get(&bin)).flatten()
    }

    /// The id of the next new sample.
    fn next_id(&self) -> u64 {
        self.bin_of.len() as u64
    }

    /// True if an id is or was a sample's.
    fn has_had(&self, id: u64) -> bool {
        id < self.next_id()
    }

    /// The bin that has the sample of an id, if one stands.
    fn bin_with(&self, id: u64) -> Option<B> {
        let bin = *self.bin_of.get(usize::try_from(id).ok()?)?;
        self.bins.get(&bin)?.iter().any(|own| own.id == id).then_some(bin)
    }

    /// Puts a sample into its bin: the next new one, or one that has stood before.
    fn put(&mut self, own: Numbered<S>, bin: B) {
        match self.bin_of.get_mut(own.id as usize) {
            Some(known) => *known = bin,
            None => self.bin_of.push(bin),
        }
        self.bins.entry(bin).or_default().push(own);
        self.len += 1;
    }

    /// Moves the samples of a bin for which a test holds.
    fn take(&mut self, bin: B, is_taken: impl Fn(&Numbered<S>) -> bool, taken: &mut Vec<Numbered<S>>) {
        let Some(own) = self.bins.get_mut(&bin) else { return };
        let before = taken.len();
        own.retain(|own| {
            let is_taken = is_taken(own);
            if is_taken {
                taken.push(*own);
            }
            !is_taken
        });
        if own.is_empty() {
            self.bins.remove(&bin);
        }
        self.len -= taken.len() - before;
    }

    /// The samples with this id and later ones.
    fn from(&self, first: u64) -> Vec<Numbered<S>> {
        let mut bins = self.bin_of[first as usize..].to_vec();
        bins.sort_unstable();
        bins.dedup();
        self.in_bins(bins).filter(|own| own.id >= first).copied().collect()
    }

    /// Removes the samples with this id and later ones, as if there had never been any.
    fn forget(&mut self, first: u64) {
        for bin in self.bin_of.split_off(first as usize) {
            self.take(bin, |own| own.id >= first, &mut Vec::new());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(numbered: &[Numbered<char>]) -> Vec<u64> {
        let mut ids: Vec<u64> = numbered.iter().map(|own| own.id).collect();
        ids.sort_unstable();
        ids
    }

    #[test]
    fn samples_are_found_by_id_and_by_bin_until_they_are_taken() {
        let mut standing = Standing::new();
        for (sample, bin) in [('a', 5), ('b', 3), ('c', 5), ('d', 4)] {
            standing.put(Numbered { id: standing.next_id(), sample }, bin);
        }
        let samples =
            |standing: &Standing<char, i32>, bin| -> String { standing.in_bins([bin]).map(|own| own.sample).collect() };
        assert_eq!((standing.len, standing.next_id(), standing.bins().len()), (4, 4, 3));
        assert_eq!((samples(&standing, 5), samples(&standing, 9)), ("ac".into(), String::new()));
        assert_eq!((standing.bin_with(2), standing.bin_with(4), standing.has_had(4)), (Some(5), None, false));

        let mut taken = Vec::new();
        standing.take(5, |own| own.sample == 'a', &mut taken);
        standing.take(3, |_| true, &mut taken);
        assert_eq!((ids(&taken), standing.len, standing.bins().len()), (vec![0, 1], 2, 2));
        assert_eq!((standing.bin_with(0), standing.has_had(0), standing.bin_with(2)), (None, true, Some(5)));
        standing.put(taken[0], 5);
        assert_eq!((standing.bin_with(0), standing.next_id(), standing.len), (Some(5), 4, 3));

        assert_eq!((ids(&standing.from(2)), ids(&standing.from(4))), (vec![2, 3], vec![]));
        standing.forget(2);
        assert_eq!((standing.len, standing.next_id(), samples(&standing, 5)), (1, 2, "a".into()));
    }
}
