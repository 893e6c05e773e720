//! Levels: maximal sets of ever smaller radii, each filled around the samples of those before.
//!
//! Each sample has a *rank*: its distance to the nearest sample that was accepted before it, but no more than the radius
//! of the level before, which it exceeds by a tolerance at most. Of any two samples the later one's rank is no more than
//! their distance. So all samples whose ranks are at least some distance are that far apart, whatever their order. And
//! the ranks of a level lie between its own radius and that of the level before: sorted by falling rank, all levels are
//! in order, and a prefix that ends within a level covers the surface within the radius of the level before.
//!
//! Given samples keep their clearances on all levels, and ranks do not count them; nor do they count samples that a
//! sample ignores, since they face another way.
//!
//! Where the radius varies (`adaptive/levels.rs`) distances are measured by the mean of two local radii, and the radius
//! of a level is what these are multiplied by.

use crate::error::Result;
use crate::job::Job;
use crate::math::rounded_down;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::FillOptions;
use crate::psp::fill::rounds::PATCH;
use crate::psp::fill::uniform::Surface;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, hash};

/// From this quotient of two radii on, a level begins with first darts, as on an empty surface: the level before covers too
/// little.
const FIRST_DARTS_FROM: f64 = 1.3;
/// Otherwise little is open. Patches are cut up to this length, in radii, before darts are thrown.
const FIRST_PATCH: f32 = 1.0;
/// Ranks are looked for no farther than this, in radii.
const LARGEST_RANK: f64 = 2.0;

/// [`top`] in diagonals of the mesh's box: a little more than any distance on it.
const TOP: f64 = 1.001;

/// A radius within which any sample covers the mesh.
pub fn top(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    TOP * exact(low).distance(exact(high))
}

/// What levels are filled on.
pub trait Levelled {
    /// A sample, with what is known of it beside its place and its rank.
    type Sample: Copy + Ranked;

    /// A radius within which any sample covers all of it.
    fn top(&self) -> f64;

    /// About how many samples a radius gives where none are given.
    fn expected(&self, radius: f64) -> f64;

    /// Whether samples are given.
    fn has_given(&self) -> bool;

    /// The samples with those that a fill at this radius adds, which are last, and the darts that it took.
    fn fill(
        &self,
        job: &Job,
        options: FillOptions,
        radius: f64,
        samples: &[Self::Sample],
    ) -> Result<(Vec<Self::Sample>, u64)>;
}

/// What has a place and a rank.
pub trait Ranked {
    fn sample(&self) -> &Sample;
}

impl Ranked for Sample {
    fn sample(&self) -> &Sample {
        self
    }
}

impl Levelled for Surface<'_> {
    type Sample = Sample;

    fn top(&self) -> f64 {
        top(self.mesh)
    }

    fn expected(&self, radius: f64) -> f64 {
        self.measures.expected_samples(self.mesh, radius)
    }

    fn has_given(&self) -> bool {
        !self.given.is_empty()
    }

    fn fill(&self, job: &Job, options: FillOptions, radius: f64, samples: &[Sample]) -> Result<(Vec<Sample>, u64)> {
        let mut set = SampleSet::of(self.mesh, radius, samples);
        let darts = Surface::fill(self, job, &mut set, options)?.darts;
        Ok((set.into_samples(), darts))
    }
}

/// A set of samples that is refined, level by level.
pub struct Levels<S: Levelled> {
    pub surface: S,
    seed: u64,
    /// Those of the last level last.
    samples: Vec<S::Sample>,
    /// The radius of the last level; infinite before the first.
    radius: f64,
    /// Darts thrown so far.
    pub darts: u64,
}

