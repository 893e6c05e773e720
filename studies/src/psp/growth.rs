//! How a set grows with time: its density, and what it leaves uncovered (thesis fig. 3.8, 3.12 and 3.13).

use azulejo::analysis::coverage::surface_uncovered_fraction;
use azulejo::psp::{Options, Priority, Psp};
use azulejo::{Context, Progress, Result};

use super::Effort;
use super::scenes::{Scene, radius};

/// A set in the making.
#[derive(Clone, Copy)]
pub struct Moment {
    pub iterations: u32,
    /// Time so far, without that of measuring.
    pub seconds: f64,
    pub samples: f64,
    /// The square root of the samples over those of the reference: the thesis's relative radius.
    pub rho: f64,
    /// The part of the surface that is left uncovered.
    pub uncovered: f64,
}

/// The growth of sets on one scene.
pub struct Growth {
    /// The set that is only filled.
    pub reference: Moment,
    /// Iterations alone, by squareness and by projector, at the marks of the effort.
    pub iterated: [Vec<Moment>; 2],
    /// One iteration by squareness, then filled.
    pub filled: Moment,
}

impl Growth {
    pub fn measure(context: &Context, scene: &Scene, effort: &Effort, progress: &Progress) -> Result<Self> {
        let measure = Measure { context, scene, effort };
        let reference = measure.filled(0, None)?;
        let by_priority = |priority| measure.iterated(priority, reference.samples);
        let by_squareness = by_priority(Priority::Squareness)?;
        _ = progress(0.5);
        let iterated = [by_squareness, by_priority(Priority::Projector)?];
        Ok(Self { reference, iterated, filled: measure.filled(1, Some(reference.samples))? })
    }
}

struct Measure<'a> {
    context: &'a Context,
    scene: &'a Scene,
    effort: &'a Effort,
}

impl Measure<'_> {
    fn empty(&self, priority: Priority) -> Result<Psp> {
        Psp::new(&self.scene.mesh, &Options::new(self.radius()).priority(priority))
    }

    fn radius(&self) -> f64 {
        radius(&self.scene.mesh, self.effort.growth)
    }

    fn moment(&self, psp: &Psp, iterations: u32, seconds: f64, reference: Option<f64>) -> Result<Moment> {
        let (samples, positions) = (psp.len() as f64, psp.samples().positions);
        let (mesh, radius, probes) = (&self.scene.mesh, self.radius(), self.effort.probes);
        let uncovered = surface_uncovered_fraction(self.context, mesh, &positions, radius, probes, 1, None)?;
        let rho = (samples / reference.unwrap_or(samples)).sqrt();
        Ok(Moment { iterations, seconds, samples, rho, uncovered })
    }

    fn filled(&self, iterations: u32, reference: Option<f64>) -> Result<Moment> {
        let mut psp = self.empty(Priority::Squareness)?;
        let seconds = psp.advance(self.context, iterations, None)?.seconds + psp.fill(self.context, None)?.seconds;
        self.moment(&psp, iterations, seconds, reference)
    }

    fn iterated(&self, priority: Priority, reference: f64) -> Result<Vec<Moment>> {
        let mut psp = self.empty(priority)?;
        let (mut done, mut seconds) = (0, 0.0);
        let mark = |&mark: &u32| {
            seconds += psp.advance(self.context, mark - done, None)?.seconds;
            done = mark;
            self.moment(&psp, mark, seconds, Some(reference))
        };
        self.effort.marks.iter().map(mark).collect()
    }
}
