//! Sets that are made level by level: with an exact number of samples, or in progressive order.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::memory;
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::{Points, finest_radius};
use crate::psp::fill::measures::{BYTES_PER_SAMPLE, Measures};
use crate::psp::fill::uniform::Surface;
use crate::psp::fragment::Facing;
use crate::psp::given::GivenSamples;
use crate::psp::levels::{self, Levels};
use crate::psp::options::{Amount, Options, check_quotient};
use crate::psp::report::{Report, rho};
use crate::psp::samples::surface_samples;

/// The largest number of samples that can be indexed.
const INDEXABLE: usize = u32::MAX as usize;

/// A set of a count, or in progressive order.
pub fn sample(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let &Options { amount, order, quotient, seed, given, cosine } = options;
    if let Amount::Count(count) = amount {
        check_count(count)?;
    }
    if order == Order::Progressive {
        check_quotient(quotient)?;
    }
    let facing = Facing::new(cosine)?;
    let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
    let given = match amount {
        Amount::Radius(radius) => {
            let given = GivenSamples::of_levels(mesh, given, Some(radius))?;
            measures.checked_samples(mesh, radius)?;
            given
        }
        Amount::Count(count) => {
            let given = GivenSamples::of_levels(mesh, given, None)?;
            if mesh.area() == 0.0 {
                return Err(Error::invalid("count", format!("{count}, but the mesh's mask leaves no surface")));
            }
            memory::require(BYTES_PER_SAMPLE * count as f64, "count", &format!("{count} samples"))?;
            given
        }
    };
    let surface = Surface { mesh, measures: &measures, given: &given, facing };
    let (levels, finest) = (Levels::new(surface, seed), finest_radius(mesh.float_spacing()));
    let found = context.run(progress, |job| match (amount, order) {
        (Amount::Radius(radius), _) => levels::by_radius(job, levels, quotient, radius),
        (Amount::Count(count), Order::Progressive) => levels::by_count(job, levels, quotient, count, finest),
        (Amount::Count(count), Order::Any) => levels::exactly(job, levels, count, finest),
    })?;
    let mut samples = surface_samples(mesh, &found.samples);
    if order == Order::Progressive {
        samples.ranks = found.samples.iter().map(|sample| sample.rank).collect();
    }
    let len = samples.len();
    let report = Report {
        rho: rho(mesh, len, found.radius),
        uncovered_before: given.is_empty().then_some(if mesh.area() > 0.0 { 1.0 } else { 0.0 }),
        uncovered_after: matches!(amount, Amount::Radius(_)).then_some(0.0),
        radius: found.radius,
        coverage: Some(found.coverage),
        ..Report::of_fill(len, found.darts, &stopwatch)
    };
    Ok((samples, report))
}

/// Refuses a count that is 0 or cannot be indexed.
fn check_count(count: usize) -> Result<()> {
    match count {
        0 => Err(Error::invalid("count", "0 is not at least 1")),
        1..=INDEXABLE => Ok(()),
        _ => Err(Error::too_large("count", format!("{count}; the limit is {INDEXABLE}"))),
    }
}
