//! A plane that is kept: what all of its windows need is made once.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::order::Order;
use crate::plane::CellAxis;
use crate::plane::lattice::{self, Lattice};
use crate::points::{Boundary, Domain};
use crate::{maximal, memory};

use crate::kdrt::around::Around;
use crate::kdrt::options::{Options, check_ladder, check_leaf_size};
use crate::kdrt::progressive::{Progressive, Ranked};
use crate::kdrt::sample::{BYTES_PER_SAMPLE, PATTERN_SHARE};
use crate::kdrt::tiling::Tiling;

/// The fewest samples, of some 16 MB, that memory is asked for: to ask takes as long as to make a small window.
const FEWEST_REFUSED: f64 = 1e6;

/// A maximal Poisson-disk set of a rectangle, of which any window can be made at any time: the set of
/// [`sample`](super::sample) with the same options. The pattern and all tables are made once, so that a window costs
/// its samples and those around it.
///
/// Windows may be made by any number of threads at once; nothing is changed by them, and no thread is kept.
///
/// Memory: 32 bytes per sample of the pattern, about 0.9 MB with leaves of the default size, and 1 byte per radius of
/// the domain's sides. The domain may have any number of samples that floats can carry: up to about 10^11 around the
/// origin. One that is not tiled (see [`sample`](super::sample)) is made as a whole and kept, in 8 bytes per sample. Of
/// a progressive order also 16 KB per level, and the levels that have up to 65,536 samples in the whole domain, in 16
/// bytes per sample. Given samples are copied, in 40 bytes each, and a window costs those near it.
pub struct Plane {
    domain: Domain,
    radius: f64,
    kept: Kept,
}

/// What windows are made of.
enum Kept {
    Tiling(Box<Tiling>),
    Whole(Whole),
    Progressive(Box<Progressive>),
}

