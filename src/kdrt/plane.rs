//! Planes: sets of which any part can be made at any time. Data shared by all parts are made once.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::classes::Classes;
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::kdrt::{
    classes::{self, Group},
    options::{Kind, Options, Progressive, check_leaf_size},
    progressive::{self, Level},
    relative::RelativeWindow,
    stack::{BYTES_PER_SAMPLE, Base, PATTERN_SHARE, Stack, require},
};
use crate::plane::{GivenDisks, Lattice, estimate};
use crate::points::{Boundary, Domain, Points, check_resolution};

/// A maximal Poisson-disk set of a rectangle, in parallel: [`Plane::new`] and [`Plane::whole`] in one call.
///
/// * Conflict-free: all distances of the returned floats are at least the radius, in `f64`, without tolerance. On a
///   torus they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than the radius + 3 float spacings at the domain's
///   largest coordinate.
/// * `domain.min <= x < domain.max`; the samples are ordered by windows of about 270 radii, in these by leaves; or are
///   in [progressive order](super::Progressive), with [ranks](Points::ranks); or by [classes](Kind::Classes).
/// * The same for every number of threads.
/// * Its only bias is at the seams: slightly more samples than an unbiased set, the fewer the larger the leaves.
///
/// O(n) for n samples, after the making of a pattern, whose side is 10 leaf sizes, but at least 108 radii and at most
/// 200 radii or 4 leaf sizes, whichever is longer: about 28,000 samples with leaves of the default size. A domain of
/// less area than the pattern, or narrower than about two of the smallest leaves (13 radii), is not tiled: it is given
/// to [`crate::maximal`]. In progressive order it takes about fifteen times as long.
///
/// # Errors
/// [`Error::InvalidArgument`] for an argument out of range or floats too coarse for the radius, [`Error::TooLarge`]
/// above 2^32 samples or the available memory, both before any work; [`Error::Cancelled`].
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Points<2>> {
    let set = Set::new(options, true)?;
    set.require_whole(options.given.positions.len())?;
    context.run(progress, |job| match &set.radii {
        Radii::One { radius, .. } => {
            let around = GivenDisks::new(&options.domain, &set.lattice, *radius, &options.given);
            let samples = Base::sample(job, &set.lattice, options.leaf_size, options.seed, around.into())?;
            Ok(set.in_any_order(samples))
        }
        _ => {
            let layers = Layers::new(&job.part(0.0, PATTERN_SHARE), &set, options)?;
            layers.whole(&job.part(PATTERN_SHARE, 1.0), &set)
        }
    })
}

/// The samples of a single window, in parallel: [`Plane::new`] and [`Plane::window`] in one call, which keeps nothing.
///
/// O(n) in time and memory for the n samples of the window and those around it, after the making of the pattern, which
/// is the same for every window: a [`Plane`] keeps it for many windows. The domain may have any number of samples that
/// floats can carry: up to about 10^11 around the origin. One that is not tiled (see [`sample`]) is made as a whole.
///
/// # Errors
/// Those of [`Plane::new`] and [`Plane::window`], arguments before any work.
pub fn sample_window(
    context: &Context,
    options: &Options,
    window_min: [f64; 2],
    window_max: [f64; 2],
    progress: Option<&Progress>,
) -> Result<Points<2>> {
    let set = Set::new(options, false)?;
    let window = set.window(window_min, window_max)?;
    context.run(progress, |job| {
        let layers = Layers::new(&job.part(0.0, PATTERN_SHARE), &set, options)?;
        layers.window(&job.part(PATTERN_SHARE, 1.0), &set, &window)
    })
}