impl<S: Levelled> Levels<S> {
    /// No level yet.
    pub fn new(surface: S, seed: u64) -> Self {
        Self { surface, seed, samples: Vec::new(), radius: f64::INFINITY, darts: 0 }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The radius of the last level: everything is covered within it. Infinite before the first level.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Adds a level of a smaller radius. `key` selects its random numbers. The samples of the first level have infinite
    /// ranks.
    pub fn refine(&mut self, job: &Job, radius: f64, key: u64) -> Result<()> {
        let former = std::mem::replace(&mut self.radius, radius);
        let throws_first = former > FIRST_DARTS_FROM * radius;
        let options = FillOptions {
            seed: hash(self.seed, Draw::Level, &[key]),
            throws_first,
            measures: false,
            patch: if throws_first { PATCH as f32 } else { FIRST_PATCH },
            largest_rank: former.is_finite().then_some(below(former).min(LARGEST_RANK * radius)),
        };
        let (samples, darts) = self.surface.fill(job, options, radius, &self.samples)?;
        (self.samples, self.darts) = (samples, self.darts + darts);
        Ok(())
    }

    /// Takes the last level back: the state before it had so many samples and this radius.
    pub fn take_back(&mut self, len: usize, radius: f64) {
        self.samples.truncate(len);
        self.radius = radius;
    }

    /// The samples by falling rank, those of equal rank by their places.
    pub fn into_sorted(self) -> Vec<S::Sample> {
        let Self { mut samples, .. } = self;
        let place = |sample: &Sample| (sample.triangle, sample.barycentrics.map(f32::to_bits));
        samples.sort_unstable_by(|a, b| {
            let (a, b) = (a.sample(), b.sample());
            b.rank.total_cmp(&a.rank).then_with(|| place(a).cmp(&place(b)))
        });
        samples
    }

    /// The smallest rank of the `count` samples of the largest ranks; there are as many.
    pub fn rank_of(&self, count: usize) -> f64 {
        let mut ranks: Vec<f32> = self.samples.iter().map(|sample| sample.sample().rank).collect();
        let (_, &mut rank, _) = ranks.select_nth_unstable_by(count - 1, |a, b| b.total_cmp(a));
        f64::from(rank)
    }
}

/// The largest rank below those of a level of this radius, so that sorted ranks keep levels apart.
fn below(radius: f64) -> f64 {
    f64::from(rounded_down(radius).next_down())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::psp::facing::Facing;
    use crate::psp::fill::measures::Measures;
    use crate::psp::given::GivenSamples;

    /// A triangle of this area.
    fn triangle(area: f32) -> Mesh {
        Mesh::new(vec![[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, area, 1.2]], vec![[0, 1, 2]]).unwrap()
    }

    /// In one piece, and where cubes are filled by themselves: against all samples before.
    #[test]
    fn a_rank_is_the_distance_to_the_nearest_sample_before() {
        for (radius, least) in [(0.05, 250), (0.005, 25_500)] {
            let (mesh, context) = (triangle(1.0), Context::new(2).unwrap());
            let measures = Measures::of(&mesh);
            let given = &GivenSamples::none(&mesh);
            let mut levels = Levels::new(Surface { mesh: &mesh, measures: &measures, given, facing: Facing::ANY }, 5);
            let mut refine = |radius, key| context.run(None, |job| levels.refine(job, radius, key)).unwrap();
            refine(1.2 * radius, 0);
            refine(radius, 1);
            let [former, last] = [1.2 * radius, radius].map(rounded_down);
            let (mut equal, mut added) = (0, 0);
            for (i, sample) in levels.samples.iter().enumerate().filter(|(_, sample)| sample.rank.is_finite()) {
                let distance = |other: &Sample| exact(other.position).distance_squared(exact(sample.position));
                let nearest = levels.samples[..i].iter().map(distance).fold(f64::INFINITY, f64::min).sqrt();
                assert!(last <= sample.rank && sample.rank < former && f64::from(sample.rank) <= nearest);
                equal += usize::from(f64::from(sample.rank.next_up()) >= nearest);
                added += 1;
            }
            assert!(levels.len() > least && 8 * added > levels.len(), "{added} of {}", levels.len());
            // But for those that tolerance leaves beyond the former radius, and near to it.
            assert!(added - equal <= added / 1000, "{equal} of {added}");
            let sorted = levels.into_sorted();
            assert!(sorted.is_sorted_by(|a, b| a.rank >= b.rank));
        }
    }
}
