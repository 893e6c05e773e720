//! Sets of several classes in cuboids (Wei 2010, "Multi-class blue noise sampling").
//!
//! Classes are filled one after the other by falling own radius, each around the samples that stand: those of other classes are
//! given samples with the distance of the two classes as their clearance, which keeps them apart and covers what they leave. A
//! class is finished when nothing is open for it, and later samples only cover more.
//!
//! Classes of *equal* own radius take turns, since the one that is filled first would have more: each is filled at ever smaller
//! radii (`levels.rs`), where few samples are in another's way, and each level begins with another class.

use crate::classes::Classes;
use crate::error::{Error, Result};
use crate::given::Given;
use crate::job::{Context, Job, Progress};
use crate::levels::LevelOptions;
use crate::plane::{GivenDisks, Lattice, float_spacing};
use crate::points::{Boundary, Domain, Points, finest_radius};
use crate::rng::{Draw, hash};
use crate::setters::setters;
use crate::volume::set::{Sample, Set};
use crate::volume::space::Space;
use crate::volume::{expected_samples, require};

/// The radii of the levels of classes that take turns, in own radii, and of classes that do not.
const TURNS: &[f64] = &[2.0, 1.7, 1.45, 1.25, 1.12, 1.05, 1.0];
const ALONE: &[f64] = &[1.0];

/// The bytes of memory for each sample of the other classes, around which one is filled, for each of its own, and for each of the
/// result. Found by `tests/c/memory_limits.c`.
const BYTES_PER_OTHER: f64 = 157.0;
const BYTES_PER_OWN: f64 = 51.0;
const BYTES_PER_MADE: f64 = 40.0;
/// For what threads keep of the classes around a block.
const BYTES_AROUND: f64 = (2 << 20) as f64;

/// The options of [`sample_classes`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClassesOptions<'a> {
    /// See [`Options::domain`](super::Options::domain).
    pub domain: Domain<3>,
    /// The same options, classes and seed give the same samples.
    pub seed: u64,
    /// See [`Options::given`](super::Options::given); their clearances, if they have any, are rows of one for each class.
    pub given: Given<'a, 3>,
}

impl Default for ClassesOptions<'_> {
    /// The unit torus with seed 0, without given samples.
    fn default() -> Self {
        Self { domain: Domain::unit(Boundary::Periodic), seed: 0, given: Given::default() }
    }
}

setters!(ClassesOptions<'a> { domain: Domain<3>, seed: u64, given: Given<'a, 3> });

/// Samples of several classes in a cuboid, as [`Classes`] says: sorted by class, which [`Points::classes`] names.
///
/// Two samples of classes i and j are at least r_ij apart, in `f64` from the returned floats, around the torus on a periodic
/// domain. For each class i every point of the domain is within r_ij of a sample of some class j or within its clearance of a given
/// one, up to 7 float spacings at the domain's largest coordinate.
///
/// Classes of larger own radii come first, and the first, if no other has the same own radius, has the density that it would have
/// alone. Classes of equal own radii get about equal shares. A single class without given samples has not the samples of
/// [`volume::sample`](super::sample).
///
/// The same samples for every number of threads. O(n) time for n samples of a given number of classes, about 100 bytes for each.
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of range and for own radii below 64 float spacings (`radii`); [`Error::TooLarge`]
/// above 2^32 samples or the available memory, both before any work; [`Error::Cancelled`].
pub fn sample_classes(
    context: &Context,
    options: &ClassesOptions,
    classes: &Classes,
    progress: Option<&Progress>,
) -> Result<Points<3>> {
    let &ClassesOptions { domain, seed, given } = options;
    domain.check()?;
    given.check_classes(classes.count())?;
    let finest = finest_radius(float_spacing(domain.min.iter().chain(&domain.max)));
    let each: Vec<f64> =
        (0..classes.count()).map(|class| expected_samples(&domain, None, classes.own(class))).collect();
    let expected: f64 = each.iter().sum();
    if let Some(class) = (0..classes.count()).find(|&class| classes.own(class) < finest) {
        let reason = format!("[{class}][{class}] is {:?}, below 64 float spacings, {finest:?}", classes.own(class));
        return Err(Error::invalid("radii", reason));
    }
    if expected > f64::from(u32::MAX) {
        let reason =
            format!("they ask for about {expected:.2e} samples, above the limit of {:.2e}", f64::from(u32::MAX));
        return Err(Error::too_large("radii", reason));
    }
    require(context, expected, bytes(classes, &each) / expected, &given, BYTES_AROUND, "radii")?;
    let lattice = Lattice::of_any_size(&domain, finest)?;
    let ground = Ground { domain, lattice: &lattice, classes, given, seed };
    let samples = context.run(progress, |job| ground.fill(job, &each))?;
    let of_class = |(class, of_one): (u32, &Vec<Sample>)| vec![class; of_one.len()];
    Ok(Points {
        classes: (0..).zip(&samples).flat_map(of_class).collect(),
        ..Points::from(samples.iter().flatten().map(|sample| lattice.position(sample.point)).collect::<Vec<_>>())
    })
}

