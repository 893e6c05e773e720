//! A plane of several classes that is kept: what all of its windows need is made once.

use crate::classes::Classes;
use crate::error::Result;
use crate::job::{Context, Progress};
use crate::points::Domain;

use crate::kdrt::classes::{Classified, Groups, lattice_of, require_samples};
use crate::kdrt::kept::{Plane, window_of};
use crate::kdrt::options::Options;
use crate::kdrt::sample::PATTERN_SHARE;

/// Samples of several classes in a rectangle, of which any window can be made at any time: the set of
/// [`sample_classes`](super::sample_classes) with the same options and classes.
///
/// Windows may be made by any number of threads at once; nothing is changed by them, and no thread is kept.
///
/// Memory: as a [`Plane`] for the class of the largest own radius, if no other has the same, and 1 byte per smallest
/// radius of the domain's sides. Given samples are copied for each class, in 40 bytes each. On a torus that is narrower
/// than two fill blocks of a group (see [`sample_classes`](super::sample_classes)) that group and those before are made
/// as a whole and kept, in 12 bytes per sample. The domain may have any number of samples that floats can carry.
pub struct ClassPlane {
    domain: Domain,
    classes: Classes,
    kept: Kept,
}

/// What windows are made of.
enum Kept {
    One(Box<Plane>),
    Several(Box<Groups>),
}

impl ClassPlane {
    /// A plane, on the threads of `context`, which it does not need afterwards.
    ///
    /// O(pattern) in time, and O(n) for the n samples of groups that are made as a whole.
    ///
    /// # Errors
    /// Those of [`sample_classes`](super::sample_classes), but no limit of the number of samples.
    pub fn new(context: &Context, options: &Options, classes: &Classes, progress: Option<&Progress>) -> Result<Self> {
        let lattice = lattice_of(options, classes)?;
        let kept = if classes.count() == 1 {
            Kept::One(Box::new(Plane::new(context, &options.radius(classes.own(0)), progress)?))
        } else {
            let groups = context.run(progress, |job| {
                let mut groups = Groups::new(&job.part(0.0, PATTERN_SHARE), &lattice, options, classes)?;
                groups.keep(&job.part(PATTERN_SHARE, 1.0))?;
                Ok(groups)
            })?;
            Kept::Several(Box::new(groups))
        };
        Ok(Self { domain: options.domain, classes: classes.clone(), kept })
    }

    /// The samples of the plane that lie in `window_min <= x < window_max`, on the calling thread: the same floats in
    /// the same order as the whole set has them.
    ///
    /// O(n) in time and memory for the n samples of the window and, of each group of classes of equal own radii, those
    /// within about 30 times the largest distance within the group, and one to the groups before, added up over the
    /// groups after it.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for `window_min` and `window_max` if the window is
    /// empty or reaches beyond the domain; [`Error::TooLarge`](crate::Error::TooLarge) above 2^32 samples or the available
    /// memory.
    pub fn window(&self, window_min: [f64; 2], window_max: [f64; 2]) -> Result<Classified> {
        match &self.kept {
            Kept::One(plane) => {
                let samples = plane.window(window_min, window_max)?;
                Ok(Classified { classes: vec![0; samples.len()], samples })
            }
            Kept::Several(groups) => {
                let window = window_of(&self.domain, window_min, window_max)?;
                require_samples(&self.classes, window.extent())?;
                Context::new(1)?.run(None, |job| groups.window(job, &window))
            }
        }
    }
}
