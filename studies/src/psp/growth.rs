//! The growth of a set with time: its density, and the area that it leaves uncovered (thesis fig. 3.8, 3.12 and 3.13).

use azulejo::analysis::coverage::surface_uncovered_fraction;
use azulejo::psp::{Priority, ProjectionOptions, Projectors, Psp};
use azulejo::{Context, Progress, Result};

use super::Effort;
use super::scenes::{Scene, radius};
use crate::repeated::Repeated;

/// A set in the making.
#[derive(Clone)]
pub struct Moment {
    pub iterations: u32,
    /// Time so far in each round, without that of measuring.
    pub seconds: Repeated,
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
        let mut rounds = Vec::new();
        for round in 0..effort.rounds {
            // All rounds make the same sets: what they leave uncovered is measured once.
            let probes = if round == 0 { effort.probes } else { 0 };
            rounds.push([
                vec![measure.filled(0, probes)?],
                measure.iterated(Priority::Squareness, probes)?,
                measure.iterated(Priority::Projector, probes)?,
                vec![measure.filled(1, probes)?],
            ]);
            _ = progress((round + 1) as f64 / effort.rounds as f64);
        }
        let reference = rounds[0][0][0].samples;
        let moment = |way: usize, mark: usize| {
            let Look { iterations, samples, uncovered, .. } = rounds[0][way][mark];
            let seconds = Repeated::new(rounds.iter().map(|ways| ways[way][mark].seconds).collect());
            Moment { iterations, seconds, samples, rho: (samples / reference).sqrt(), uncovered }
        };
        let iterated = [1, 2].map(|way| (0..effort.marks.len()).map(|mark| moment(way, mark)).collect());
        Ok(Self { reference: moment(0, 0), iterated, filled: moment(3, 0) })
    }
}

/// A look at a set in one round.
struct Look {
    iterations: u32,
    seconds: f64,
    samples: f64,
    /// Not a number where it is not measured.
    uncovered: f64,
}

struct Measure<'a> {
    context: &'a Context,
    scene: &'a Scene,
    effort: &'a Effort,
}

impl Measure<'_> {
    fn empty(&self, priority: Priority) -> Result<Psp> {
        Psp::new(
            &self.scene.mesh,
            &ProjectionOptions::new(self.radius()).projectors(Projectors::Global).priority(priority),
        )
    }

    fn radius(&self) -> f64 {
        radius(&self.scene.mesh, self.effort.growth)
    }

    fn look(&self, psp: &Psp, iterations: u32, seconds: f64, probes: u64) -> Result<Look> {
        let positions = psp.samples().positions;
        let (mesh, radius, samples) = (&self.scene.mesh, self.radius(), positions.len() as f64);
        let uncovered = match probes {
            0 => f64::NAN,
            _ => surface_uncovered_fraction(self.context, mesh, &positions, radius, probes, 1, None)?,
        };
        Ok(Look { iterations, seconds, samples, uncovered })
    }

    fn filled(&self, iterations: u32, probes: u64) -> Result<Look> {
        let mut psp = self.empty(Priority::Squareness)?;
        let seconds = psp.advance(self.context, iterations, None)?.seconds + psp.fill(self.context, None)?.seconds;
        self.look(&psp, iterations, seconds, probes)
    }

    fn iterated(&self, priority: Priority, probes: u64) -> Result<Vec<Look>> {
        let mut psp = self.empty(priority)?;
        let (mut done, mut seconds) = (0, 0.0);
        let mark = |&mark: &u32| {
            seconds += psp.advance(self.context, mark - done, None)?.seconds;
            done = mark;
            self.look(&psp, mark, seconds, probes)
        };
        self.effort.marks.iter().map(mark).collect()
    }
}