/// The most memory while a class is filled, for about so many samples of each.
fn bytes(classes: &Classes, expected: &[f64]) -> f64 {
    let of_class = |class: usize| {
        let is_before = |&other: &usize| {
            other != class && classes.own(other) >= classes.own(class) && classes.radius(class, other) > 0.0
        };
        let others: f64 = (0..classes.count()).filter(is_before).map(|other| expected[other]).sum();
        BYTES_PER_OTHER * others + BYTES_PER_OWN * expected[class]
    };
    let all: f64 = expected.iter().sum();
    (0..classes.count()).map(of_class).fold(BYTES_PER_MADE * all, f64::max)
}

/// The ground of all classes.
struct Ground<'a> {
    domain: Domain<3>,
    /// Of any radius.
    lattice: &'a Lattice<3>,
    classes: &'a Classes,
    given: Given<'a, 3>,
    seed: u64,
}

impl Ground<'_> {
    /// The samples of each class, of about so many.
    fn fill(&self, job: &Job, expected: &[f64]) -> Result<Vec<Vec<Sample>>> {
        let mut samples = vec![Vec::new(); self.classes.count()];
        let (mut done, whole) = (0.0, expected.iter().sum::<f64>());
        for group in self.classes.groups() {
            let levels = if group.len() > 1 { TURNS } else { ALONE };
            for (level, &scale) in levels.iter().enumerate() {
                for turn in 0..group.len() {
                    let class = group[(turn + level) % group.len()];
                    let next = done + expected[class] / whole / levels.len() as f64;
                    let added = self.added(&job.part(done, next), class, scale, level, &samples)?;
                    samples[class].extend(added);
                    done = next;
                }
            }
        }
        Ok(samples)
    }

    /// The samples that fill the domain at a level of a class.
    fn added(&self, job: &Job, class: usize, scale: f64, level: usize, samples: &[Vec<Sample>]) -> Result<Vec<Sample>> {
        let lattice = self.lattice.with_radius(scale * self.classes.own(class));
        let (positions, clearances) = self.others(class, samples);
        let given = Given::with_clearances(&positions, &clearances);
        let given = GivenDisks::new(&self.domain, &lattice, self.classes.own(class), &given);
        let space = Space { lattice: &lattice, given: &given, solid: None };
        let seed = hash(self.seed, Draw::Group, &[class as u64, level as u64]);
        let options = LevelOptions { seed, throws_first: level == 0, largest_rank: None };
        Set::added(job, space, options, &samples[class])
    }

    /// Given samples and those of other classes, with their clearances from a class.
    fn others(&self, class: usize, samples: &[Vec<Sample>]) -> (Vec<[f32; 3]>, Vec<f64>) {
        let (count, own) = (self.classes.count(), self.classes.own(class));
        let mut positions = self.given.positions.to_vec();
        let mut clearances =
            self.given.clearances_of_class(class, count).unwrap_or_else(|| vec![own; self.given.positions.len()]);
        for (other, samples) in samples.iter().enumerate() {
            let radius = self.classes.radius(class, other);
            if other != class && radius > 0.0 {
                positions.extend(samples.iter().map(|sample| self.lattice.position(sample.point)));
                clearances.extend(std::iter::repeat_n(radius, samples.len()));
            }
        }
        (positions, clearances)
    }
}
