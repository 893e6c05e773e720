//! The levels of a surface (`levels.rs`): sets in progressive order, and of an exact count.

use crate::error::Result;
use crate::job::Job;
use crate::levels::Ranked;
pub use crate::levels::{LevelOptions, Levelled, LevelledSet, Levels, by_count, by_radius};
use crate::mesh::{Mesh, exact};
use crate::order::Order;
use crate::points::Points;
use crate::psp::fill::{BYTES_PER_SAMPLE, FillOptions, PATCH, Surface, require_samples};
use crate::psp::set::{Sample, SampleSet, surface_samples};

/// The length, in radii, to which patches are cut before darts are thrown on a level without first darts, where little
/// is open.
const FIRST_PATCH: f32 = 1.0;
/// [`top`] in diagonals of the mesh's box: slightly more than any distance on it.
const TOP: f64 = 1.001;

/// The name of the ground and of what its samples cover, for messages.
pub const NAMES: [&str; 2] = ["mesh", "surface"];

/// A radius within which any sample covers the mesh.
pub fn top(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    TOP * exact(low).distance(exact(high))
}

/// A sample on a surface, and its radius where that varies.
pub trait SurfaceSample {
    fn sample(&self) -> &Sample;

    fn sample_mut(&mut self) -> &mut Sample;
}

impl SurfaceSample for Sample {
    fn sample(&self) -> &Sample {
        self
    }

    fn sample_mut(&mut self) -> &mut Sample {
        self
    }
}

impl<S: SurfaceSample> Ranked for S {
    type Place = (u32, [u32; 2]);

    fn rank(&self) -> f32 {
        self.sample().rank
    }

    fn place(&self) -> Self::Place {
        (self.sample().triangle, self.sample().barycentrics.map(f32::to_bits))
    }
}

impl FillOptions {
    /// The options of a level.
    pub fn of_level(options: LevelOptions) -> Self {
        let LevelOptions { seed, throws_first, largest_rank } = options;
        let patch = if throws_first { PATCH as f32 } else { FIRST_PATCH };
        Self { seed, throws_first, measures: false, patch, largest_rank }
    }
}

impl Levelled for Surface<'_> {
    type Sample = Sample;

    const DIMENSION: u32 = 2;

    const NAMES: [&'static str; 2] = NAMES;

    fn top(&self) -> f64 {
        top(self.mesh)
    }

    fn expected(&self, radius: f64) -> f64 {
        self.measures.expected_samples(self.mesh, radius)
    }

    fn check_work(&self, radius: f64, count: usize) -> Result<()> {
        check_work(!self.given.is_empty(), self.expected(radius), count)
    }

    fn fill(&self, job: &Job, options: LevelOptions, radius: f64, samples: &[Sample]) -> Result<(Vec<Sample>, u64)> {
        let mut set = SampleSet::of(self.mesh, radius, samples);
        let darts = Surface::fill(self, job, &mut set, FillOptions::of_level(options))?.darts;
        Ok((set.into_samples(), darts))
    }
}

impl<S: SurfaceSample> LevelledSet<S> {
    /// The samples; in progressive order with their ranks.
    pub fn to_points(&self, mesh: &Mesh, order: Order) -> Points<3> {
        let samples = self.samples.iter().map(SurfaceSample::sample);
        let mut points = surface_samples(mesh, samples.clone());
        if order == Order::Progressive {
            points.ranks = samples.map(|sample| sample.rank).collect();
        }
        points
    }
}

/// [`Levelled::check_work`] for a surface, on the whole of which so many samples are expected.
pub fn check_work(has_given: bool, expected: f64, count: usize) -> Result<()> {
    if !has_given {
        return Ok(());
    }
    let asking = format!("{count} samples beside the given ones: on the whole surface");
    require_samples(expected, BYTES_PER_SAMPLE, "count", &asking)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::math::rounded_down;
    use crate::psp::fill::Measures;
    use crate::psp::fragment::Facing;
    use crate::psp::given::GivenSamples;

    /// A triangle of this area.
    fn triangle(area: f32) -> Mesh {
        Mesh::new(vec![[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, area, 1.2]], vec![[0, 1, 2]]).unwrap()
    }

    /// Tested in one piece, and where cubes are filled by themselves: against all samples before.
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
            // Except for those that the tolerance leaves beyond the former radius, and near to it.
            assert!(added - equal <= added / 1000, "{equal} of {added}");
            let sorted = levels.into_sorted();
            assert!(sorted.is_sorted_by(|a, b| a.rank >= b.rank));
        }
    }
}