/// A set of [`sample`], of which all or any window can be made at any time. The pattern and all tables are made once,
/// so that a window costs its samples and those around it.
///
/// Windows may be made by any number of threads at once; they change nothing, and no thread is kept.
///
/// Memory: 32 bytes per sample of the pattern, about 0.9 MB with leaves of the default size, and 1 byte per radius of
/// the domain's sides, for each radius. The domain may have any number of samples that floats can carry: up to about
/// 10^11 around the origin. One that is not tiled (see [`sample`]) is made as a whole and kept, in 8 bytes per sample.
/// A progressive order also takes 16 KB per level, and keeps the levels that have up to 65,536 samples in the whole
/// domain, in 16 bytes per sample. Given samples are copied for each class, in 40 bytes each, and a window costs those
/// near it. Groups of classes that fill a torus of less than two blocks (see [`Kind::Classes`]) are kept with those
/// before, in 12 bytes per sample. In progressive order and of several classes, what windows make is kept for those
/// after them, in at most 32 MB: see [`Plane::window`].
pub struct Plane {
    set: Set,
    layers: Layers,
}

impl Plane {
    /// A plane, on the threads of `context`, which it does not need afterwards.
    ///
    /// O(pattern) in time; O(n) for the n samples that are made as a whole.
    ///
    /// # Errors
    /// Those of [`sample`], but limits of the number of samples only where the domain is not tiled.
    pub fn new(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Self> {
        let set = Set::new(options, false)?;
        let layers = context.run(progress, |job| {
            let made = if matches!(set.radii, Radii::One { .. }) { 1.0 } else { PATTERN_SHARE };
            let mut layers = Layers::new(&job.part(0.0, made), &set, options)?;
            layers.keep(&job.part(made, 1.0))?;
            Ok(layers)
        })?;
        Ok(Self { set, layers })
    }

    /// A wide plane: of one radius in an arbitrary order, up to a million radii wide and high and more, wherever it lies.
    /// Floats cannot carry so many samples: they are only given by [`Plane::relative_window`].
    ///
    /// Its samples lie on a lattice of a [unit](Plane::unit) of 1/512 to 1/256 of the radius; no place is farther from
    /// all samples than the radius + 3 units. It has other samples than the plane of [`Plane::new`] with the same
    /// options. Time and memory are those of [`Plane::new`].
    ///
    /// # Errors
    /// Those of [`Plane::new`]; [`Error::InvalidArgument`] for a domain of more than 2^29 units a side or one that is
    /// not tiled (see [`sample`]), a progressive order, and several classes.
    pub fn wide(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Self> {
        let set = Set::wide(options)?;
        let layers = context.run(progress, |job| Layers::new(job, &set, options))?;
        Ok(Self { set, layers })
    }

    /// All samples: those of [`sample`] with the same options, in parallel.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a [wide](Plane::wide) plane; [`Error::TooLarge`] above 2^32 samples or the
    /// available memory; [`Error::Cancelled`].
    pub fn whole(&self, context: &Context, progress: Option<&Progress>) -> Result<Points<2>> {
        self.set.require_floats()?;
        self.set.require_whole(0)?;
        context.run(progress, |job| self.layers.whole(job, &self.set))
    }

    /// The samples that lie in `window_min <= x < window_max`, on the calling thread: the same floats in the same order
    /// as in the whole set, with their ranks or classes.
    ///
    /// So windows that partition the domain hold each sample once, and a window is made without the others. It may be
    /// of any size, even smaller than the radius, and may have no sample. On a torus it lies in one period, as samples
    /// do.
    ///
    /// # The surroundings of a window
    /// Beyond its options a window depends only on its surroundings, as tiled: the existence and position of a sample
    /// are decided by the leaves' points within 22 radii along x and 18 along y. These are its fill block with two more
    /// along x and one along y, for the phases of filling, and 5 radii for the chains of elimination. In progressive
    /// order every level adds about 12 of its radii: see [`Progressive`](super::Progressive). Each group of classes of
    /// equal own radii adds about 30 times the largest distance within it, and one to the groups before.
    ///
    /// O(n) in time and memory for the n samples of the window and its surroundings. In progressive order and of several
    /// classes these are wide, but made once: the plane keeps them, as far as they fit into 32 MB, so that the first
    /// window in a region is slow, and windows near those before are fast. The samples do not depend on what is kept.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `window_min` and `window_max` if the window is empty or reaches beyond the
    /// domain, and for a [wide](Plane::wide) plane; [`Error::TooLarge`] above 2^32 samples or the available memory.
    pub fn window(&self, window_min: [f64; 2], window_max: [f64; 2]) -> Result<Points<2>> {
        self.set.require_floats()?;
        let window = self.set.window(window_min, window_max)?;
        Context::new(1)?.run(None, |job| self.layers.window(job, &self.set, &window))
    }

    /// The samples of a window with positions relative to its lower corner, on the calling thread, with their ranks or
    /// classes. On a torus, whose images fill the plane without end, the window lies anywhere and may cross seams: up to
    /// 2^32 periods away, at most a period wide and high.
    ///
    /// A sample lies in the window if `window_min <= x < window_max`, in exact numbers, of one of its images. Windows that
    /// share an edge, given by the same number, share no sample and lose none. In progressive order samples are sorted
    /// as in [`Plane::window`], without classes and levels they are in an arbitrary order.
    ///
    /// Positions are the differences to `window_min`, rounded down to floats: at least 0, and at most the extent. They are
    /// exact, and so at least the radius apart, if `window_min` is a multiple of the plane's [unit](Plane::unit) and the
    /// window is less than 2^24 units wide and high. In other windows two samples may be closer than the radius by the
    /// float spacing at the window's extent. Periods are those of the domain, `max - min`; a corner many periods away is
    /// reduced into the first one in `f64`.
    ///
    /// Time and memory are those of [`Plane::window`].
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `window_min` and `window_max`; [`Error::TooLarge`] as [`Plane::window`].
    pub fn relative_window(&self, window_min: [f64; 2], window_max: [f64; 2]) -> Result<Points<2>> {
        let Set { domain, lattice, .. } = &self.set;
        let window = RelativeWindow::new(domain, lattice, window_min, window_max)?;
        self.set.require([0, 1].map(|axis| window_max[axis] - window_min[axis]))?;
        Context::new(1)?.run(None, |job| self.layers.relative(job, &self.set, &window))
    }

    /// True if samples have ranks.
    pub fn has_ranks(&self) -> bool {
        matches!(self.set.radii, Radii::Progressive { .. } | Radii::Classes(_, Some(_)))
    }

    /// True if samples have classes.
    pub fn has_classes(&self) -> bool {
        matches!(self.set.radii, Radii::One { is_class: true, .. } | Radii::Classes(..))
    }

    /// The spacing of the lattice that all samples lie on: a power of two, the float spacing at the largest coordinate of
    /// the domain; of a [wide](Plane::wide) plane 1/512 to 1/256 of the radius. In the units of the domain.
    pub fn unit(&self) -> f64 {
        self.set.lattice.unit()
    }

    /// The most samples that any window of an extent can have, for arrays that are allocated once.
    ///
    /// Of samples at least r apart, a rectangle holds at most 2/sqrt(3) · w h / r² + (w + h) / r + 1 (Oler 1961), about
    /// 1.66 times as many as it has on average if it is large; of several classes the sum of these.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an `extent` that is not finite and above 0; [`Error::TooLarge`] for more than
    /// about 2^32 samples.
    pub fn most_samples(&self, extent: [f64; 2]) -> Result<usize> {
        for (axis, side) in extent.into_iter().enumerate() {
            if !(side > 0.0 && side.is_finite()) {
                return Err(Error::invalid("extent", format!("[{axis}] is {side}, not above 0 and finite")));
            }
        }
        let [width, height] = extent;
        let radii = match &self.set.radii {
            Radii::One { radius, .. } | Radii::Progressive { radius, .. } => vec![*radius],
            Radii::Classes(classes, _) => (0..classes.count()).map(|class| classes.own(class)).collect(),
        };
        // The largest numbers are not cast before they are refused; the factor covers rounding.
        let most = |radius: f64| (most_within([width / radius, height / radius]) * (1.0 + 1e-12)).floor();
        let most: f64 = radii.into_iter().map(most).sum();
        if most > f64::from(u32::MAX) {
            return Err(Error::too_large("extent", format!("{width} by {height} may have {most:.2e} samples")));
        }
        Ok(most as usize)
    }

    /// Passes all samples to `visit`, in the order of [`Plane::whole`], part by part, for sets that cannot or need not
    /// be held.
    ///
    /// The parts are windows of at most about 270 radii, 50,000 samples, and never empty. `visit` is called on the
    /// calling thread and may use the library; meanwhile the threads of the context make the next parts. The parts and
    /// their order depend on the options only. `Break` ends the call with [`Error::Cancelled`].
    ///
    /// Memory: at most 8 parts per thread, however many samples there are. A domain that is not tiled (see [`sample`])
    /// is one part.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a progressive order and for several classes, which do not come place by place, and
    /// for a [wide](Plane::wide) plane; [`Error::Cancelled`].
    pub fn stream(
        &self,
        context: &Context,
        visit: impl FnMut(&[[f32; 2]]) -> ControlFlow<()>,
        progress: Option<&Progress>,
    ) -> Result<()> {
        self.set.require_floats()?;
        match &self.layers {
            Layers::None(base) => context.run(progress, |job| base.stream(job, visit)),
            Layers::Progressive(..) => {
                Err(Error::invalid("order", "a stream comes place by place, in no progressive order"))
            }
            Layers::Classes(..) => Err(Error::invalid("classes", "a stream comes place by place, not class by class")),
        }
    }
}

/// A set that is not made yet: validated options, without given samples.
struct Set {
    domain: Domain,
    /// The lattice; of a set of several classes with an arbitrary radius, else with that of the set.
    lattice: Lattice,
    radii: Radii,
    /// True if lattice points are not floats.
    is_wide: bool,
}

/// The radii of a set.
enum Radii {
    /// One radius in an arbitrary order; `is_class` is true for the set of a single class.
    One {
        radius: f64,
        is_class: bool,
    },
    Progressive {
        radius: f64,
        levels: Progressive,
    },
    /// Several classes, which may be in progressive order.
    Classes(Classes, Option<Progressive>),
}

impl Set {
    /// Checks everything but the memory for the samples; their number too if all are to be held.
    fn new(options: &Options, is_held: bool) -> Result<Self> {
        let &Options { kind, domain, leaf_size, given, .. } = options;
        check_leaf_size(leaf_size)?;
        let lattice_of =
            |radius| if is_held { Lattice::new(&domain, radius) } else { Lattice::of_any_size(&domain, radius) };
        let (lattice, radii) = match kind {
            Kind::Plain(radius) => (lattice_of(radius)?, Radii::One { radius, is_class: false }),
            Kind::Progressive(radius, levels) => (lattice_of(radius)?, Radii::Progressive { radius, levels }),
            Kind::Classes(classes) | Kind::ProgressiveClasses(classes, _) => {
                let levels = if let Kind::ProgressiveClasses(_, levels) = kind { Some(levels) } else { None };
                given.check_classes(classes.count())?;
                let smallest = (0..classes.count()).map(|class| classes.own(class)).fold(f64::INFINITY, f64::min);
                // Floats of any spacing can represent the longest radius.
                let lattice = Lattice::of_any_size(&domain, f64::MAX)?;
                check_resolution("radii", smallest, lattice.unit(), "the domain's largest coordinate")?;
                match (classes.count(), levels) {
                    (1, None) => (lattice_of(smallest)?, Radii::One { radius: smallest, is_class: true }),
                    _ => (lattice, Radii::Classes(classes.clone(), levels)),
                }
            }
        };
        match &radii {
            Radii::One { radius, .. } => {
                given.check()?;
                if !Base::is_tiled(&lattice, leaf_size) {
                    estimate(domain.extent(), *radius)?;
                }
            }
            Radii::Progressive { radius, levels } => {
                given.check()?;
                levels.check(*radius)?;
            }
            Radii::Classes(classes, levels) => {
                let largest = (0..classes.count()).map(|class| classes.own(class)).fold(0.0, f64::max);
                levels.as_ref().map_or(Ok(()), |levels| levels.check(largest))?;
            }
        }
        Ok(Self { domain, lattice, radii, is_wide: false })
    }

    /// A set whose lattice follows from its radius.
    fn wide(options: &Options) -> Result<Self> {
        let &Options { kind, domain, leaf_size, given, .. } = options;
        check_leaf_size(leaf_size)?;
        given.check()?;
        let radius = match kind {
            Kind::Plain(radius) => radius,
            Kind::Progressive(..) => return Err(Error::invalid("order", "a wide plane is in no progressive order")),
            Kind::Classes(..) | Kind::ProgressiveClasses(..) => {
                return Err(Error::invalid("classes", "a wide plane has one radius"));
            }
        };
        let lattice = Lattice::of_radius(&domain, radius)?;
        if !Base::is_tiled(&lattice, leaf_size) {
            let [width, height] = domain.extent();
            let reason = format!("{width} by {height} is not tiled with radius {radius:?}: such a plane is not wide");
            return Err(Error::invalid("domain_max", reason));
        }
        Ok(Self { domain, lattice, radii: Radii::One { radius, is_class: false }, is_wide: true })
    }

    /// Refuses to give absolute positions that are no floats.
    fn require_floats(&self) -> Result<()> {
        if !self.is_wide {
            return Ok(());
        }
        Err(Error::invalid("plane", "is wide: floats cannot carry its samples, only relative windows have them"))
    }

    /// Refuses all samples of a domain that cannot be held, beside so many given ones.
    fn require_whole(&self, given: usize) -> Result<()> {
        let extent = self.domain.extent();
        match &self.radii {
            Radii::One { radius, .. } => require(estimate(extent, *radius)?, BYTES_PER_SAMPLE, given, "radius"),
            Radii::Progressive { radius, .. } => {
                estimate(extent, *radius)?;
                require(self.lattice.expected_samples(), progressive::BYTES_PER_SAMPLE, given, "radius")
            }
            Radii::Classes(classes, levels) => require_classes(classes, levels.is_some(), extent, given),
        }
    }

    /// The part of the domain between two corners, if its samples can be held. It is bounded.
    fn window(&self, min: [f64; 2], max: [f64; 2]) -> Result<Domain> {
        let window = window_of(&self.domain, min, max)?;
        self.require(window.extent())?;
        Ok(window)
    }

    /// Refuses a window whose samples cannot be held.
    fn require(&self, extent: [f64; 2]) -> Result<()> {
        match &self.radii {
            Radii::One { radius, .. } => require(estimate(extent, *radius)?, BYTES_PER_SAMPLE, 0, "radius"),
            Radii::Progressive { radius, .. } => {
                require(estimate(extent, *radius)?, progressive::BYTES_PER_SAMPLE, 0, "radius")
            }
            Radii::Classes(classes, levels) => require_classes(classes, levels.is_some(), extent, 0),
        }
    }

    /// Samples of one radius.
    fn in_any_order(&self, samples: Vec<[f32; 2]>) -> Points<2> {
        let has_classes = matches!(self.radii, Radii::One { is_class: true, .. });
        let classes = if has_classes { vec![0; samples.len()] } else { Vec::new() };
        Points { classes, ..samples.into() }
    }
}

/// The most points at distances of at least 1 in a rectangle, by Oler's inequality (1961).
fn most_within([width, height]: [f64; 2]) -> f64 {
    2.0 / 3f64.sqrt() * width * height + width + height + 1.0
}

/// The most bytes for each sample that the classes would have alone; with ranks.
const BYTES_PER_CLASS_SAMPLE: f64 = 52.0;
const BYTES_PER_RANKED_SAMPLE: f64 = 53.0;

/// Refuses more samples of several classes in a rectangle than can be held beside given ones.
fn require_classes(classes: &Classes, is_ranked: bool, extent: [f64; 2], given: usize) -> Result<()> {
    let samples = (0..classes.count()).map(|class| estimate(extent, classes.own(class))).sum::<Result<f64>>()?;
    require(samples, if is_ranked { BYTES_PER_RANKED_SAMPLE } else { BYTES_PER_CLASS_SAMPLE }, given, "radii")
}

/// The part of a domain between two corners. It is bounded.
fn window_of(domain: &Domain, min: [f64; 2], max: [f64; 2]) -> Result<Domain> {
    for axis in 0..2 {
        let (from, to) = (domain.min[axis], domain.max[axis]);
        for (argument, x) in [("window_min", min[axis]), ("window_max", max[axis])] {
            if !(from..=to).contains(&x) {
                return Err(Error::invalid(argument, format!("[{axis}] is {x}, outside the domain {from} to {to}")));
            }
        }
        if min[axis] >= max[axis] {
            let reason = format!("[{axis}] is {}, not above window_min {}", max[axis], min[axis]);
            return Err(Error::invalid("window_max", reason));
        }
    }
    Ok(Domain { min, max, boundary: Boundary::Bounded })
}

/// The layers that the parts of a set are made of.
enum Layers {
    /// No layers: a set of one radius in an arbitrary order.
    None(Base),
    /// The levels of a progressive order, and the rank of the samples of the coarsest one.
    Progressive(Stack<Level>, f64),
    /// Groups of classes, and in progressive order the rank of each layer.
    Classes(Stack<Group>, Vec<f32>),
}

impl Layers {
    fn new(job: &Job, set: &Set, options: &Options) -> Result<Self> {
        let &Options { domain, leaf_size, seed, given, .. } = options;
        let around = |radius| Arc::new(GivenDisks::new(&domain, &set.lattice, radius, &given));
        match &set.radii {
            Radii::One { radius, .. } => {
                Ok(Self::None(Base::new(job, set.lattice.clone(), leaf_size, seed, around(*radius))?))
            }
            Radii::Progressive { radius, levels } => {
                let (stack, rank) = progressive::stack(job, options, *radius, levels, around(*radius))?;
                Ok(Self::Progressive(stack, rank))
            }
            Radii::Classes(classes, None) => {
                Ok(Self::Classes(classes::stack(job, &set.lattice, options, classes)?, Vec::new()))
            }
            Radii::Classes(classes, Some(levels)) => {
                let (stack, ranks) = classes::levels(&set.lattice, options, classes, levels);
                Ok(Self::Classes(stack, ranks))
            }
        }
    }

    /// Makes the data shared by all windows.
    fn keep(&mut self, job: &Job) -> Result<()> {
        match self {
            Self::None(_) => Ok(()),
            Self::Progressive(stack, _) => stack.keep(job),
            Self::Classes(stack, _) => stack.keep(job),
        }
    }

    /// All samples.
    fn whole(&self, job: &Job, set: &Set) -> Result<Points<2>> {
        let position = |point| set.lattice.position(point);
        match self {
            Self::None(base) => Ok(set.in_any_order(base.whole(job)?)),
            Self::Progressive(stack, rank) => {
                Ok(progressive::ordered(stack.lattice(), *rank, stack.whole(job)?, position))
            }
            Self::Classes(stack, ranks) => Ok(classes::ordered(ranks, stack.whole(job)?, position)),
        }
    }

    /// The samples in a window.
    fn window(&self, job: &Job, set: &Set, window: &Domain) -> Result<Points<2>> {
        let position = |point| set.lattice.position(point);
        match self {
            Self::None(base) => Ok(set.in_any_order(base.window(job, window)?)),
            Self::Progressive(stack, rank) => {
                Ok(progressive::ordered(stack.lattice(), *rank, stack.window(job, window)?, position))
            }
            Self::Classes(stack, ranks) => Ok(classes::ordered(ranks, stack.window(job, window)?, position)),
        }
    }

    /// The samples in a window, seen from its corner.
    fn relative(&self, job: &Job, set: &Set, window: &RelativeWindow) -> Result<Points<2>> {
        let position = |point| window.position(&set.lattice, point);
        match self {
            Self::None(base) => {
                let points = base.images(job, &set.lattice, &window.rect)?;
                Ok(set.in_any_order(points.into_iter().map(position).collect()))
            }
            Self::Progressive(stack, rank) => {
                Ok(progressive::ordered(stack.lattice(), *rank, stack.points(job, &window.rect)?, position))
            }
            Self::Classes(stack, ranks) => Ok(classes::ordered(ranks, stack.points(job, &window.rect)?, position)),
        }
    }
}
