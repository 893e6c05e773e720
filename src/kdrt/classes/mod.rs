//! Several classes of samples in one plane (Wei 2010; future work in thesis §3.4.6 and ch. 5).
//!
//! Classes come by falling own radius; those of equal radii are a *group*, and are filled together at equal rates. Each
//! group fills what the samples of the groups before, given samples and its own samples leave it (`group.rs`), each of
//! them a circle of the distance between the two classes (`room.rs`). If the first group is one class, and the domain
//! is worth tiling, it is a set of KDRT.
//!
//! # Why no class can take another sample
//! A group ends when for each of its classes every lattice point lies in a circle. Later groups only add circles.
//!
//! # Parts
//! All classes lie on one lattice, and each group is made by blocks: a part of a group depends on the groups before in
//! a part that is larger by a margin. So a part of the plane is made from the last group back to the first, to find
//! what of each is needed, and then forth, as the levels of a progressive order are.

mod group;
mod passes;
mod plane;
mod room;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

use crate::classes::Classes;
use crate::error::{Error, Result};
use crate::given::Given;
use crate::job::{Context, Job, Progress};
use crate::order::Order;
use crate::plane::lattice::{Lattice, estimate};
use crate::points::{Domain, check_resolution};

use crate::kdrt::around::Around;
use crate::kdrt::options::{Options, check_leaf_size};
use crate::kdrt::progressive::require_memory;
use crate::kdrt::region::{Part, Region};
use crate::kdrt::sample::{PATTERN_SHARE, sample as sample_one};
use crate::kdrt::tiling::Tiling;
use group::{Group, Sample};
pub use plane::ClassPlane;

/// How much faster than the filling of a group its samples come by tiling.
const TILING_SPEED: f64 = 10.0;

/// Samples of several classes.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Classified {
    /// The samples.
    pub samples: Vec<[f32; 2]>,
    /// The class of each sample: its row in the matrix of [`Classes`].
    pub classes: Vec<u32>,
}

/// Samples of several classes in a rectangle, in parallel.
///
/// * Conflict-free: samples of classes i and j are at least [`Classes::radius`]`(i, j)` apart, in `f64` from the
///   returned floats, without tolerance. On a torus distances wrap.
/// * Maximal: for each class i every point of the domain is within `radius(i, j)` + 3 float spacings of some sample of
///   some class j; spacings are those at the domain's largest coordinate.
/// * Sorted by class; those of a class by y, and by x where y is the same. A single class has the set and the order of
///   [`sample`](super::sample).
/// * The same for every number of threads.
///
/// Classes of larger own radii come first and have the density that they have alone; the others fill what these leave
/// them. Classes of equal own radii are filled together, by darts of equal rates, and get equal shares. So two radii
/// that are nearly equal give other shares than two equal ones. What is not tiled is up to 0.5 % denser than by darts
/// one after the other.
///
/// [`Options::radius`] must be 0, and the order any. The [clearances](Given::clearances) of given samples have a row
/// for each of them, with a number for each class; without, each class keeps its own radius from them. Places within them
/// need no sample, up to 6 float spacings.
///
/// O(n) for n samples and a given number of classes. A torus that is narrower than two fill blocks, about 10 times the
/// largest distance between classes of equal own radii, is filled by one thread.
///
/// # Errors
/// [`Error::InvalidArgument`] for an argument out of range or floats too coarse for an own radius,
/// [`Error::TooLarge`] above 2^32 samples or the available memory, both before any work; [`Error::Cancelled`].
pub fn sample_classes(
    context: &Context,
    options: &Options,
    classes: &Classes,
    progress: Option<&Progress>,
) -> Result<Classified> {
    let lattice = lattice_of(options, classes)?;
    if classes.count() == 1 {
        let samples = sample_one(context, &options.radius(classes.own(0)), progress)?;
        return Ok(Classified { classes: vec![0; samples.len()], samples });
    }
    require_samples(classes, options.domain.extent())?;
    context.run(progress, |job| {
        let groups = Groups::new(&job.part(0.0, PATTERN_SHARE), &lattice, options, classes)?;
        groups.whole(&job.part(PATTERN_SHARE, 1.0))
    })
}

/// The lattice of a plane of several classes, if its options are right.
fn lattice_of(options: &Options, classes: &Classes) -> Result<Lattice> {
    let &Options { radius, domain, leaf_size, order, given, .. } = options;
    if radius != 0.0 {
        return Err(Error::invalid("radius", format!("{radius:?} is not 0; classes have radii of their own")));
    }
    if order != Order::Any {
        return Err(Error::invalid("order", "sets of several classes have no progressive order"));
    }
    check_leaf_size(leaf_size)?;
    given.check_classes(classes.count())?;
    let smallest = (0..classes.count()).map(|class| classes.own(class)).fold(f64::INFINITY, f64::min);
    // Floats of any spacing carry the longest radius.
    let lattice = Lattice::of_any_size(&domain, f64::MAX)?;
    check_resolution("radii", smallest, lattice.unit(), "the domain's largest coordinate")?;
    Ok(lattice)
}

/// Refuses more samples in a rectangle than can be held.
fn require_samples(classes: &Classes, extent: [f64; 2]) -> Result<()> {
    let samples = (0..classes.count()).map(|class| estimate(extent, classes.own(class))).sum::<Result<f64>>()?;
    require_memory(samples, "radii")
}

