//! A given number of samples: by insertion and by elimination, as the thesis does it, and as azulejo does (§2.5.3).

mod eliminate;
mod insert;

use std::fmt::Write;

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::smallest_distance_2d;
use azulejo::kdrt::{CountOptions, DEFAULT_LEAF_SIZE, sample_count};
use azulejo::{Boundary, Context, Domain, Result};

use super::claims::{Claim, Fact, Part, cell, number};
use super::study::{Figure, Study, mean_of, timed, times};
use crate::kdrt::{Sampler, radius};
use azulejo_cli::progress::watched;
use azulejo_cli::quality::Quality;
use azulejo_cli::text::grouped;

/// By how many percent the first set has too few samples, or too many.
const OFF: [f64; 3] = [0.5, 2.0, 10.0];

/// The largest distance of a position from all samples beyond the radius, relative to it, that is rounding to floats.
const ROUNDING: f64 = 1e-4;

/// The methods that reach the number.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// From a set with so many percent fewer, with new samples in the largest empty circles.
    Insert(f64),
    /// From a set with so many percent more, without the most crowded samples.
    Eliminate(f64),
    /// `kdrt::sample_count`.
    Azulejo,
}

impl Way {
    fn name(self) -> String {
        match self {
            Self::Insert(percent) => format!("{percent} % inserted"),
            Self::Eliminate(percent) => format!("{percent} % eliminated"),
            Self::Azulejo => "azulejo".to_owned(),
        }
    }

    /// Exactly so many samples, and the radius of the set that they come from.
    fn sample(self, context: &Context, count: usize, seed: u64) -> Result<(Vec<[f32; 2]>, f64)> {
        let start = |percent: f64| {
            let about = count as f64 * (1.0 + percent / 100.0);
            Ok((Sampler::Leaves(DEFAULT_LEAF_SIZE).sample(context, about, seed)?, radius(about)))
        };
        match self {
            Self::Insert(percent) => start(-percent).map(|(samples, radius)| (insert::insert(&samples, count), radius)),
            Self::Eliminate(percent) => {
                start(percent).map(|(samples, radius)| (eliminate::eliminate(&samples, count), radius))
            }
            Self::Azulejo => {
                let options = CountOptions::new(count as u64).domain(Domain::unit(Boundary::Periodic)).seed(seed);
                sample_count(context, &options, None).map(|(points, report)| (points.positions, report.radius))
            }
        }
    }
}

struct Set {
    quality: Quality,
    /// The smallest distance, and the covering radius, in units of the radius of the set that it comes from.
    smallest: f64,
    covering: f64,
    seconds: f64,
    samples: usize,
}

impl Set {
    /// The covering radius over the smallest distance.
    fn looseness(&self) -> f64 {
        self.covering / self.smallest
    }
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, sets) = study.effort((20_000, 12), (2_000, 2));
    let (one, torus) = (Context::new(1)?, Domain::unit(Boundary::Periodic));
    let changed = OFF.iter().flat_map(|&percent| [Way::Insert(percent), Way::Eliminate(percent)]);
    let mut rows: Vec<(Way, Vec<Set>)> = changed.chain([Way::Azulejo]).map(|way| (way, Vec::new())).collect();
    watched("counts", |progress| {
        for seed in 0..sets {
            for (way, made) in &mut rows {
                let ((samples, radius), seconds) = timed(|| way.sample(&one, count, seed))?;
                made.push(Set {
                    quality: Quality::of(study.context, &torus, &samples)?,
                    smallest: smallest_distance_2d(study.context, &torus, &samples, None)? / radius,
                    covering: covering_radius_2d(study.context, &torus, &samples, None)? / radius,
                    seconds,
                    samples: samples.len(),
                });
            }
            _ = progress((seed + 1) as f64 / sets as f64);
        }
        Ok(())
    })?;
    let Some(((_, ours), theirs)) = rows.split_last() else { unreachable!("there are ways") };
    let claims = |(way, sets): &(Way, Vec<Set>)| {
        let name = way.name();
        let rho: Figure<Set> = |set| set.quality.rho;
        match way {
            Way::Insert(_) => vec![
                Claim::less(
                    format!("smallest distance over r below 1, {name} (§2.5.3: \"conflict will be sure to happen\")"),
                    mean_of(sets, |set| set.smallest),
                    number(1.0),
                ),
                Claim::less(format!("ρ: {name} below azulejo"), mean_of(sets, rho), mean_of(ours, rho)),
            ],
            Way::Eliminate(_) => vec![
                Claim::less(
                    format!("covering radius over r above 1, {name} (§2.5.3: \"will also harm the maximal coverage\")"),
                    number(1.0),
                    mean_of(sets, |set| set.covering),
                ),
                Claim::less(
                    format!("covering radius over smallest distance: azulejo below {name}"),
                    mean_of(ours, Set::looseness),
                    mean_of(sets, Set::looseness),
                ),
            ],
            Way::Azulejo => Vec::new(),
        }
    };
    let fact = Fact {
        what: format!("azulejo: {} samples, conflict-free, and maximal up to {ROUNDING:e} r", grouped(count)),
        found: format!(
            "distances from {:.6} r, all places within {:.6} r",
            ours.iter().map(|set| set.smallest).fold(f64::INFINITY, f64::min),
            ours.iter().map(|set| set.covering).fold(0.0, f64::max)
        ),
        is_met: ours.iter().all(|set| set.samples == count && set.smallest >= 1.0 && set.covering <= 1.0 + ROUNDING),
    };
    Ok(Part { claims: theirs.iter().flat_map(claims).collect(), facts: vec![fact], text: text(count, sets, &rows) })
}

fn text(count: usize, sets: u64, rows: &[(Way, Vec<Set>)]) -> String {
    let mut text = format!(
        "## A number of samples (thesis §2.5.3)\n\n\
         {sets} sets of {} samples each way. The thesis makes about as many and then inserts the rest \"in the largest triangle in the Delaunay \
         Triangulation\" (Kanamori et al. 2011: in the middle of the largest empty circle), or eliminates the most crowded (Yuksel 2015), \
         and says that both harm the maximal coverage; it gives no figures. Here the first set is of KDRT and has fewer or more by the percentage of the row, give or take \
         its own chance. Azulejo changes small places of a set and keeps it maximal. *Smallest* and *covering* are the smallest \
         distance and the covering radius over the radius of the set that was begun with: 1 and 1 is a maximal set. Their quotient \
         does not depend on that radius: at most 1 is a maximal set of another radius. *ρ*, *nearest* and *cover* are the smallest distance, the mean distance to the nearest sample and the covering radius in units of the \
         hexagonal distance, *P* the mean power below ¼ √density. Milliseconds are those of the whole set.\n\n\
         | way | smallest | covering | covering / smallest | ρ | nearest | cover | P | ms |\n|---|---|---|---|---|---|---|---|---|\n",
        grouped(count),
    );
    for (way, sets) in rows {
        let figure = |of: Figure<Set>| cell(&mean_of(sets, of));
        let quality = |of: Figure<Quality>| format!("{:.4}", mean_of(sets, |set| of(&set.quality)).mean);
        let seconds: Vec<_> = sets.iter().map(|set| set.seconds).collect();
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            way.name(),
            figure(|set| set.smallest),
            figure(|set| set.covering),
            figure(Set::looseness),
            quality(|set| set.rho),
            quality(|set| set.mean_distance),
            quality(|set| set.cover),
            quality(|set| set.low_power),
            times(&seconds, 1e3),
        );
    }
    text
}
