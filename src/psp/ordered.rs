//! Sets that are made level by level: of exactly so many samples, or in progressive order.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::{Points, finest_radius};
use crate::psp::estimate::{checked_estimate, require_memory};
use crate::psp::facing::Facing;
use crate::psp::fill::measures::Measures;
use crate::psp::fill::uniform::Surface;
use crate::psp::given::GivenSamples;
use crate::psp::levels::{self, Levels};
use crate::psp::options::Options;
use crate::psp::report::{Report, rho};
use crate::psp::samples::surface_samples;

/// A set of a count, or in progressive order.
pub fn sample(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    options.check_levels()?;
    let facing = Facing::new(options.cosine)?;
    let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
    let &Options { radius, count, order, quotient, seed, .. } = options;
    let given = GivenSamples::of_levels(mesh, options.given, (count == 0).then_some(radius))?;
    if count == 0 {
        checked_estimate(mesh, &measures, radius)?;
    } else if mesh.area() == 0.0 {
        return Err(Error::invalid("count", format!("{count}, but the mesh's mask leaves no surface")));
    } else {
        require_memory(count as f64, "count", &format!("{count} samples"))?;
    }
    let surface = Surface { mesh, measures: &measures, given: &given, facing };
    let (levels, finest) = (Levels::new(surface, seed), finest_radius(mesh.float_spacing()));
    let found = context.run(progress, |job| match (order, count) {
        (Order::Progressive, 0) => levels::by_radius(job, levels, quotient, radius),
        (Order::Progressive, _) => levels::by_count(job, levels, quotient, count, finest),
        (Order::Any, _) => levels::exactly(job, levels, count, finest),
    })?;
    let mut samples = surface_samples(mesh, &found.samples);
    if order == Order::Progressive {
        samples.ranks = found.samples.iter().map(|sample| sample.rank).collect();
    }
    let (len, area, seconds) = (samples.len(), mesh.area(), stopwatch.seconds());
    let report = Report {
        samples: len as u64,
        accepted: len as u64,
        darts: found.darts,
        conflicts: found.darts - len as u64,
        seconds,
        fill_seconds: seconds,
        rho: rho(mesh, len, found.radius),
        uncovered_before: given.is_empty().then_some(if area > 0.0 { 1.0 } else { 0.0 }),
        uncovered_after: (count == 0).then_some(0.0),
        radius: found.radius,
        coverage: Some(found.coverage),
        ..Report::default()
    };
    Ok((samples, report))
}
