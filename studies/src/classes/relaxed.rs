//! Maximal sets of several classes after relaxation: the union and each class.

use azulejo::dcr::{self, DelaunayOptions};
use azulejo::{Boundary, Context, Domain, Progress, Result, kdrt};

use super::Effort;
use super::mixes::{MIXES, Mix};
use super::sets::ends;

/// The smallest distance and the covering radius of a set, in units of the hexagonal distance.
#[derive(Clone, Copy)]
pub struct Figures {
    pub rho: f64,
    pub covering_radius: f64,
}

/// A set of several classes.
pub struct Set {
    pub union: Figures,
    pub classes: Vec<Figures>,
}

/// A mix before and after.
pub struct Relaxed {
    pub mix: Mix,
    pub before: Set,
    pub after: Set,
    /// rho and coverage of the union's points, relaxed as one class.
    pub alone: Figures,
}

impl Set {
    /// The least and the largest of a figure of the classes.
    pub fn range(&self, value: impl Fn(&Figures) -> f64) -> [f64; 2] {
        ends(self.classes.iter().map(value))
    }
}

impl Relaxed {
    /// All mixes, with Wei's cross radii.
    pub fn all(context: &Context, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let one = |(i, mix): (usize, Mix)| {
            _ = progress(i as f64 / MIXES.len() as f64);
            Self::of(context, mix, effort)
        };
        MIXES.into_iter().enumerate().map(one).collect()
    }

    fn of(context: &Context, mix: Mix, effort: &Effort) -> Result<Self> {
        let set = kdrt::sample(context, &kdrt::Options::classes(&mix.classes(effort.count, 1.0)?), None)?;
        let domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary: Boundary::Periodic };
        let options = DelaunayOptions::new(domain);
        let relaxed = |steps: u32| -> Result<Set> {
            let options = options.max_iterations(steps);
            let (_, union, each) = dcr::relax_classes(context, &options, &set.positions, &set.classes, None)?;
            let classes = each.iter().map(|of| Figures { rho: of.rho, covering_radius: of.relative_covering_radius });
            Ok(Set {
                union: Figures { rho: union.rho, covering_radius: union.relative_covering_radius },
                classes: classes.collect(),
            })
        };
        let (_, alone) = dcr::relax(context, &options.into(), &set.positions, None)?;
        let alone = Figures { rho: alone.rho, covering_radius: alone.relative_covering_radius };
        Ok(Self { mix, before: relaxed(0)?, after: relaxed(options.max_iterations)?, alone })
    }
}
