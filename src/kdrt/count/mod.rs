//! Exactly N samples (thesis §2.5.3), and still a maximal set.
//!
//! Departure: the thesis makes about N samples and then inserts the rest into the largest triangles, which brings
//! samples closer together than the radius, or eliminates the surplus, which leaves gaps. Here a set of
//! about N samples is changed in small places only (`tune.rs`): the samples of a place are taken out and it is filled
//! again, as KDRT fills its gaps, until it holds as many more or fewer as wanted. The radius is kept, and so is the
//! coverage.

mod plots;
mod search;
mod thin;
mod tune;

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::kdrt::base::Base;
use crate::kdrt::options::{DEFAULT_LEAF_SIZE, Options, Progressive, check_leaf_size};
use crate::kdrt::progressive;
use crate::memory;
use crate::plane::lattice::Lattice;
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, hash};
use crate::setters::setters;

use search::Search;
use thin::thin;
use tune::tune;

/// Radii that are tried before a set is accepted that is not maximal. A maximal set of any number of samples exists:
/// put each where the domain is farthest from those before it. More than a dozen attempts at one were never seen.
const ATTEMPTS: u64 = 64;

/// The share of the remaining progress that the attempt at work takes.
const ATTEMPT_SHARE: f64 = 0.9;

/// The share of an attempt that making the set takes; the rest is for tuning it.
const SAMPLING_SHARE: f64 = 0.7;

/// What to sample, by number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CountOptions {
    /// How many samples: at least 1.
    pub count: u64,
    /// Where to sample, as in [`Options`](super::Options).
    pub domain: Domain,
    /// The shortest side of a leaf in radii, as in [`Options`](super::Options).
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// The levels of a set in progressive order; none, the default, for any order. The sets of all counts with the same
    /// levels are prefixes of each other. The coarsest must not have more samples than asked for; infinity, its default,
    /// or any radius that is longer than the diagonal of the domain, stands for this diagonal.
    pub levels: Option<Progressive>,
}

impl CountOptions {
    /// So many samples on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`], seed 0 and in any order.
    pub fn new(count: u64) -> Self {
        Self { count, domain: Domain::unit(Boundary::Periodic), leaf_size: DEFAULT_LEAF_SIZE, seed: 0, levels: None }
    }
}

setters!(CountOptions {
    count: u64,
    domain: Domain,
    leaf_size: f64,
    seed: u64,
    levels: Option<Progressive>,
});

/// What [`sample_count`] achieved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CountReport {
    /// The radius: no two samples are closer.
    pub radius: f64,
    /// Whether the set is maximal for this radius. True where a maximal set of so many samples was found; false in
    /// progressive order, where the domain is covered within the quotient times the radius.
    pub is_maximal: bool,
}

/// A maximal Poisson-disk set of exactly `count` samples, in parallel.
///
/// The radius follows from the density of maximal sets and is corrected when the set made with it is off by more than
/// chance. What still differs, mostly up to 0.3 % and with less than 10,000 samples up to about their square root, is
/// set right by making small places anew. The result keeps what [`sample`](super::sample) promises, for the radius in
/// the report: conflict-free, and maximal within the same tolerance. Many radii would do, the more different ones the
/// fewer the samples; it is the first that is found. The radius of a single sample is one with which it covers the
/// domain.
///
/// If no maximal set is found, which has not been seen in 100,000 sets of few samples, the most crowded samples of a
/// larger set are dropped and the report says that the set is not maximal. How far the domain is from the samples
/// exactly says [`covering_radius_2d`](crate::analysis::coverage::covering_radius_2d).
///
/// In progressive order the samples are the first ones of a set whose coarsest radius depends on the domain only
/// ([`CountOptions::levels`]), so that sets of smaller counts are prefixes; the radius in the report is the last
/// rank.
///
/// In any order the samples are in that of [`sample`](super::sample), with those made anew in the places of others. The
/// same for every number of threads. O(n) like [`sample`](super::sample), which is called once or a few times.
///
/// # Errors
/// [`Error::InvalidArgument`] for an argument out of range, and for `count` where floats are too coarse for the radius
/// of so many samples; [`Error::TooLarge`] above 2^32 samples or the available memory; both before any work, unless the
/// expected radius is hardly above the limit; [`Error::Cancelled`].
pub fn sample_count(
    context: &Context,
    options: &CountOptions,
    progress: Option<&Progress>,
) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, domain, leaf_size, .. } = options;
    check_leaf_size(leaf_size)?;
    domain.check()?;
    if count == 0 {
        return Err(Error::invalid("count", "0 is not at least 1"));
    }
    let search = Search::new(&domain, leaf_size, count);
    lattice(options, search.radius())?;
    if let Some(levels) = &options.levels {
        levels.check(0.0)?;
        memory::require(count as f64 * progressive::BYTES_PER_SAMPLE, "count", &format!("{count} samples"))?;
        return context.run(progress, |job| first_of_order(job, options, levels));
    }
    context.run(progress, |job| attempt(job, options, search, ATTEMPTS))
}