/// The groups of a plane, of which any part can be made.
struct Groups {
    lattice: Lattice,
    /// The first group, if it is tiled, and its class.
    tiled: Option<(u32, Box<Tiling>)>,
    /// The groups that are not tiled.
    filled: Vec<Group>,
    /// How many of these are kept, and the samples of all groups up to them.
    kept: Option<(usize, Region<Sample>)>,
}

impl Groups {
    /// The groups of a plane on its lattice.
    fn new(job: &Job, lattice: &Lattice, options: &Options, classes: &Classes) -> Result<Self> {
        let &Options { ref domain, leaf_size, seed, given, .. } = options;
        let groups = classes.groups();
        let tiled = match groups[0][..] {
            [class] => {
                let (radius, lattice) = (classes.own(class), lattice.with_radius(classes.own(class)));
                let clearances = given.clearances_of_class(class, classes.count());
                let given = Given { positions: given.positions, clearances: clearances.as_deref() };
                let around = Around::new(domain, &lattice, radius, &given);
                let is_tiled = Tiling::is_worthwhile(&lattice, leaf_size);
                is_tiled.then(|| Tiling::new(job, lattice, leaf_size, seed, around.into())).transpose()?
            }
            _ => None,
        };
        let tiled = tiled.map(|tiling| (groups[0][0] as u32, Box::new(tiling)));
        let filled = (usize::from(tiled.is_some())..groups.len())
            .map(|number| Group::new(domain, lattice, classes, number, &given, seed));
        Ok(Self { lattice: lattice.clone(), filled: filled.collect(), tiled, kept: None })
    }

    /// Makes those groups for all windows that can only be made as a whole, with the groups before.
    fn keep(&mut self, job: &Job) -> Result<()> {
        let Some(last) = self.filled.iter().rposition(Group::is_whole) else { return Ok(()) };
        let whole = Part::whole(&self.lattice);
        let samples = self.up_to(job, last + 1, &whole)?;
        self.kept = Some((last + 1, self.filled[last].sorted(whole, &samples)));
        Ok(())
    }

    /// All samples.
    fn whole(&self, job: &Job) -> Result<Classified> {
        Ok(self.classified(self.up_to(job, self.filled.len(), &Part::whole(&self.lattice))?))
    }

    /// The samples in a window of the domain.
    fn window(&self, job: &Job, window: &Domain) -> Result<Classified> {
        let rect = self.lattice.points_in(window);
        if rect.is_empty() {
            return Ok(Classified::default());
        }
        let mut samples = self.up_to(job, self.filled.len(), &Part::new(&self.lattice, &rect))?;
        samples.retain(|sample| window.contains(self.lattice.position(sample.point)));
        Ok(self.classified(samples))
    }

    /// The samples in a part, of the tiled group and the first `count` of the others.
    fn up_to(&self, job: &Job, count: usize, part: &Part) -> Result<Vec<Sample>> {
        // From the last group to the first, what of each is needed.
        let groups = &self.filled[self.kept.as_ref().map_or(0, |(kept, _)| *kept)..count];
        let mut parts = vec![*part];
        for group in groups.iter().rev() {
            parts.push(group.around(&parts[parts.len() - 1]));
        }
        parts.reverse();

        // From the first to the last, each in its part.
        let tiled = self.tiled.as_ref().map_or(0.0, |(_, tiling)| tiling.expected(&parts[0].rect) / TILING_SPEED);
        let costs: Vec<f64> = groups.iter().zip(&parts[1..]).map(|(group, part)| group.expected(part)).collect();
        let total = 1.0 + tiled + costs.iter().sum::<f64>();
        let mut samples = match &self.kept {
            Some((_, kept)) => kept.samples_of(&parts[0]),
            None => self.tiled_in(&job.part(0.0, tiled / total), &parts[0])?,
        };
        let mut done = tiled;
        for ((group, parts), cost) in groups.iter().zip(parts.windows(2)).zip(costs) {
            let job = job.part(done / total, (done + cost) / total);
            let before = group.sorted(parts[0], &samples);
            let filled = group.fill(&job, &before, &parts[1])?;
            samples = before.samples_of(&parts[1]);
            samples.extend(filled);
            done += cost;
        }
        Ok(samples)
    }

    /// The samples of the tiled group in a part.
    fn tiled_in(&self, job: &Job, part: &Part) -> Result<Vec<Sample>> {
        let mut samples = Vec::new();
        let Some((class, tiling)) = &self.tiled else { return Ok(samples) };
        let pieces: Vec<_> = Part::whole(&self.lattice).images(&part.rect).collect();
        for (piece, [along, up]) in pieces.into_iter().filter(|(piece, _)| !piece.is_empty()) {
            let points = tiling.points(job, &piece)?;
            samples.extend(points.into_iter().map(|[x, y]| Sample { point: [x + along, y + up], class: *class }));
        }
        Ok(samples)
    }

    /// Puts samples in order.
    fn classified(&self, mut samples: Vec<Sample>) -> Classified {
        samples.sort_unstable_by_key(|sample| (sample.class, sample.point[1], sample.point[0]));
        Classified {
            samples: samples.iter().map(|sample| self.lattice.position(sample.point)).collect(),
            classes: samples.iter().map(|sample| sample.class).collect(),
        }
    }
}
