//! The sets that are measured.

use std::time::Instant;

use azulejo::dcr::relax;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::Effort;
use super::sets::{FIRST_SEED, Method, STARTS, Start};
use azulejo_cli::quality::Quality;
use azulejo_cli::summary::Summary;

/// The sets of one size and start, relaxed by one method.
pub struct Measured {
    pub method: Method,
    pub start: Start,
    pub count: usize,
    /// The figures of each set.
    pub sets: Vec<Quality>,
    /// Steps and seconds of a set, in the mean.
    pub steps: f64,
    pub seconds: f64,
    /// The first set.
    pub first: Vec<[f32; 2]>,
}

impl Measured {
    /// All sizes and starts of a method.
    pub fn all(context: &Context, method: Method, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let sizes = if method.is_thesis { effort.thesis } else { effort.momentum };
        let kinds = sizes.iter().flat_map(|size| STARTS.map(|start| (size, start)));
        let weight = |count: usize, sets: u64| count as f64 * sets as f64;
        let all: f64 = 2.0 * sizes.iter().map(|&(count, sets)| weight(count, sets)).sum::<f64>();
        let mut done = 0.0;
        let mut measured = Vec::new();
        for (&(count, sets), start) in kinds {
            measured.push(Self::kind(context, method, start, count, sets)?);
            done += weight(count, sets);
            _ = progress(done / all);
        }
        Ok(measured)
    }

    fn kind(context: &Context, method: Method, start: Start, count: usize, sets: u64) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let mut measured = Self { method, start, count, sets: Vec::new(), steps: 0.0, seconds: 0.0, first: Vec::new() };
        for seed in FIRST_SEED..FIRST_SEED + sets {
            let points = start.points(context, domain, count, seed)?;
            let options = method.options(domain, seed);
            let clock = Instant::now();
            let (relaxed, report) = relax(context, &options, &points, None)?;
            measured.seconds += clock.elapsed().as_secs_f64() / sets as f64;
            measured.steps += f64::from(report.iterations) / sets as f64;
            measured.sets.push(Quality::of(context, &options.domain, &relaxed)?);
            if seed == FIRST_SEED {
                measured.first = relaxed;
            }
        }
        Ok(measured)
    }

    /// A figure over the sets.
    pub fn summary(&self, figure: impl Fn(&Quality) -> f64) -> Summary {
        Summary::of(&self.sets.iter().map(figure).collect::<Vec<_>>())
    }
}