/// The first samples of a progressive order.
fn first_of_order(job: &Job, options: &CountOptions, levels: &Progressive) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, domain, leaf_size, seed, .. } = options;
    let plane = Options { leaf_size, seed, ..Options::new(f64::NAN).domain(domain) };
    let points = progressive::first(job, &plane, levels, count as usize).map_err(|error| of_count(error, count))?;
    let radius = points.ranks.last().copied().map_or(0.0, f64::from);
    Ok((points, CountReport { radius, is_maximal: false }))
}

/// Makes sets of several radii until one can be tuned; after `limit` of them a larger one will do.
fn attempt(job: &Job, options: &CountOptions, mut search: Search, limit: u64) -> Result<(Points<2>, CountReport)> {
    let &CountOptions { count, leaf_size, seed, .. } = options;
    let mut remaining = 1.0;
    let mut attempts = 0;
    let mut closest: Option<(f64, Vec<[f32; 2]>)> = None;
    loop {
        let job = job.part(1.0 - remaining, 1.0 - remaining * (1.0 - ATTEMPT_SHARE));
        remaining *= 1.0 - ATTEMPT_SHARE;
        let seed = if attempts == 0 { seed } else { hash(seed, Draw::Attempt, &[attempts]) };
        attempts += 1;
        let radius = search.radius();
        let lattice = lattice(options, radius)?;
        let mut samples = Base::sample(&job.part(0.0, SAMPLING_SHARE), &lattice, leaf_size, seed, Arc::default())
            .map_err(|error| of_count(error, count))?;
        let made = samples.len() as u64;
        if search.is_near(made) {
            tune(&job.part(SAMPLING_SHARE, 1.0), &lattice, &mut samples, count, seed)?;
        }
        let difference = samples.len() as i64 - count as i64;
        if difference == 0 {
            return Ok((samples.into(), CountReport { radius, is_maximal: true }));
        }
        search.correct(made);
        if difference > 0 && closest.as_ref().is_none_or(|(_, closest)| samples.len() < closest.len()) {
            closest = Some((radius, samples));
        }
        if attempts >= limit
            && let Some((radius, samples)) = closest.take()
        {
            let samples = thin(&options.domain, samples, count as usize);
            return Ok((samples.into(), CountReport { radius, is_maximal: false }));
        }
    }
}

/// The lattice for a radius that follows from the count.
fn lattice(options: &CountOptions, radius: f64) -> Result<Lattice> {
    Lattice::new(&options.domain, radius).map_err(|error| of_count(error, options.count))
}

/// An error about the radius as one about the count that it follows from.
fn of_count(error: Error, count: u64) -> Error {
    let reason = |reason| format!("{count} asks for a radius that is refused: {reason}");
    match error {
        Error::InvalidArgument { argument: "radius", reason: why } => Error::invalid("count", reason(why)),
        Error::TooLarge { argument: "radius", reason: why } => Error::too_large("count", reason(why)),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Boundary;

    /// One attempt at few samples often fails. What then is returned keeps the radius, but has a gap where a sample
    /// was.
    #[test]
    fn a_set_that_could_not_be_tuned_is_thinned_and_called_not_maximal() {
        let context = Context::new(1).unwrap();
        let domain = Domain::unit(Boundary::Periodic);
        let mut thinned = 0;
        for (count, seed) in (2..12).flat_map(|count| (0..30).map(move |seed| (count, seed))) {
            let options = CountOptions::new(count).domain(domain).seed(seed);
            let search = Search::new(&domain, options.leaf_size, count);
            let (points, report) = context.run(None, |job| attempt(job, &options, search, 1)).unwrap();
            let samples = points.positions;
            assert_eq!(samples.len() as u64, count);
            let smallest = crate::analysis::spacing::smallest_distance_2d(&context, &domain, &samples, None).unwrap();
            let farthest = crate::analysis::coverage::covering_radius_2d(&context, &domain, &samples, None).unwrap();
            assert!(smallest >= report.radius);
            assert_eq!(report.is_maximal, farthest < report.radius * (1.0 + 1e-6), "{farthest} {report:?}");
            thinned += u32::from(!report.is_maximal);
        }
        assert!(thinned > 0);
    }

    #[test]
    fn errors_name_the_count() {
        let context = Context::new(1).unwrap();
        let refuse = |count, max: [f64; 2], leaf_size| {
            let domain = Domain { min: [1.0; 2], max, boundary: Boundary::Bounded };
            sample_count(&context, &CountOptions::new(count).domain(domain).leaf_size(leaf_size), None).unwrap_err()
        };
        let invalid =
            |error: &Error, name| matches!(error, Error::InvalidArgument { argument, .. } if *argument == name);
        assert!(invalid(&refuse(0, [2.0; 2], 20.0), "count"));
        assert!(invalid(&refuse(10, [2.0; 2], 5.0), "leaf_size"));
        assert!(invalid(&refuse(10, [0.0; 2], 20.0), "domain_max"));
        let coarse = refuse(10_000, [1.0008; 2], 20.0);
        assert!(invalid(&coarse, "count") && coarse.to_string().contains("10000 asks for a radius"), "{coarse}");
        for count in [5_000_000_000, u64::MAX] {
            let large = refuse(count, [2.0; 2], 20.0);
            assert!(matches!(large, Error::TooLarge { argument: "count", .. }), "{large}");
        }
    }
}