impl Plane {
    /// A plane, on the threads of `context`, which it does not need afterwards.
    ///
    /// O(pattern) in time; where the domain is not tiled O(n) for all of its n samples.
    ///
    /// # Errors
    /// Those of [`sample`](super::sample), but limits of the number of samples only where the domain is not tiled.
    pub fn new(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Self> {
        let lattice = lattice_of(options)?;
        context.run(progress, |job| {
            let mut plane = Self::on_lattice(job, lattice, options)?;
            if let Kept::Progressive(levels) = &mut plane.kept {
                levels.keep(&job.part(PATTERN_SHARE, 1.0))?;
            }
            Ok(plane)
        })
    }

    /// [`Plane::new`] on the lattice of the options.
    pub(super) fn on_lattice(job: &Job, lattice: Lattice, options: &Options) -> Result<Self> {
        let &Options { radius, domain, leaf_size, seed, order, given, .. } = options;
        let around = Arc::new(Around::new(&domain, &lattice, radius, &given));
        let kept = if order == Order::Progressive {
            Kept::Progressive(Box::new(Progressive::new(&job.part(0.0, PATTERN_SHARE), options)?))
        } else if Tiling::is_worthwhile(&lattice, leaf_size) {
            Kept::Tiling(Box::new(Tiling::new(job, lattice, leaf_size, seed, around)?))
        } else {
            Kept::Whole(Whole::new(job, lattice, seed, &around)?)
        };
        Ok(Self { domain, radius, kept })
    }

    /// The samples of the plane that lie in `window_min <= x < window_max`, on the calling thread: the same floats in
    /// the same order as [`sample_window`](super::sample_window) and the whole set have them.
    ///
    /// O(n) in time and memory for the n samples of the window and those within about 20 radii of it; in progressive
    /// order also, for each level, those within about 145 of its radii (see [`Options::quotient`]).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `window_min` and `window_max` if the window is empty or reaches beyond the
    /// domain; [`Error::TooLarge`] above 2^32 samples or the available memory.
    pub fn window(&self, window_min: [f64; 2], window_max: [f64; 2]) -> Result<Vec<[f32; 2]>> {
        self.window_ranked(window_min, window_max).map(|ranked| ranked.samples)
    }

    /// [`Plane::window`] with the ranks of its samples, if the plane has a progressive order: those that they have in
    /// the whole set.
    ///
    /// # Errors
    /// Those of [`Plane::window`].
    pub fn window_ranked(&self, window_min: [f64; 2], window_max: [f64; 2]) -> Result<Ranked> {
        let window = part(&self.domain, self.radius, window_min, window_max)?;
        Context::new(1)?.run(None, |job| self.window_on(job, &window))
    }

    /// A part of the domain.
    pub(super) fn window_on(&self, job: &Job, window: &Domain) -> Result<Ranked> {
        match &self.kept {
            Kept::Tiling(tiling) => tiling.part(job, window).map(Ranked::in_any_order),
            Kept::Whole(whole) => Ok(Ranked::in_any_order(whole.part(window))),
            Kept::Progressive(levels) => levels.window(job, window),
        }
    }

    /// Hands all samples to `visit`, part by part.
    pub(super) fn stream(&self, job: &Job, mut visit: impl FnMut(&[[f32; 2]]) -> ControlFlow<()>) -> Result<()> {
        let mut visit = |samples: &[[f32; 2]]| {
            if samples.is_empty() || visit(samples).is_continue() { Ok(()) } else { Err(Error::Cancelled) }
        };
        match &self.kept {
            Kept::Tiling(tiling) => {
                let windows = tiling.windows();
                job.stream(windows.len(), |i| tiling.window(&windows[i]), |samples| visit(&samples))
            }
            Kept::Whole(whole) => visit(&whole.samples),
            Kept::Progressive(levels) => visit(&levels.whole(job)?.samples),
        }
    }
}

/// The lattice of a plane whose samples are not held, if its options are right.
pub(super) fn lattice_of(options: &Options) -> Result<Lattice> {
    let &Options { radius, domain, leaf_size, order, quotient, coarsest, given, .. } = options;
    check_leaf_size(leaf_size)?;
    given.check()?;
    let lattice = Lattice::of_any_size(&domain, radius)?;
    if order == Order::Progressive {
        check_ladder(quotient, coarsest, radius)?;
    } else if !Tiling::is_worthwhile(&lattice, leaf_size) {
        lattice::estimate(domain.extent(), radius)?;
    }
    Ok(lattice)
}

/// The part of a domain between two corners, if its samples can be held. It is bounded.
pub(super) fn part(domain: &Domain, radius: f64, min: [f64; 2], max: [f64; 2]) -> Result<Domain> {
    let window = window_of(domain, min, max)?;
    let expected = lattice::estimate(window.extent(), radius)?;
    if expected >= FEWEST_REFUSED {
        memory::require(expected * BYTES_PER_SAMPLE, "radius", &format!("about {expected:.0} samples"))?;
    }
    Ok(window)
}

/// The part of a domain between two corners. It is bounded.
pub(super) fn window_of(domain: &Domain, min: [f64; 2], max: [f64; 2]) -> Result<Domain> {
    domain.check()?;
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

/// A domain that is not tiled.
struct Whole {
    lattice: Lattice,
    /// The rows of cells that the samples come in, from left to right in each.
    rows: CellAxis,
    samples: Vec<[f32; 2]>,
}

impl Whole {
    fn new(job: &Job, lattice: Lattice, seed: u64, around: &Around) -> Result<Self> {
        let disks = around.near(&lattice.rect());
        let samples = maximal::sample_lattice_around(job, &lattice, seed, disks)?;
        Ok(Self { rows: CellAxis::new(lattice.size[1], lattice.radius), lattice, samples })
    }

    /// The samples in a part of the domain: in O(log n) for each row and O(1) for each sample.
    fn part(&self, window: &Domain) -> Vec<[f32; 2]> {
        let points = self.lattice.points_in(window);
        let mut inside = Vec::new();
        if points.is_empty() {
            return inside;
        }
        let row_of = |sample: [f32; 2]| self.rows.cell(self.lattice.point(sample)[1]);
        for row in self.rows.cell(points.min[1])..=self.rows.cell(points.max[1] - 1) {
            let is_before = |&sample: &[f32; 2]| (row_of(sample), f64::from(sample[0])) < (row, window.min[0]);
            let rest = &self.samples[self.samples.partition_point(is_before)..];
            let run = rest.iter().take_while(|sample| f64::from(sample[0]) < window.max[0] && row_of(**sample) == row);
            inside.extend(run.filter(|sample| window.contains(**sample)));
        }
        inside
    }
}
