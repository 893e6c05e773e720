//! `azulejo-studies kdrt`: the tables and figures of thesis chapter 2, measured again.

mod page;
pub mod pictures;
mod statistics;
mod times;

use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY, Progress, Result, kdrt, maximal};
use clap::Args;

use crate::args::PageArgs;
use azulejo_cli::progress::watched;
use statistics::Statistics;
use times::Times;

/// The first line of the page.
const SUBJECT: &str = "KDRT's sets beside unbiased ones: density, spectra, rates and the share of samples that \
    tiles leave to do, by the size of leaves.";

/// The leaf sizes of the thesis, in radii.
pub const LEAF_SIZES: [f64; 4] = [6.0, 20.0, 40.0, 80.0];

#[derive(Args)]
pub struct Kdrt {
    #[command(flatten)]
    page: PageArgs,
}

/// The size of the study.
pub struct Effort {
    /// Samples of a set whose statistics are measured.
    pub count: f64,
    /// Groups of sets, in each of which spectra are averaged for their largest value, and sets in each of them.
    pub groups: u64,
    pub sets_per_group: u64,
    /// Samples of the sets whose stages and rates are measured, a power of ten, and of the largest that is timed.
    pub timed: f64,
    pub largest: f64,
    pub rounds: usize,
}

const FULL: Effort = Effort { count: 1e5, groups: 20, sets_per_group: 5, timed: 1e6, largest: 1e7, rounds: 5 };
const QUICK: Effort = Effort { count: 2e4, groups: 5, sets_per_group: 1, timed: 1e4, largest: 3e4, rounds: 2 };

/// A sampler.
#[derive(Clone, Copy, PartialEq)]
pub enum Sampler {
    /// The unbiased reference.
    Maximal,
    /// KDRT with a leaf size in radii.
    Leaves(f64),
}

impl Sampler {
    pub fn name(self) -> String {
        match self {
            Self::Maximal => "reference".to_owned(),
            Self::Leaves(size) => format!("{size}r"),
        }
    }

    /// A set of about `count` samples on the unit torus.
    pub fn sample(self, context: &Context, count: f64, seed: u64) -> Result<Vec<[f32; 2]>> {
        let (radius, domain) = (radius(count), Domain::unit(Boundary::Periodic));
        let set = match self {
            Self::Maximal => maximal::sample(context, &maximal::Options::new(radius).domain(domain).seed(seed), None),
            Self::Leaves(leaf_size) => {
                kdrt::sample(context, &kdrt::Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed), None)
            }
        };
        Ok(set?.positions)
    }
}

/// The radius at which a maximal set of the unit torus has about `count` samples.
pub fn radius(count: f64) -> f64 {
    (MAXIMAL_DENSITY / count).sqrt()
}

impl Kdrt {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("kdrt")?;

        let times = watched("times", |progress| Times::measure(context, &effort, progress))?;
        let samplers = [Sampler::Maximal].into_iter().chain(LEAF_SIZES.map(Sampler::Leaves));
        let mut statistics = Vec::new();
        for sampler in samplers {
            let reference = statistics.first().map(|reference: &Statistics| &reference.spectrum);
            let measure = |progress: &Progress| Statistics::measure(context, sampler, &effort, reference, progress);
            statistics.push(watched("spectra", measure)?);
        }
        pictures::draw_times(&times, &files.picture("times")?)?;
        pictures::draw_stages(&times, &files.picture("stages")?)?;
        for one in &statistics {
            let output = files.picture(&format!("spectrum-{}", one.sampler.name()))?;
            pictures::draw_spectrum(one, &statistics[0], &output)?;
        }
        files.write("KDRT, measured", SUBJECT, times.threads, &page::text(&effort, &statistics, &times))
    }
}
