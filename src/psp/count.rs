//! Exactly as many samples as asked for: a maximal set that has somewhat less, and the best of one more level.
//!
//! A level (`levels.rs`) that ends above the count is sorted by rank and cut. What remains is conflict-free at the last
//! rank, and covers the surface within the radius of the level before. So the closer that radius, the smaller the loss of
//! maximality. How many samples a radius gives is known for large even surfaces only. So the search goes from large
//! radii to small ones, which never wastes a level that ends below the count, and takes back a level that ends above
//! it if it began too far above.

use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::{exp, log, power};
use crate::psp::estimate::require_memory;
use crate::psp::levels::{Levelled, Levels, Ranked};

/// The covering radius of a set may be so many times its radius.
const LOOSE: f64 = 1.1;
/// How many levels may be taken back for that.
const ATTEMPTS: u32 = 40;
/// The share of the count that levels but the last one aim at.
const AIM: f64 = 0.96;
/// The last level begins at most by this quotient above the radius where the count is expected ...
const NEAR: f64 = 1.0475;
/// ... and ends by this one below, since nested sets are sparser than others.
const BEYOND: f64 = 1.05;
const _: () = assert!(NEAR * BEYOND <= LOOSE);

/// A set that was asked for.
pub struct Found<S> {
    pub samples: Vec<S>,
    /// No two samples are closer.
    pub radius: f64,
    /// No place of the surface is farther from all samples.
    pub coverage: f64,
    pub darts: u64,
}

impl<S: Ranked> Found<S> {
    /// The best of some levels, of which there are enough; all but the last cover the surface within `former`.
    pub fn cut(levels: Levels<impl Levelled<Sample = S>>, count: usize, former: f64) -> Self {
        let (len, last, darts) = (levels.len(), levels.radius(), levels.darts);
        let mut samples = levels.into_sorted();
        samples.truncate(count);
        let rank = samples.last().map_or(last, |sample| f64::from(sample.sample().rank));
        let coverage = if len == count { last } else { former };
        Self { samples, radius: if rank.is_finite() { rank } else { last }, coverage, darts }
    }
}

/// A radius, and how many samples a set of this radius has.
#[derive(Clone, Copy)]
struct Known {
    radius: f64,
    len: usize,
}

/// Exactly `count` samples.
pub fn sample<S: Levelled>(job: &Job, mut levels: Levels<S>, count: usize, finest: f64) -> Result<Found<S::Sample>> {
    let mut above: Option<Known> = None;
    let mut taken_back = 0;
    for key in 0.. {
        let former = Known { radius: levels.radius(), len: levels.len() };
        if former.radius == finest {
            return Err(none_finer(count, former.len, finest));
        }
        let radius = next_radius(&levels, above, taken_back, count, finest).max(finest);
        let part = job.part(1.0 - power(0.4, key), 1.0 - power(0.4, key + 1));
        check_room(&levels.surface, radius, count)?;
        levels.refine(&part, radius, key as u64)?;
        let len = levels.len();
        if len == 0 {
            return Err(no_place(count));
        }
        if len < count {
            // What is known of smaller radii may no longer hold, since sets vary.
            above = above.filter(|above| above.radius < radius);
        } else if len == count
            || former.len > 0 && (former.radius <= LOOSE * levels.rank_of(count) || taken_back >= ATTEMPTS)
        {
            return Ok(Found::cut(levels, count, former.radius));
        } else {
            levels.take_back(former.len, former.radius);
            above = Some(Known { radius, len });
            taken_back += 1;
        }
    }
    unreachable!("radii end at the finest")
}

/// The radius of the next level.
fn next_radius(
    levels: &Levels<impl Levelled>,
    above: Option<Known>,
    taken_back: u32,
    count: usize,
    finest: f64,
) -> f64 {
    let top = levels.surface.top();
    let below = match levels.len() {
        // One sample covers the mesh.
        0 if count == 1 => return top,
        0 if above.is_none() => {
            // Few samples may be more than expected: along open boundaries.
            let count = count as f64;
            return expected_radius(&levels.surface, AIM * count / (1.0 + 2.0 / count.sqrt()), finest);
        }
        0 => Known { radius: top, len: 1 },
        len => Known { radius: levels.radius(), len },
    };
    let growth = (count as f64 / below.len as f64).sqrt();
    match above {
        None if growth <= NEAR => below.radius / (growth * BEYOND),
        None => below.radius / (growth * AIM.sqrt()),
        Some(above) if below.radius <= LOOSE * above.radius => {
            if levels.len() == 0 {
                top
            } else {
                above.radius
            }
        }
        // Between what is known on both sides, on the line of their logarithms, and now and then in the middle.
        Some(above) => {
            let logarithm = |count: f64| log(count / below.len as f64);
            let share = logarithm(AIM * count as f64) / logarithm(above.len as f64);
            let share = if taken_back.is_multiple_of(3) { 0.5 } else { share.clamp(0.02, 0.98) };
            below.radius * exp(share * log(above.radius / below.radius))
        }
    }
}

/// The radius for which so many samples are expected, by areas and edges alone.
pub fn expected_radius(surface: &impl Levelled, count: f64, finest: f64) -> f64 {
    let (mut low, mut high) = (finest, surface.top().max(finest));
    while high > 1.001 * low {
        let middle = (low * high).sqrt();
        if surface.expected(middle) > count { low = middle } else { high = middle }
    }
    high
}

/// Refuses a count where given samples leave so little of the surface that it takes a radius with which the bare surface
/// could not be filled: the work grows with all of it.
pub fn check_room(surface: &impl Levelled, radius: f64, count: usize) -> Result<()> {
    if !surface.has_given() {
        return Ok(());
    }
    let estimate = surface.expected(radius);
    let what = format!("{count} samples beside the given ones: on the whole surface about {estimate:.3e}");
    if estimate > f64::from(u32::MAX) {
        return Err(Error::too_large("count", format!("{what}; the limit is {}", u32::MAX)));
    }
    require_memory(estimate, "count", &what)
}

/// The refusal of any count where given samples cover all of the surface.
pub fn no_place(count: usize) -> Error {
    Error::invalid("count", format!("{count}, but given samples cover all of the surface"))
}

/// The refusal of a count for which floats are not fine enough.
pub fn none_finer(count: usize, len: usize, finest: f64) -> Error {
    let reason = format!("{count} samples are more than the mesh can carry: {len} at radius {finest:?}, the smallest");
    Error::invalid("count", reason)
}
